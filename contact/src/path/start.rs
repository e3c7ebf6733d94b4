//! The start of a level: the next coarser one's solution on the finer grid.
//!
//! What is smooth is the foundation's displacement `u = K p`, not the pressure, and least of all the gap on a rough
//! surface. So `u` is interpolated, and the fine grid's own `g0` tells where the indenter would overlap:
//!
//! ```text
//! g = u + g0 − D,    I = {g < 0} ∪ {all four coarse centres around press}
//! ```
//!
//! The second set is what a smooth contact needs, whose gaps vanish. Pressures on `I` are interpolated between
//! elements on the same side of the relief's outline, and scaled so that the force of a coarse element stays what it
//! was, less what lies across an outline: unscaled, bare stiff coats take half as many products more. Gaps interpolated
//! as negative pressures, as before, made the set 2 to 20 times too large on rough surfaces.

use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use crate::{
    grid::{
        prolongation::{FineLine, Prolongation},
        window::Window,
    },
    vector::smallest,
};

/// Pressure of an element that overlaps where no coarse one presses, as a part of the largest.
const SMALLEST_PRESSURE: f64 = 1e-3;
/// A level's solution, as the next finer level sees it.
pub struct CoarserSolution {
    /// Where the displacement is known; it holds all pressures.
    pub window: Window,
    /// `p`, in Pa.
    pub pressure: Vec<f64>,
    /// `K p`, in m.
    pub displacement: Vec<f64>,
    /// `D`, in m.
    pub penetration: f64,
    /// Outline of the relief on the whole level.
    pub outline: Arc<Vec<bool>>,
}

/// The fine problem, as far as a start needs it.
pub struct FineGrid<'a> {
    /// `g0` of the whole level, in m.
    pub initial_gap: &'a [f64],
    /// Outline of its relief.
    pub outline: &'a [bool],
}

impl CoarserSolution {
    /// The pressure (Pa) to start from on a window `onto` of a finer grid.
    pub fn start_on(&self, onto: &Window, fine: &FineGrid<'_>) -> Vec<f64> {
        let prolongation = Prolongation::new(&self.window, onto);
        let highest = self.pressure.iter().copied().fold(0.0, f64::max);
        let lowest = smallest(&self.displacement);
        let block = |rows: Range<usize>| {
            let start = Start {
                coarser: self,
                onto,
                fine,
                prolongation: &prolongation,
                smallest: SMALLEST_PRESSURE * highest,
                widest: self.penetration - lowest,
            };
            start.on_rows(rows)
        };
        let blocks = blocks(prolongation.rows()).into_par_iter();
        let blocks: Vec<Vec<f64>> = blocks.map(block).collect();
        blocks.concat()
    }
}

/// The fine rows in each coarse one.
fn blocks(rows: &[FineLine]) -> Vec<Range<usize>> {
    let mut first = 0;
    let blocks = rows.chunk_by(|one, other| one.within == other.within);
    blocks
        .map(|block| {
            first += block.len();
            first - block.len()..first
        })
        .collect()
}

/// The start on its way.
struct Start<'a> {
    coarser: &'a CoarserSolution,
    onto: &'a Window,
    fine: &'a FineGrid<'a>,
    prolongation: &'a Prolongation,
    smallest: f64,
    /// Initial gap that no displacement closes (m).
    widest: f64,
}

/// What a coarse element's fine ones have together.
#[derive(Clone, Copy, Default)]
struct Share {
    pressure: f64,
    /// Fine elements on the coarse one's side of the outline.
    elements: f64,
}

