//! The band of elements just outside the working set, where the answer of a filter of the whole plane must be made to vanish.
//!
//! With `F` the inverse of the system on the whole periodic grid, `I` the working set and `E` all that lies outside, the inverse of the system on `I`
//! is the Schur complement `F_II − F_IE F_EE⁻¹ F_EI`: it answers a residual `r` on `I` by `F (r + s)`, with the `s` on `E` that makes the answer
//! vanish there:
//!
//! ```text
//! F_EE s = −(F r)_E
//! ```
//!
//! `F` falls off so quickly that a band a few elements wide stands for all of `E`, and a few of its coefficients for all of them. Without the
//! band the filter is wrong at the contact's edge, and that alone takes twice the iterations.

use rayon::prelude::*;

use super::working_set::WorkingSet;
use crate::vector::{add_scaled, dot, update};

/// Elements from the set to the outer rim of the band, along both axes. One more gains nothing, one less costs a tenth more products.
const WIDTH: usize = 3;
/// Offset along both axes up to which the coefficients of `F` are counted.
const REACH: usize = 3;
/// The band and its coefficients stay on the grid.
const MARGIN: usize = if WIDTH > REACH { WIDTH } else { REACH };
/// Part of its residual to which `s` is found, and the steps after which it is good enough as it is: 3 on a homogeneous body, up to all under
/// a stiff coat.
const ACCURACY: f64 = 0.05;
const MOST_STEPS: usize = 12;
/// Elements of the band worth a thread of their own.
const PART: usize = 1 << 10;

/// The band around one working set.
pub struct EdgeBand {
    size: usize,
    elements: Vec<usize>,
    /// Distances in a field's index, and `F` there.
    coefficients: Vec<(isize, f64)>,
    /// The direction of the iteration on the grid, 0 outside the band.
    spread: Vec<f64>,
}

impl EdgeBand {
    /// An empty band on a grid of `size` elements per side.
    pub fn new(size: usize) -> Self {
        Self {
            size,
            elements: Vec::new(),
            coefficients: Vec::new(),
            spread: vec![0.0; size * size],
        }
    }

    /// Takes the coefficients of `F` from its answer to a unit at element 0.
    pub fn take_coefficients(&mut self, answer: &[f64]) {
        let reach = REACH.min(self.size.saturating_sub(1) / 2).cast_signed();
        let size = self.size.cast_signed();
        let along = |offset: isize| offset.rem_euclid(size).cast_unsigned();
        let offsets = (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| [i, j]));
        self.coefficients = offsets
            .map(|[i, j]| (i * size + j, answer[along(i) * self.size + along(j)]))
            .collect();
    }

    /// Lays the band around a set.
    pub fn surround(&mut self, set: &WorkingSet) {
        let rows = MARGIN..self.size.saturating_sub(MARGIN);
        let rows = rows.into_par_iter();
        let parts: Vec<Vec<usize>> = rows.map(|i| self.row(i, set.mask())).collect();
        self.elements.clear();
        self.elements.extend(parts.into_iter().flatten());
    }

    /// The band's elements in row `i`.
    fn row(&self, i: usize, mask: &[bool]) -> Vec<usize> {
        let size = self.size;
        let mut near = vec![false; size];
        for row in mask[(i - WIDTH) * size..(i + WIDTH + 1) * size].chunks_exact(size) {
            for (near, member) in near.iter_mut().zip(row) {
                *near |= member;
            }
        }
        let belongs = |j: &usize| {
            let around = &near[j - WIDTH..=j + WIDTH];
            !mask[i * size + j] && around.iter().any(|near| *near)
        };
        let columns = MARGIN..size - MARGIN;
        columns.filter(belongs).map(|j| i * size + j).collect()
    }

    pub fn is_empty(&self) -> bool {
        self.elements.is_empty()
    }

    /// Writes `s` for the `answer` `F r` into the band's elements of `field`: conjugate gradients on `F_EE s = −(F r)_E`.
    pub fn balance(&mut self, answer: &[f64], field: &mut [f64]) {
        let mut residual: Vec<f64> = self.elements.iter().map(|e| -answer[*e]).collect();
        let mut direction = residual.clone();
        let mut solution = vec![0.0; residual.len()];
        let mut image = vec![0.0; residual.len()];
        let mut product = dot(&residual, &residual);
        let enough = ACCURACY * ACCURACY * product;
        for _ in 0..MOST_STEPS {
            self.multiply(&direction, &mut image);
            let alpha = product / dot(&direction, &image);
            // Cut off at the reach, F_EE may be indefinite under a stiff coat.
            if !(alpha > 0.0 && alpha.is_finite()) {
                break;
            }
            add_scaled(&mut solution, alpha, &direction);
            add_scaled(&mut residual, -alpha, &image);
            let before = std::mem::replace(&mut product, dot(&residual, &residual));
            if product <= enough {
                break;
            }
            update(&mut direction, &residual, |d, r| {
                *d = r + product / before * *d;
            });
        }
        for (element, s) in self.elements.iter().zip(&solution) {
            field[*element] = *s;
        }
    }

    /// `F_EE d`, into `image`.
    fn multiply(&mut self, direction: &[f64], image: &mut [f64]) {
        for (element, d) in self.elements.iter().zip(direction) {
            self.spread[*element] = *d;
        }
        let (spread, coefficients) = (&self.spread, &self.coefficients);
        let sum_at = |element: usize| {
            let terms = coefficients.iter().map(|(distance, f)| {
                let place = element.wrapping_add_signed(*distance);
                f * spread[place]
            });
            terms.sum::<f64>()
        };
        image
            .par_chunks_mut(PART)
            .zip(self.elements.par_chunks(PART))
            .for_each(|(image, elements)| {
                for (y, element) in image.iter_mut().zip(elements) {
                    *y = sum_at(*element);
                }
            });
        for element in &self.elements {
            self.spread[*element] = 0.0;
        }
    }
}
