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

use std::ops::Range;

use rayon::prelude::*;

use super::working_set::WorkingSet;
use crate::{
    sector::Sector,
    vector::{add_scaled, dot, update},
};

/// Elements from the set to the outer rim of the band, along both axes. One more gains nothing, one less costs a tenth more products.
const WIDTH: usize = 3;
/// Offset along both axes up to which the coefficients of `F` are counted.
const REACH: usize = 3;
/// Coefficients in a row of the stencil, and one that is 0, because processors take them by fours.
const LANES: usize = 8;
/// The band and its coefficients stay on the grid.
const MARGIN: usize = if WIDTH > REACH { WIDTH } else { REACH };
/// Coefficients of a quarter of the stencil along a side.
const ANSWERS: usize = REACH + 1;
/// Part of its residual to which `s` is found, and the steps after which it is good enough as it is: 3 on a homogeneous body, up to all under
/// a stiff coat.
const ACCURACY: f64 = 0.1;
const MOST_STEPS: usize = 12;
/// Elements of the band worth a thread of their own.
const PART: usize = 1 << 10;

/// The band around one working set.
pub struct EdgeBand {
    size: usize,
    sector: Sector,
    elements: Vec<usize>,
    /// `F` by offset from −`REACH` on, in units of `F(0)`.
    coefficients: [[f32; LANES]; 2 * REACH + 1],
    own_coefficient: f64,
    /// A field that the stencil is laid over, on the grid, what it reaches beyond the axes of a quadrant, and some room behind it.
    spread: Vec<f32>,
    /// Where in it each of the band's elements lies.
    places: Vec<usize>,
    /// Where in it mirror images lie, and of which of the band's elements.
    images: Vec<(usize, usize)>,
    residual: Vec<f64>,
    direction: Vec<f64>,
    solution: Vec<f64>,
    image: Vec<f64>,
}

impl EdgeBand {
    /// An empty band on a sector of `size` elements per side.
    pub fn new(size: usize, sector: Sector) -> Self {
        let width = size + beyond_axis(sector);
        Self {
            size,
            sector,
            elements: Vec::new(),
            coefficients: [[0.0; LANES]; 2 * REACH + 1],
            own_coefficient: 1.0,
            spread: vec![0.0; width * width + LANES],
            places: Vec::new(),
            images: Vec::new(),
            residual: Vec::new(),
            direction: Vec::new(),
            solution: Vec::new(),
            image: Vec::new(),
        }
    }

    /// Takes the coefficients of `F`, its answers to a unit by offset along the axes.
    pub fn take_coefficients(&mut self, answers: &[[f64; ANSWERS]; ANSWERS]) {
        self.own_coefficient = answers[0][0];
        for (i, row) in self.coefficients.iter_mut().enumerate() {
            for (j, f) in row.iter_mut().take(2 * REACH + 1).enumerate() {
                *f = narrow(answers[i.abs_diff(REACH)][j.abs_diff(REACH)] / answers[0][0]);
            }
        }
    }

    /// Lays the band around a set.
    pub fn surround(&mut self, set: &WorkingSet) {
        let rows = self.lines().into_par_iter();
        let parts: Vec<Vec<usize>> = rows.map(|i| self.row(i, set.mask())).collect();
        self.elements.clear();
        self.elements.extend(parts.into_iter().flatten());
        let (size, beyond) = (self.size, beyond_axis(self.sector));
        let place = |[i, j]: [usize; 2]| i * (size + beyond) + j;
        self.places.clear();
        self.images.clear();
        for (index, e) in self.elements.iter().enumerate() {
            let [i, j] = [e / size, e % size];
            self.places.push(place([i + beyond, j + beyond]));
            // The images of the element k from the axis lies as far on the other side, if the stencil reaches there.
            let along = |k: usize| std::iter::once(k + beyond).chain((beyond).checked_sub(k + 1));
            let images = along(i).flat_map(|i| along(j).map(move |j| [i, j]));
            self.images
                .extend(images.skip(1).map(|image| (place(image), index)));
        }
    }

    /// Rows, and columns, that the band may lie in: neither it nor the stencil leaves the grid.
    fn lines(&self) -> Range<usize> {
        let first = match self.sector {
            Sector::Whole => MARGIN,
            Sector::Quadrant => 0,
        };
        first..self.size.saturating_sub(MARGIN)
    }

