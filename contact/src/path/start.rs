//! The start of a level: the solution of the next coarser level on the finer grid.
//!
//! The foundation's displacement `u = K p` is smooth; the pressure is not, and the gap on a rough surface still less.
//! So `u` is interpolated, and the fine grid's own `g0` shows where the indenter would overlap:
//!
//! ```text
//! g = u + g0 − D,    I = {g < φ e} ∪ {all four coarse centres around press}
//! ```
//!
//! A smooth contact needs the second set, because its gaps vanish. On a rough surface the interpolated `u` lacks the
//! response to the finest waves, so `g` has an error. Its mean `e` over the second set is
//!
//! ```text
//! e = mean |g + w*(p)| κ/(κ + η)
//! ```
//!
//! of which the springs `w*` take the rest: `η` is their compliance and `κ` that of the foundation for opposite
//! pressures on neighbouring elements. An element belongs to the contact if its gap is less than `φ e`, where a share
//! `φ` of the coarse centres around it presses. This leaves a third fewer elements on the wrong side, and about as
//! many are missing as are too many. On smooth surfaces `e = 0`: with it Fig. 2d takes 27 products instead of 24 at N
//! = 1024.
//!
//! Pressures on `I` are interpolated between elements on the same side of the relief's outline, and scaled to preserve
//! the force of a coarse element, less the part across an outline: unscaled, bare stiff coatings take half as many
//! products again. Interpolating gaps as negative pressures made the set 2 to 20 times too large on rough surfaces.

use std::ops::Range;
use std::sync::Arc;

use pellicle_texture::SpringLaw;
use rayon::prelude::*;

use crate::{
    grid::{
        prolongation::{FineLine, Prolongation},
        window::Window,
    },
    vector::smallest,
};

/// Pressure, as a fraction of the largest, of an overlapping element where no coarse element presses.
const SMALLEST_PRESSURE: f64 = 1e-3;
/// Every which row gives a sample of the gap's error.
const ROWS_PER_SAMPLE: usize = 8;

/// A level's solution, as needed by the next finer level.
pub struct CoarserSolution {
    /// The window on which the displacement is known; it holds all pressures.
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

/// The parts of the fine problem that a start needs.
pub struct FineGrid<'a> {
    /// `g0` of the whole level, in m.
    pub initial_gap: &'a [f64],
    /// Outline of its relief.
    pub outline: &'a [bool],
    /// For a rough surface only.
    pub rough: Option<RoughSurface<'a>>,
}

/// What the gap's error on a rough surface depends on.
pub struct RoughSurface<'a> {
    /// `η` of the relief on the whole level, in m/Pa, and the law of its springs.
    pub relief_compliance: &'a [f64],
    pub spring_law: SpringLaw,
    /// `κ`, in m/Pa: displacement of an element by opposite pressures on it and on a neighbour.
    pub shortest_compliance: f64,
    /// Largest pressure, in Pa.
    pub hardness: f64,
}