impl Start<'_> {
    /// The pressures on the fine rows of one coarse row.
    fn on_rows(&self, rows: Range<usize>) -> Vec<f64> {
        let (size, from) = (self.onto.size(), &self.coarser.window);
        let mut pressure = vec![0.0; rows.len() * size];
        let lines = pressure.chunks_mut(size).zip(rows.clone());
        lines.for_each(|(pressure, row)| self.on_row(row, pressure));
        let Some(coarse_row) = self.coarse_line(0, self.prolongation.rows()[rows.start]) else {
            return pressure;
        };
        let coarse = |column: usize| coarse_row * from.size() + column;
        let columns = || self.prolongation.columns().iter();
        let mut shares = vec![Share::default(); from.size()];
        for (pressure, row) in pressure.chunks(size).zip(rows.clone()) {
            let sides = self.onto.line(self.fine.outline, row);
            for ((p, side), line) in pressure.iter().zip(sides).zip(columns()) {
                if let Some(column) = self.coarse_line(1, *line) {
                    let is_same_side = self.side(coarse(column)) == *side;
                    shares[column].pressure += p;
                    shares[column].elements += f64::from(u8::from(is_same_side));
                }
            }
        }
        for pressure in pressure.chunks_mut(size) {
            for (p, line) in pressure.iter_mut().zip(columns()) {
                let Some(column) = self.coarse_line(1, *line) else {
                    continue;
                };
                let (wanted, share) = (self.coarser.pressure[coarse(column)], shares[column]);
                if wanted > 0.0 && share.pressure > 0.0 {
                    *p *= wanted * share.elements / share.pressure;
                }
            }
        }
        pressure
    }

    /// The line of the coarse window, a row or a column, that holds a fine one.
    fn coarse_line(&self, axis: usize, line: FineLine) -> Option<usize> {
        let lines = self.coarser.window.lengths()[axis];
        usize::try_from(line.within)
            .ok()
            .filter(|line| *line < lines)
    }

    /// Whether a coarse element lies on the relief.
    fn side(&self, element: usize) -> bool {
        let window = &self.coarser.window;
        let (row, column) = (element / window.size(), element % window.size());
        window.line(&self.coarser.outline, row)[column]
    }

    /// Interpolates on one row.
    fn on_row(&self, row: usize, pressure: &mut [f64]) {
        let gaps = self.onto.line(self.fine.initial_gap, row);
        if gaps.iter().all(|g0| *g0 >= self.widest) {
            return;
        }
        let sides = self.onto.line(self.fine.outline, row);
        let (across, size) = (self.prolongation.rows()[row], self.coarser.window.size());
        let mut displacement = vec![0.0; size];
        for (line, weight) in across.among {
            let values = &self.coarser.displacement[line * size..][..size];
            let sum = displacement.iter_mut().zip(values);
            sum.for_each(|(sum, value)| *sum += weight * value);
        }
        let columns = self.prolongation.columns().iter();
        let elements = pressure.iter_mut().zip(gaps).zip(sides).zip(columns);
        for (((p, g0), side), along) in elements {
            if *g0 >= self.widest {
                continue;
            }
            let terms = along.among.iter();
            let u: f64 = terms
                .map(|(line, weight)| weight * displacement[*line])
                .sum();
            let (mean, is_full) = self.pressure_around([&across, along], *side);
            if is_full || u + g0 < self.coarser.penetration {
                *p = mean.max(self.smallest);
            }
        }
    }

    /// The mean pressure of the four coarse centres around a place, as far as they lie on its side of the outline, by
    /// their linear weights; and whether all four do and press.
    fn pressure_around(&self, [across, along]: [&FineLine; 2], side: bool) -> (f64, bool) {
        let (mut sum, mut weights, mut pressing) = (0.0, 0.0, 0);
        for (row, weight) in across.around {
            for (column, other) in along.around {
                let (Some(row), Some(column)) = (row, column) else {
                    continue;
                };
                let element = row * self.coarser.window.size() + column;
                if self.side(element) == side {
                    let p = self.coarser.pressure[element];
                    sum += weight * other * p;
                    weights += weight * other;
                    pressing += u32::from(p > 0.0);
                }
            }
        }
        let mean = if weights > 0.0 { sum / weights } else { 0.0 };
        (mean, pressing == 4)
    }
}
