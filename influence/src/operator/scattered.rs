//! The product `K p` among scattered elements of a grid: near coefficients one by one, the smooth
//! remainder on a coarser grid.
//!
//! Within a radius `R` of elements the coefficient is split,
//!
//! ```text
//! k = near + smooth,    smooth = P(r²) for r < R, k beyond,
//! ```
//!
//! where the polynomial `P` interpolates `k` at eleven distances around `R`. So `near` is exact by definition and
//! vanishes beyond `R`, and `smooth` varies little over the spacing `h` of a coarser grid of nodes. It is interpolated
//! from `q` × `q` of these nodes at both ends:
//!
//! ```text
//! smooth_ij ≈ Σ_ab L_a(i) smooth(h (a − b)) L_b(j)
//! ```
//!
//! The sum over nodes is a convolution on a grid with 1/h² as many elements. (Brandt and Lubrecht 1990; the split as in
//! Skeel, Tezcan and Hardy 2002.)

mod runs;
mod smooth;

use rayon::prelude::*;

pub use self::runs::scattered_work;
use self::runs::{Run, Runs};
use self::smooth::{NEAR_WIDTH, ORDER, RADIUS, SPACING, Smooth, weights};
use super::ElasticOperator;
use super::convolution::ConvolutionOperator;
use crate::coefficient_table::CoefficientTable;

/// Smallest number of elements along a side.
const SMALLEST: usize = 2 * RADIUS;
/// Number of runs that justify a thread of their own.
const RUNS: usize = 64;

/// `u = K p` among listed elements of a grid.
///
/// The cost is that of the near pairs of elements and of a product on a grid with a sixth of the elements per side.
/// The error is 2e-9 of the largest displacement (test `scattered_elements_are_displaced_like_the_whole_grid`): a
/// solution obtained with it is exact, or one step of iterative refinement from exact. The bits are the same for
/// every number of threads.
pub struct ScatteredOperator {
    runs: Runs,
    /// For each row or column of elements: its first node, and the weights of its nodes.
    lines: Vec<(usize, [f64; ORDER])>,
    /// `near` at the offsets (m, n), m and |n| < R, row by row from the smallest n.
    near: Vec<f64>,
    coarse: ConvolutionOperator,
    /// Pressures and displacements of the nodes.
    nodes: [Vec<f64>; 2],
    /// The loaded part of each run.
    pressing: Vec<[usize; 2]>,
}

impl ScatteredOperator {
    /// The operator for elements, given by ascending indices `i N + j`, of a window of `size` × `size` elements; `None`
    /// if the window is too small for a gain.
    ///
    /// # Panics
    /// If `size` is above the table's, or an index is outside the window.
    #[must_use]
    pub fn new(table: &CoefficientTable, size: usize, elements: &[u32]) -> Option<Self> {
        assert!(size <= table.size(), "a window within the coefficients");
        if size < SMALLEST {
            return None;
        }
        let rest = Smooth::new(table);
        // Half a stencil beyond the elements on either side.
        let nodes = size.div_ceil(SPACING) + ORDER;
        let origin = ((size - 1).cast_signed() - (SPACING * (nodes - 1)).cast_signed()) / 2;
        let coarse = rest.on_nodes(nodes).ok()?;
        let mut operator = Self {
            lines: (0..size).map(|line| weights(line, origin, nodes)).collect(),
            near: rest.near(),
            coarse: ConvolutionOperator::new(&coarse),
            nodes: [vec![0.0; nodes * nodes], vec![0.0; nodes * nodes]],
            runs: Runs::default(),
            pressing: Vec::new(),
        };
        operator.list(elements);
        Some(operator)
    }

    /// Switches to other elements of the same window.
    ///
    /// # Panics
    /// If an index is outside the window.
    pub fn list(&mut self, elements: &[u32]) {
        let size = self.lines.len();
        let is_within = |element: &u32| (*element as usize) < size * size;
        assert!(elements.iter().all(is_within), "elements of the window");
        self.runs = Runs::of(size, elements);
        self.pressing = vec![[0, 0]; self.runs.runs.len()];
    }

