//! The fields of an element at the offsets of a quarter of a grid.
//!
//! Corners are shared by the elements around them, so that the closed form takes one of them for each offset. Where
//! point kernels are smooth over several elements, their mean over one is a sum of their values at the centres of
//! those around it: with the weights below it is exact for polynomials of degree 11, and wrong by `2e-6 ∂¹²f` in units
//! of the element's side.

use rayon::prelude::*;

use super::element::{ElementFields, SurfaceLoad};
use super::homogeneous::Corners;
use super::point_kernels::PointKernels;
use super::state::SubsurfaceState;

/// Elements to either side whose centres count in a mean.
const REACH: usize = 5;

/// Weights of the mean over an element, by the distance of the centre: `Σ_j c_j j^(2i) = 1/((2i + 1) 4^i)`.
const WEIGHTS: [f64; REACH + 1] = [
    9_038_561_117.0 / 10_218_700_800.0,
    147_010_729.0 / 2_270_822_400.0,
    -41_765_827.0 / 5_109_350_400.0,
    7_793_123.0 / 5_839_257_600.0,
    -10_156_403.0 / 61_312_204_800.0,
    1_295_803.0 / 122_624_409_600.0,
];

/// Distance from the point load, with the reach of its kernels, in elements, from which the mean is right to 1e-13.
const SMOOTH_FROM: f64 = 20.0;

/// Rows computed together, which share their corners.
const ROWS: usize = 8;

/// The states under one load at `size` × `size` offsets, and the buffer of the means along y.
pub struct ElementTable {
    size: usize,
    states: Vec<SubsurfaceState>,
    means: Vec<SubsurfaceState>,
}

impl ElementTable {
    pub fn new(size: usize) -> Self {
        Self {
            size,
            states: vec![SubsurfaceState::default(); size * size],
            means: vec![SubsurfaceState::default(); size * (size + 2 * REACH)],
        }
    }

    /// The state at the offset (m, n).
    pub fn state(&self, [m, n]: [usize; 2]) -> &SubsurfaceState {
        &self.states[m * self.size + n]
    }

    /// Computes the states of an element.
    pub fn fill(&mut self, fields: &ElementFields, load: SurfaceLoad) {
        let (size, side) = (self.size, fields.element_side);
        let means = fields.kernels.as_ref().map(|kernels| {
            let rows = self.means.par_chunks_mut(size).enumerate();
            // From REACH rows before the first on.
            rows.for_each(|(row, means)| {
                mean_along_y(
                    kernels,
                    load,
                    (row as f64 - REACH as f64) * side,
                    side,
                    means,
                );
            });
            (kernels, &self.means[..])
        });
        let material = fields.foundation.surface_material();
        let corners = fields
            .has_homogeneous
            .then(|| Corners::new(load, &material, side, fields.depth));
        let groups = self.states.par_chunks_mut(ROWS * size).enumerate();
        groups.for_each(|(group, states)| {
            let first = ROWS * group;
            let mut before = vec![SubsurfaceState::default(); size + 1];
            let mut after = before.clone();
            if let Some(corners) = &corners {
                corner_row(corners, first as f64 - 0.5, side, &mut after);
            }
            for (m, row) in (first..).zip(states.chunks_exact_mut(size)) {
                row.fill(SubsurfaceState::default());
                if let Some((kernels, means)) = means {
                    add_smooth_part(row, (m, fields, kernels, load), means);
                }
                if let Some(corners) = &corners {
                    std::mem::swap(&mut before, &mut after);
                    corner_row(corners, m as f64 + 0.5, side, &mut after);
                    for (n, state) in row.iter_mut().enumerate() {
                        *state += after[n + 1] + before[n] + (after[n] + before[n + 1]) * -1.0;
                    }
                }
            }
        });
    }
}

/// The functions of the corners from which a row of points lies `x` elements away.
fn corner_row(corners: &Corners, x: f64, side: f64, row: &mut [SubsurfaceState]) {
    for (n, corner) in row.iter_mut().enumerate() {
        *corner = corners.at([x * side, (n as f64 - 0.5) * side]);
    }
}

/// The area of an element times the mean of the kernels over elements along y, at `x` (m).
fn mean_along_y(
    kernels: &PointKernels,
    load: SurfaceLoad,
    x: f64,
    side: f64,
    means: &mut [SubsurfaceState],
) {
    let from = |n: usize| [x, (n as f64 - REACH as f64) * side];
    let values: Vec<_> = (0..means.len() + 2 * REACH)
        .map(|n| kernels.at(load, from(n)) * (side * side))
        .collect();
    for (mean, around) in means.iter_mut().zip(values.windows(2 * REACH + 1)) {
        *mean = weighted(|i| around[i]);
    }
}

/// Adds the part of point loads to the row `m`: means of the means along y, integrals where these are too near.
fn add_smooth_part(
    row: &mut [SubsurfaceState],
    (m, fields, kernels, load): (usize, &ElementFields, &PointKernels, SurfaceLoad),
    means: &[SubsurfaceState],
) {
    let (size, side) = (row.len(), fields.element_side);
    let reach = kernels.reach / side;
    for (n, state) in row.iter_mut().enumerate() {
        let [x, y] = [m, n].map(|offset| offset as f64);
        *state += if x.hypot(y).hypot(reach) < SMOOTH_FROM {
            fields.smooth_part(load, [x * side, y * side])
        } else {
            weighted(|i| means[(m + i) * size + n])
        };
    }
}

/// The weighted sum of a value and those around it.
fn weighted(value: impl Fn(usize) -> SubsurfaceState) -> SubsurfaceState {
    let mut sum = value(REACH) * WEIGHTS[0];
    for (i, weight) in WEIGHTS.iter().enumerate().skip(1) {
        sum += (value(REACH - i) + value(REACH + i)) * *weight;
    }
    sum
}
