//! The fields of an element at the offsets of a quarter of a grid.
//!
//! Corners are shared by the elements around them, so that the closed form takes one of them for each offset. Where
//! point kernels are smooth over several elements, their mean over one is a sum of their values at the centres of
//! those around it: with the weights below it is exact for polynomials of degree 11, and wrong by `2e-6 ∂¹²f` in units
//! of the element's side.

use rayon::prelude::*;

use super::element::ElementFields;
use super::homogeneous::Corners;
use super::state::{FIELDS, SubsurfaceState, SurfaceLoad};

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

/// One field after the other, each a row of numbers or a square of rows.
type PerField<T> = [T; FIELDS];

/// The fields under one load at `size` × `size` offsets, and the buffer of the means along y.
pub struct ElementTable {
    size: usize,
    fields: PerField<Vec<f64>>,
    means: PerField<Vec<f64>>,
}

impl ElementTable {
    pub fn new(size: usize) -> Self {
        Self {
            size,
            fields: std::array::from_fn(|_| vec![0.0; size * size]),
            means: std::array::from_fn(|_| vec![0.0; size * (size + 2 * REACH)]),
        }
    }

    /// A field at the offsets (m, n), row after row.
    pub fn field(&self, index: usize) -> &[f64] {
        &self.fields[index]
    }

    /// Computes the fields of an element.
    pub fn fill(&mut self, element: &ElementFields, load: SurfaceLoad) {
        let (size, side) = (self.size, element.element_side);
        let smooth = element.kernels.as_ref().map(|kernels| {
            let mut rows = groups_of_rows(&mut self.means, size);
            rows.par_iter_mut().enumerate().for_each(|(row, means)| {
                // From REACH rows before the first on.
                let x = (row as f64 - REACH as f64) * side;
                mean_along_y(|y| kernels.at(load, [x, y]) * (side * side), side, means);
            });
            (kernels.reach / side, &self.means)
        });
        let material = element.foundation.surface_material();
        let corners = Corners::new(load, &material, side, element.depth);
        let mut groups = groups_of_rows(&mut self.fields, ROWS * size);
        groups
            .par_iter_mut()
            .enumerate()
            .for_each(|(group, fields)| {
                let first = ROWS * group;
                match smooth {
                    None => fields.iter_mut().for_each(|field| field.fill(0.0)),
                    Some((reach, means)) => {
                        mean_along_x(fields, first, size, means);
                        integrate_near(fields, first, size, reach, |offset| {
                            element.smooth_part(load, offset.map(|along| along * side))
                        });
                    }
                }
                if element.has_homogeneous {
                    add_corners(fields, first, size, |place| {
                        corners.at(place.map(|along| along * side))
                    });
                }
            });
    }
}

/// The same rows, `length` numbers of each field, together.
fn groups_of_rows(fields: &mut PerField<Vec<f64>>, length: usize) -> Vec<PerField<&mut [f64]>> {
    let mut chunks = fields.each_mut().map(|field| field.chunks_mut(length));
    let count = chunks[0].len();
    let mut next = || std::array::from_fn(|f| chunks[f].next().unwrap_or_default());
    (0..count).map(|_| next()).collect()
}

/// Means of a function over elements along y, from 0 on.
fn mean_along_y(
    value: impl Fn(f64) -> SubsurfaceState,
    side: f64,
    means: &mut PerField<&mut [f64]>,
) {
    let count = means[0].len() + 2 * REACH;
    let states = (0..count).map(|n| value((n as f64 - REACH as f64) * side));
    let states: Vec<SubsurfaceState> = states.collect();
    let mut line = vec![0.0; count];
    for (f, means) in means.iter_mut().enumerate() {
        for (value, state) in line.iter_mut().zip(&states) {
            *value = state.field(f);
        }
        for (mean, around) in means.iter_mut().zip(line.windows(2 * REACH + 1)) {
            *mean = weighted(|i| around[i]);
        }
    }
}

/// Writes the means along x of the means along y to rows from `first` on.
fn mean_along_x(
    fields: &mut PerField<&mut [f64]>,
    first: usize,
    size: usize,
    means: &PerField<Vec<f64>>,
) {
    for (field, means) in fields.iter_mut().zip(means) {
        for (m, row) in (first..).zip(field.chunks_exact_mut(size)) {
            let around: [&[f64]; 2 * REACH + 1] =
                std::array::from_fn(|i| &means[(m + i) * size..][..size]);
            for (n, entry) in row.iter_mut().enumerate() {
                *entry = weighted(|i| around[i][n]);
            }
        }
    }
}

/// Replaces the means of rows from `first` on by integrals where the point load is too near.
fn integrate_near(
    fields: &mut PerField<&mut [f64]>,
    first: usize,
    size: usize,
    reach: f64,
    integral: impl Fn([f64; 2]) -> SubsurfaceState,
) {
    for row in 0..fields[0].len() / size {
        let x = (first + row) as f64;
        let is_near = |n: &usize| x.hypot(*n as f64).hypot(reach) < SMOOTH_FROM;
        for n in (0..size).take_while(is_near) {
            let state = integral([x, n as f64]);
            for (f, field) in fields.iter_mut().enumerate() {
                field[row * size + n] = state.field(f);
            }
        }
    }
}

/// Adds the sums over the corners, with signs, of a function of the places that they are seen at, in elements.
fn add_corners(
    fields: &mut PerField<&mut [f64]>,
    first: usize,
    size: usize,
    corner: impl Fn([f64; 2]) -> SubsurfaceState,
) {
    let corners_at = |x: f64| -> Vec<SubsurfaceState> {
        (0..=size).map(|n| corner([x, n as f64 - 0.5])).collect()
    };
    let mut after = corners_at(first as f64 - 0.5);
    for row in 0..fields[0].len() / size {
        let before = after;
        after = corners_at((first + row) as f64 + 0.5);
        for (f, field) in fields.iter_mut().enumerate() {
            let pairs = before.windows(2).zip(after.windows(2));
            let row = &mut field[row * size..(row + 1) * size];
            for (entry, (before, after)) in row.iter_mut().zip(pairs) {
                let along = |pair: &[SubsurfaceState]| pair[1].field(f) - pair[0].field(f);
                *entry += along(after) - along(before);
            }
        }
    }
}

/// The weighted sum of a value and those around it.
fn weighted(value: impl Fn(usize) -> f64) -> f64 {
    let mut sum = value(REACH) * WEIGHTS[0];
    for (i, weight) in WEIGHTS.iter().enumerate().skip(1) {
        sum += (value(REACH - i) + value(REACH + i)) * weight;
    }
    sum
}