    /// Writes the displacements (m, positive into the body) of the elements under their pressures (Pa, positive in
    /// compression), both in the order of the list.
    ///
    /// # Panics
    /// If a field does not have one value per element.
    pub fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        let elements = self.runs.runs.last().map_or(0, |run| run.end);
        assert_eq!([pressure.len(), displacement.len()], [elements; 2]);
        self.press_nodes(pressure);
        let [pressures, displacements] = &mut self.nodes;
        self.coarse.apply_into(pressures, displacements);
        for (pressing, run) in self.pressing.iter_mut().zip(&self.runs.runs) {
            let presses = |at: &usize| pressure[*at] != 0.0;
            let first = (run.start..run.end).find(presses).unwrap_or(run.end);
            let last = (first..run.end).rfind(presses).unwrap_or(first);
            *pressing = [first, (last + 1).min(run.end)];
        }
        let this = &*self;
        let mut parts = Vec::with_capacity(this.runs.runs.len().div_ceil(RUNS));
        let mut rest = displacement;
        for runs in this.runs.runs.chunks(RUNS) {
            let (part, others) = rest.split_at_mut(runs.iter().map(Run::len).sum());
            parts.push((runs, part));
            rest = others;
        }
        parts.into_par_iter().for_each(|(runs, part)| {
            let mut part = part;
            for run in runs {
                let (own, others) = part.split_at_mut(run.len());
                this.displace(*run, pressure, own);
                part = others;
            }
        });
    }

    /// Distributes the pressures over the nodes.
    fn press_nodes(&mut self, pressure: &[f64]) {
        let width = self.coarse.size();
        let nodes = &mut self.nodes[0];
        nodes.fill(0.0);
        for run in &self.runs.runs {
            let (top, down) = &self.lines[run.row];
            for (at, (left, along)) in (run.start..run.end).zip(&self.lines[run.first..]) {
                let p = pressure[at];
                if p == 0.0 {
                    continue;
                }
                for (row, weight) in (*top..).zip(down) {
                    let nodes = &mut nodes[row * width + left..][..ORDER];
                    let share = weight * p;
                    nodes
                        .iter_mut()
                        .zip(along)
                        .for_each(|(node, w)| *node += share * w);
                }
            }
        }
    }

    /// The displacements of one run.
    fn displace(&self, run: Run, pressure: &[f64], displacement: &mut [f64]) {
        let width = self.coarse.size();
        let (top, down) = &self.lines[run.row];
        for (u, (left, along)) in displacement.iter_mut().zip(&self.lines[run.first..]) {
            let rows = (*top..).zip(down);
            let terms = rows.map(|(row, weight)| {
                let nodes = &self.nodes[1][row * width + left..][..ORDER];
                weight * nodes.iter().zip(along).map(|(u, w)| u * w).sum::<f64>()
            });
            *u = terms.sum();
        }
        for other in self.runs.near(run) {
            let [from, to] = self.pressing[other];
            if from == to {
                continue;
            }
            let other = self.runs.runs[other];
            let near = &self.near[run.row.abs_diff(other.row) * NEAR_WIDTH..][..NEAR_WIDTH];
            let first = other.first + from - other.start;
            for (column, u) in (run.first..).zip(&mut *displacement) {
                *u += dot_near(near, column, first, &pressure[from..to]);
            }
        }
    }
}

/// `Σ near(column − first − i) pᵢ`, over those within the table.
fn dot_near(near: &[f64], column: usize, first: usize, pressure: &[f64]) -> f64 {
    // The number of pressures too far to the left, and the table entry of the first remaining one.
    let skipped = column.saturating_sub(first + RADIUS - 1);
    let place = first + skipped + RADIUS - 1 - column;
    let (Some(near), Some(pressure)) = (near.get(place..), pressure.get(skipped..)) else {
        return 0.0;
    };
    let common = near.len().min(pressure.len());
    let (near_lanes, near_rest) = near[..common].as_chunks::<4>();
    let (lanes, rest) = pressure[..common].as_chunks::<4>();
    let mut sums = [0.0; 4];
    for (k, p) in near_lanes.iter().zip(lanes) {
        for lane in 0..4 {
            sums[lane] += k[lane] * p[lane];
        }
    }
    let rest: f64 = near_rest.iter().zip(rest).map(|(k, p)| k * p).sum();
    sums.iter().sum::<f64>() + rest
}

impl std::fmt::Debug for ScatteredOperator {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut shown = formatter.debug_struct("ScatteredOperator");
        shown
            .field("runs", &self.runs.runs.len())
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests;
