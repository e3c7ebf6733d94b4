//! The band of elements just outside the working set, where the result of a filter on the whole plane is forced to
//! vanish.
//!
//! With `F` the inverse of the system on the whole periodic grid, `I` the working set and `E` all elements outside, the
//! inverse of the system on `I` is the Schur complement `F_II − F_IE F_EE⁻¹ F_EI`. For a residual `r` on `I` its result
//! is `F (r + s)`, with the `s` on `E` that makes it vanish there:
//!
//! ```text
//! F_EE s = −(F r)_E
//! ```
//!
//! `F` decays so quickly that a band a few elements wide can represent all of `E`, and a few coefficients all of `F`.
//! Without the band the filter is wrong at the edge of the contact, which alone doubles the iterations.

use rayon::prelude::*;

use crate::{
    grid::region::Region,
    solver::gradient::{
        conjugate_gradients::{Directions, LinearSystem, SystemFields, solve},
        working_set::WorkingSet,
    },
    vector::{add_scaled, dot, update},
};

/// Offset along both axes up to which coefficients of `F` are used.
const REACH: usize = 3;
/// Coefficients along a side of a quarter of the stencil.
const QUARTER_SIDE: usize = REACH + 1;
/// Coefficients of `F` by offset along both axes.
pub type Stencil = [[f64; QUARTER_SIDE]; QUARTER_SIDE];
/// Elements from the set to the outer rim of the band, along both axes. One more does not help; one less costs a tenth
/// more products.
const WIDTH: usize = 3;
/// Relative residual to which `s` is solved, and the most steps for it: 3 are taken on a homogeneous body, up to all
/// under a stiff coating.
const ACCURACY: f64 = 0.1;
const MOST_STEPS: usize = 12;
/// Fewest elements per thread.
const ELEMENTS: usize = 1 << 12;

/// The band around one working set. Its fields hold one value for each of its elements.
pub struct EdgeBand {
    layout: Layout,
    /// The band's elements on the grid, ascending.
    elements: Vec<usize>,
    system: BandSystem,
    residual: Vec<f64>,
    directions: Directions,
    image: Vec<f64>,
}

/// The system `F_EE s = −(F r)_E`, as it is solved.
struct BandSystem {
    /// Places in a row of the field to which the stencil is applied.
    width: usize,
    coefficients: Stencil,
    /// The places of the band's elements in that field.
    places: Vec<usize>,
    /// Mirror images across axes of symmetry: their place, and the index of the mirrored element of the band.
    images: Vec<(usize, usize)>,
    /// The field to which the stencil is applied: 0 except on the band and its mirror images.
    spread: Vec<f64>,
    solution: Vec<f64>,
    /// `r·r` at the start; none before.
    start: Option<f64>,
}

impl EdgeBand {
    /// An empty band on a region.
    pub fn new(region: &Region) -> Self {
        let layout = Layout {
            lengths: region.lengths(),
            beyond: region.mirrored_lines(REACH),
        };
        Self {
            layout,
            elements: Vec::new(),
            system: BandSystem {
                width: layout.width(),
                coefficients: [[0.0; QUARTER_SIDE]; QUARTER_SIDE],
                places: Vec::new(),
                images: Vec::new(),
                spread: vec![0.0; layout.places()],
                solution: Vec::new(),
                start: None,
            },
            residual: Vec::new(),
            directions: Directions::new(0),
            image: Vec::new(),
        }
    }

    /// Sets the coefficients of `F`, by offset along the axes.
    pub fn take_coefficients(&mut self, coefficients: &Stencil) {
        self.system.coefficients = *coefficients;
    }

    /// Sets up the band around a set.
    pub fn surround(&mut self, set: &WorkingSet) {
        let layout = self.layout;
        let [_, size] = layout.lengths;
        let rows = layout.lines(0).into_par_iter();
        let rows = rows.with_min_len(ELEMENTS / size + 1);
        let rows = rows.map_init(
            || vec![false; size + 2 * WIDTH],
            |near, i| layout.band_in_row(i, set.mask(), near),
        );
        let rows: Vec<Vec<usize>> = rows.collect();
        self.elements.clear();
        self.elements.extend(rows.into_iter().flatten());
        self.system.take_places(layout, &self.elements);
        self.directions = Directions::new(self.elements.len());
        for field in [&mut self.residual, &mut self.image] {
            field.clear();
            field.resize(self.elements.len(), 0.0);
        }
    }

    pub fn is_empty(&self) -> bool {
        self.elements.is_empty()
    }

    /// Computes `s` for `filtered`, `F r`, and writes it into the band's elements of `field`.
    pub fn balance(&mut self, filtered: &[f64], field: &mut [f64]) {
        update(&mut self.residual, &self.elements, |r, e| {
            *r = -filtered[*e];
        });
        self.system.solution.fill(0.0);
        self.system.start = None;
        let fields = SystemFields {
            residual: &mut self.residual,
            directions: &mut self.directions,
            image: &mut self.image,
        };
        solve(&mut self.system, fields, MOST_STEPS);
        if self.system.has_start() {
            for (element, s) in self.elements.iter().zip(&self.system.solution) {
                field[*element] = *s;
            }
        }
    }
}