    /// The band's elements in row `i`.
    fn row(&self, i: usize, mask: &[bool]) -> Vec<usize> {
        let size = self.size;
        let mut near = vec![false; size];
        // What lies beyond an axis is mirrored by what lies on this side, and nearer.
        let first = i.saturating_sub(WIDTH);
        for row in mask[first * size..(i + WIDTH + 1) * size].chunks_exact(size) {
            for (near, member) in near.iter_mut().zip(row) {
                *near |= member;
            }
        }
        let belongs = |j: &usize| {
            let around = &near[j.saturating_sub(WIDTH)..=j + WIDTH];
            !mask[i * size + j] && around.iter().any(|near| *near)
        };
        let columns = self.lines();
        columns.filter(belongs).map(|j| i * size + j).collect()
    }

    pub fn is_empty(&self) -> bool {
        self.elements.is_empty()
    }

    /// Writes `s` for the `answer` `F r` into the band's elements of `field`: conjugate gradients on `F_EE s = −(F r)_E`.
    pub fn balance(&mut self, answer: &[f64], field: &mut [f64]) {
        let largest = self.elements.iter().map(|e| answer[*e].abs());
        let unit = largest.fold(0.0, f64::max);
        if !(unit > 0.0 && unit.is_finite()) {
            return;
        }
        self.residual.clear();
        self.residual
            .extend(self.elements.iter().map(|e| -answer[*e] / unit));
        self.solve();
        let unit = unit / self.own_coefficient;
        for (element, s) in self.elements.iter().zip(&self.solution) {
            field[*element] = unit * s;
        }
    }

    /// Solves for the residual, all in units of 1.
    fn solve(&mut self) {
        self.direction.clone_from(&self.residual);
        for field in [&mut self.solution, &mut self.image] {
            field.clear();
            field.resize(self.elements.len(), 0.0);
        }
        let mut product = dot(&self.residual, &self.residual);
        let enough = ACCURACY * ACCURACY * product;
        for _ in 0..MOST_STEPS {
            self.multiply();
            let alpha = product / dot(&self.direction, &self.image);
            // Cut off at the reach, F_EE may be indefinite under a stiff coat.
            if !(alpha > 0.0 && alpha.is_finite()) {
                break;
            }
            add_scaled(&mut self.solution, alpha, &self.direction);
            add_scaled(&mut self.residual, -alpha, &self.image);
            let before = std::mem::replace(&mut product, dot(&self.residual, &self.residual));
            if product <= enough {
                break;
            }
            update(&mut self.direction, &self.residual, |d, r| {
                *d = r + product / before * *d;
            });
        }
    }

    /// `F_EE d`, into the image, in units of `F(0)`.
    fn multiply(&mut self) {
        for (place, d) in self.places.iter().zip(&self.direction) {
            self.spread[*place] = narrow(*d);
        }
        for (place, of) in &self.images {
            self.spread[*place] = narrow(self.direction[*of]);
        }
        let width = self.size + beyond_axis(self.sector);
        let (spread, coefficients) = (&self.spread, &self.coefficients);
        let parts = self.places.par_chunks(PART);
        let parts = self.image.par_chunks_mut(PART).zip(parts);
        parts.for_each(|(image, places)| {
            for (y, place) in image.iter_mut().zip(places) {
                let corner = place - REACH * (width + 1);
                *y = f64::from(stencil(&spread[corner..], width, coefficients));
            }
        });
        let images = self.images.iter().map(|(place, _)| place);
        for place in self.places.iter().chain(images) {
            self.spread[*place] = 0.0;
        }
    }
}

/// Rows and columns before a sector's first that the stencil reaches.
fn beyond_axis(sector: Sector) -> usize {
    match sector {
        Sector::Whole => 0,
        Sector::Quadrant => REACH,
    }
}

/// The sum of a field times the coefficients, the first of both together.
fn stencil(field: &[f32], size: usize, coefficients: &[[f32; LANES]]) -> f32 {
    let mut sums = [0.0; LANES];
    for (i, coefficients) in coefficients.iter().enumerate() {
        let values = &field[i * size..i * size + LANES];
        for lane in 0..LANES {
            sums[lane] += coefficients[lane] * values[lane];
        }
    }
    sums.iter().sum()
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "a few digits are what is wanted"
)]
fn narrow(value: f64) -> f32 {
    value as f32
}