impl CoarserSolution {
    /// Returns the starting pressure (Pa) on a window `onto` of a finer grid.
    pub fn start_on(&self, onto: &Window, fine: &FineGrid<'_>) -> Vec<f64> {
        let prolongation = Prolongation::new(&self.window, onto);
        let highest = self.pressure.iter().copied().fold(0.0, f64::max);
        let lowest = smallest(&self.displacement);
        let mut start = Start {
            coarser: self,
            onto,
            fine,
            prolongation: &prolongation,
            smallest: SMALLEST_PRESSURE * highest,
            widest: self.penetration - lowest,
            gap_error: 0.0,
        };
        if let Some(rough) = &fine.rough {
            start.gap_error = start.mean_gap_error(rough);
        }
        // Zeroed memory that is touched only where elements press.
        let mut pressure = vec![0.0; onto.elements()];
        let mut rest = &mut pressure[..];
        let mut blocks_of_rows = Vec::new();
        for rows in blocks(prolongation.rows()) {
            let (block, others) = rest.split_at_mut(rows.len() * onto.size());
            blocks_of_rows.push((rows, block));
            rest = others;
        }
        let blocks = blocks_of_rows.into_par_iter();
        blocks.for_each(|(rows, block)| start.on_rows(rows, block));
        pressure
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

/// The data for the computation of a start.
struct Start<'a> {
    coarser: &'a CoarserSolution,
    onto: &'a Window,
    fine: &'a FineGrid<'a>,
    prolongation: &'a Prolongation,
    smallest: f64,
    /// Initial gap (m) beyond which no displacement gives contact.
    widest: f64,
    /// Mean error of the interpolated gap (m).
    gap_error: f64,
}

/// An element of the fine grid, as interpolated.
struct Interpolated {
    /// Its place in its row.
    column: usize,
    /// The gap (m) without the relief's springs.
    gap: f64,
    /// Pressure (Pa).
    pressure: f64,
    /// Share, by linear weights, of the coarse centres around that press.
    share: f64,
    /// Whether all four press.
    is_full: bool,
}

/// Total pressure and number of the fine elements in a coarse one.
#[derive(Clone, Copy, Default)]
struct Share {
    pressure: f64,
    /// Number of fine elements on the coarse one's side of the outline.
    elements: f64,
}

impl Start<'_> {
    /// Writes the pressures on the fine rows of one coarse row.
    fn on_rows(&self, rows: Range<usize>, pressure: &mut [f64]) {
        let (size, from) = (self.onto.size(), &self.coarser.window);
        let lines = pressure.chunks_mut(size).zip(rows.clone());
        let presses = lines.fold(false, |any, (line, row)| self.on_row(row, line) || any);
        if !presses {
            return;
        }
        let Some(coarse_row) = self.coarse_line(0, self.prolongation.rows()[rows.start]) else {
            return;
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
    }

    /// The line (row or column) of the coarse window that holds a fine line.
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

    /// Writes the pressures of one row; returns whether any element presses there.
    fn on_row(&self, row: usize, pressure: &mut [f64]) -> bool {
        let mut presses = false;
        self.interpolate_row(row, |element| {
            if element.is_full || element.gap < element.share * self.gap_error {
                pressure[element.column] = element.pressure.max(self.smallest);
                presses = true;
            }
        });
        presses
    }

    /// `e`, from some of the rows.
    fn mean_gap_error(&self, rough: &RoughSurface<'_>) -> f64 {
        let rows = self.prolongation.rows().len().div_ceil(ROWS_PER_SAMPLE);
        let of_row = |sample: usize| {
            let row = sample * ROWS_PER_SAMPLE;
            let compliance = self.onto.line(rough.relief_compliance, row);
            let (mut sum, mut elements) = (0.0, 0.0);
            self.interpolate_row(row, |element| {
                let p = element.pressure;
                if element.is_full && p < rough.hardness {
                    let eta = compliance[element.column];
                    let error = element.gap + rough.spring_law.shortening(eta, p);
                    let kappa = rough.shortest_compliance;
                    let of_foundation = kappa / (kappa + rough.spring_law.tangent(eta, p));
                    sum += error.abs() * of_foundation;
                    elements += 1.0;
                }
            });
            [sum, elements]
        };
        let of_rows: Vec<[f64; 2]> = (0..rows).into_par_iter().map(of_row).collect();
        let total = |which: usize| of_rows.iter().map(|row| row[which]).sum::<f64>();
        let (sum, elements) = (total(0), total(1));
        if elements > 0.0 { sum / elements } else { 0.0 }
    }

    /// Interpolates on one row, where contact is possible.
    fn interpolate_row(&self, row: usize, mut each: impl FnMut(Interpolated)) {
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
        for (column, ((g0, side), along)) in gaps.iter().zip(sides).zip(columns).enumerate() {
            if *g0 >= self.widest {
                continue;
            }
            let terms = along.among.iter();
            let u: f64 = terms
                .map(|(line, weight)| weight * displacement[*line])
                .sum();
            let gap = u + g0 - self.coarser.penetration;
            each(self.around(column, gap, [&across, along], *side));
        }
    }

    /// The element in this column, from those of the four coarse centres around it that are on its side of the outline.
    fn around(
        &self,
        column: usize,
        gap: f64,
        [across, along]: [&FineLine; 2],
        side: bool,
    ) -> Interpolated {
        let (mut sum, mut weights, mut share, mut pressing) = (0.0, 0.0, 0.0, 0);
        for (row, weight) in across.around {
            for (column, other) in along.around {
                let (Some(row), Some(column)) = (row, column) else {
                    continue;
                };
                let element = row * self.coarser.window.size() + column;
                if self.side(element) == side {
                    let p = self.coarser.pressure[element];
                    let weight = weight * other;
                    sum += weight * p;
                    weights += weight;
                    if p > 0.0 {
                        share += weight;
                        pressing += 1;
                    }
                }
            }
        }
        Interpolated {
            column,
            gap,
            pressure: if weights > 0.0 { sum / weights } else { 0.0 },
            share: if weights > 0.0 { share / weights } else { 0.0 },
            is_full: pressing == 4,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COARSE: usize = 8;
    const FINE: usize = 16;

    /// Fields of a grid by row and column, in its own elements.
    fn field<T>(size: usize, of: impl Fn([usize; 2]) -> T) -> Vec<T> {
        (0..size * size).map(|e| of([e / size, e % size])).collect()
    }

    /// A solution with this pressure and displacement under a penetration of 1, and this outline.
    fn coarser(
        pressure: impl Fn([usize; 2]) -> f64,
        displacement: impl Fn([usize; 2]) -> f64,
        outline: impl Fn([usize; 2]) -> bool,
    ) -> CoarserSolution {
        CoarserSolution {
            window: Window::whole(COARSE),
            pressure: field(COARSE, pressure),
            displacement: field(COARSE, displacement),
            penetration: 1.0,
            outline: Arc::new(field(COARSE, outline)),
        }
    }

    fn start(from: &CoarserSolution, gap: f64, outline: impl Fn([usize; 2]) -> bool) -> Vec<f64> {
        let fine = FineGrid {
            initial_gap: &vec![gap; FINE * FINE],
            outline: &field(FINE, outline),
            rough: None,
        };
        from.start_on(&Window::whole(FINE), &fine)
    }

    /// The sum over the fine elements of a coarse one.
    fn together(start: &[f64], [i, j]: [usize; 2]) -> f64 {
        let of = |a: usize, b: usize| start[(2 * i + a) * FINE + 2 * j + b];
        of(0, 0) + of(0, 1) + of(1, 0) + of(1, 1)
    }

    fn bump([i, j]: [usize; 2]) -> f64 {
        let [x, y] = [i, j].map(|i| i as f64 - 3.2);
        (9.0 - x * x - y * y).max(0.0)
    }

    #[test]
    fn a_coarse_element_keeps_its_force() {
        let from = coarser(bump, |_| 0.0, |_| false);
        let found = start(&from, 0.5, |_| false);
        for e in 0..COARSE * COARSE {
            let place = [e / COARSE, e % COARSE];
            if from.pressure[e] > 0.0 {
                let error = together(&found, place) / 4.0 - from.pressure[e];
                assert!(error.abs() < 1e-14, "{place:?}: {error}");
            }
        }
        // Overlapping elements beside the contact press a little, those too far away do not.
        let highest = from.pressure.iter().copied().fold(0.0, f64::max);
        assert_eq!(found[FINE * FINE - 1], SMALLEST_PRESSURE * highest);
        assert_eq!(start(&from, 1.0, |_| false), vec![0.0; FINE * FINE]);
    }

    #[test]
    fn elements_that_overlap_or_lie_within_the_contact_are_pressed() {
        // u = 0.1 times the coarse row, which a cubic reproduces: overlap where u < 0.4 with a gap of 0.6.
        let corner = |[i, j]: [usize; 2]| f64::from(u8::from(i >= 6 && j >= 6));
        let from = coarser(corner, |[i, _]| 0.1 * i as f64, |_| false);
        let found = start(&from, 0.6, |_| false);
        for (e, p) in found.iter().enumerate() {
            let [i, j] = [e / FINE, e % FINE];
            // Beyond the outermost centres, the outermost lines are repeated.
            let row = (i as f64 / 2.0 - 0.25).max(0.0);
            let is_within = [i, j].iter().all(|i| *i >= 13);
            assert_eq!(*p > 0.0, row < 4.0 || is_within, "{i} {j}: {p}");
        }
    }

    #[test]
    fn no_pressure_crosses_an_outline() {
        // The relief's outline runs through the middle of the coarse column 3, which is on the relief.
        let pressure = |[_, j]: [usize; 2]| if j < 4 { 2.0 } else { 1.0 };
        let from = coarser(pressure, |_| 0.0, |[_, j]| j < 4);
        let found = start(&from, 0.5, |[_, j]| j < 7);
        for (e, p) in found.iter().enumerate() {
            let j = e % FINE;
            if j < 6 {
                assert!((p - 2.0).abs() < 1e-14, "{j}: {p}");
            } else if j > 7 {
                assert!((p - 1.0).abs() < 1e-14, "{j}: {p}");
            }
        }
        // Two of its elements are on its side.
        assert!((together(&found, [4, 3]) - 2.0 * 2.0).abs() < 1e-14);
    }

    #[test]
    fn on_a_rough_surface_gaps_smaller_than_their_error_belong_to_the_contact() {
        // Coarse columns 0 to 3 press: fine columns up to 6 lie within, 7 and 8 have shares of 3/4 and 1/4 around them.
        // The last column's displacement only widens the search.
        let pressure = |[_, j]: [usize; 2]| if j < 4 { 2.0 } else { 0.0 };
        let from = coarser(
            pressure,
            |[_, j]| if j == 7 { -1.0 } else { 0.0 },
            |_| false,
        );
        let gap = |[i, j]: [usize; 2]| match (j, i % 4) {
            (..7, _) if (i / 8 + j) % 2 == 0 => 0.2,
            (..7, _) => -0.2,
            (7, step) => [0.07, 0.08, 0.14, 0.16][step],
            (8, step) => [0.02, 0.03, 0.04, 0.06][step],
            _ => 0.5,
        };
        let start = |rough: Option<RoughSurface<'_>>| {
            let fine = FineGrid {
                initial_gap: &field(FINE, |place| 1.0 + gap(place)),
                outline: &field(FINE, |_| false),
                rough,
            };
            from.start_on(&Window::whole(FINE), &fine)
        };
        let with_springs = |eta: f64| {
            let relief_compliance = [eta; FINE * FINE];
            start(Some(RoughSurface {
                relief_compliance: &relief_compliance,
                spring_law: SpringLaw::LINEAR,
                shortest_compliance: 0.05,
                hardness: f64::INFINITY,
            }))
        };
        // The springs' 0.1 makes errors of 0.3 and 0.1 of the gaps, of which they take half.
        for (found, error) in [
            (start(None), 0.0),
            (with_springs(0.0), 0.2),
            (with_springs(0.05), 0.1),
        ] {
            for (e, p) in found.iter().enumerate() {
                let place = [e / FINE, e % FINE];
                let share = match place[1] {
                    ..7 => f64::INFINITY,
                    7 => 0.75,
                    8 => 0.25,
                    9..12 => 0.0,
                    _ => continue,
                };
                let belongs = share.is_infinite() || gap(place) < share * error;
                assert_eq!(*p > 0.0, belongs, "{error} {place:?}: {p}");
            }
        }
    }
}