impl BandSystem {
    /// Sets the band's elements.
    fn take_places(&mut self, layout: Layout, elements: &[usize]) {
        let images = self.images.drain(..).map(|(place, _)| place);
        for place in self.places.drain(..).chain(images) {
            self.spread[place] = 0.0;
        }
        let [_, size] = layout.lengths;
        for (index, element) in elements.iter().enumerate() {
            let at = [element / size, element % size];
            self.places.push(layout.place(at));
            let images = layout.images(at).map(|place| (place, index));
            self.images.extend(images);
        }
        self.solution.resize(elements.len(), 0.0);
    }

    /// Whether the residual at the start is one to be balanced.
    fn has_start(&self) -> bool {
        (self.start).is_some_and(|start| start > 0.0 && start.is_finite())
    }

    /// Copies a direction into the field to which the stencil is applied.
    fn spread(&mut self, direction: &[f64]) {
        for (place, d) in self.places.iter().zip(direction) {
            self.spread[*place] = *d;
        }
        for (place, index) in &self.images {
            self.spread[*place] = direction[*index];
        }
    }
}

impl LinearSystem for BandSystem {
    fn precondition(&mut self, residual: &[f64]) -> f64 {
        dot(residual, residual)
    }

    fn is_solved(&mut self, product: f64) -> bool {
        match self.start {
            None => {
                self.start = Some(product);
                !self.has_start()
            }
            Some(start) => product <= ACCURACY * ACCURACY * start,
        }
    }

    fn correction<'a>(&'a mut self, residual: &'a [f64]) -> &'a [f64] {
        residual
    }

    /// Writes `F_EE d`.
    fn apply_into(&mut self, direction: &[f64], image: &mut [f64]) {
        self.spread(direction);
        let (spread, coefficients, width) = (&self.spread, &self.coefficients, self.width);
        update(image, &self.places, |y, place| {
            *y = stencil(&spread[place - REACH * (width + 1)..], width, coefficients);
        });
    }

    /// Truncated at the reach, `F_EE` may be indefinite under a stiff coating.
    fn take(&mut self, alpha: f64, direction: &[f64], _: f64) -> bool {
        let is_step = alpha > 0.0 && alpha.is_finite();
        if is_step {
            add_scaled(&mut self.solution, alpha, direction);
        }
        is_step
    }
}

/// The sum of a field times the coefficients around an element; the field starts at the place of the lowest offsets.
fn stencil(field: &[f64], width: usize, coefficients: &Stencil) -> f64 {
    let row = |i: usize| -> &[f64] { &field[i * width..][..=2 * REACH] };
    let mut sum = 0.0;
    for (i, coefficients) in coefficients.iter().enumerate() {
        let (above, below) = (row(REACH - i), row(REACH + i));
        for (j, coefficient) in coefficients.iter().enumerate() {
            let pair = |row: &[f64]| match j {
                0 => row[REACH],
                _ => row[REACH - j] + row[REACH + j],
            };
            let values = if i == 0 {
                pair(below)
            } else {
                pair(above) + pair(below)
            };
            sum += coefficient * values;
        }
    }
    sum
}

/// The places of the band's elements on the grid and in the field to which its stencil is applied, which also covers
/// elements beyond axes of symmetry.
#[derive(Clone, Copy)]
struct Layout {
    /// Rows, and elements per row.
    lengths: [usize; 2],
    /// Rows and columns before the first element.
    beyond: [usize; 2],
}

impl Layout {
    /// Places in a row.
    fn width(self) -> usize {
        self.lengths[1] + self.beyond[1]
    }

    fn places(self) -> usize {
        (self.lengths[0] + self.beyond[0]) * self.width()
    }

    fn place(self, [i, j]: [usize; 2]) -> usize {
        let [above, left] = self.beyond;
        (i + above) * self.width() + j + left
    }

    /// The places of an element's mirror images beyond the axes that are within reach of the stencil.
    fn images(self, [i, j]: [usize; 2]) -> impl Iterator<Item = usize> {
        // The image of element k from the axis lies at the same distance on the other side.
        let along = move |axis: usize, k: usize| {
            let beyond = self.beyond[axis];
            std::iter::once(k + beyond).chain(beyond.checked_sub(k + 1))
        };
        let places = along(0, i).flat_map(move |i| along(1, j).map(move |j| i * self.width() + j));
        places.skip(1)
    }

    /// Rows or columns that may hold the band: neither it nor the stencil leaves the grid.
    fn lines(self, axis: usize) -> std::ops::Range<usize> {
        let margin = WIDTH.max(REACH);
        let first = if self.beyond[axis] > 0 { 0 } else { margin };
        first..self.lengths[axis].saturating_sub(margin).max(first)
    }

    /// The band's elements in row `i`, ascending; `near` is a buffer for a row plus the width of the band on both
    /// sides.
    fn band_in_row(self, i: usize, mask: &[bool], near: &mut [bool]) -> Vec<usize> {
        let [_, size] = self.lengths;
        near.fill(false);
        // Elements beyond an axis are images of elements on this side, which are nearer.
        let first = i.saturating_sub(WIDTH);
        for row in mask[first * size..(i + WIDTH + 1) * size].chunks_exact(size) {
            let near = near[WIDTH..].iter_mut();
            near.zip(row).for_each(|(near, member)| *near |= member);
        }
        if !near.contains(&true) {
            return Vec::new();
        }
        let is_of_band =
            |j: &usize| !mask[i * size + j] && near[*j..=j + 2 * WIDTH].contains(&true);
        let columns = self.lines(1).filter(is_of_band);
        columns.map(|j| i * size + j).collect()
    }
}

#[cfg(test)]
mod tests;
