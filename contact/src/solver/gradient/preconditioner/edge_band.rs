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

mod layout;
mod stencil;

use pulp::Arch;
use rayon::prelude::*;

pub use self::stencil::Stencil;
use self::{
    layout::Layout,
    stencil::{Group, REACH, SingleStencil, Stencils, TOGETHER},
};
use crate::{
    grid::region::Region,
    solver::gradient::{
        conjugate_gradients::{Directions, LinearSystem, SystemFields, solve},
        working_set::WorkingSet,
    },
    vector::{add_scaled, dot, single, update},
};

/// Elements from the set to the outer rim of the band, along both axes. One more does not help; one less costs a tenth
/// more products.
const WIDTH: usize = 3;
/// Relative residual to which `s` is solved, and the most steps for it: 3 are taken on a homogeneous body, up to all
/// under a stiff coating.
const ACCURACY: f64 = 0.1;
const MOST_STEPS: usize = 12;
/// Fewest elements per thread.
const ELEMENTS: usize = 1 << 12;
/// Groups of places per thread.
const GROUPS: usize = 1 << 10;

/// The band around one working set. Its fields hold one value for each of its elements.
pub struct EdgeBand {
    layout: Layout,
    /// The set that it surrounds.
    inside: Vec<bool>,
    /// The band's elements on the grid, ascending, row by row.
    rows: Vec<Vec<usize>>,
    elements: Vec<usize>,
    /// The same as a mask.
    mask: Vec<bool>,
    system: BandSystem,
    /// The first coefficient of `F`.
    unit: f64,
    residual: Vec<f64>,
    directions: Directions,
    image: Vec<f64>,
}

/// The system `F_EE s = −(F r)_E`, as it is solved.
struct BandSystem {
    layout: Layout,
    coefficients: SingleStencil,
    /// The places of the band's elements in the field to which the stencil is applied.
    places: Vec<usize>,
    /// Adjacent places at which the stencil is applied at once, ascending.
    groups: Vec<Group>,
    /// Mirror images across axes of symmetry: their place, and the index of the mirrored element of the band.
    images: Vec<(usize, usize)>,
    /// The field to which the stencil is applied: 0 except on the band and its mirror images.
    spread: Vec<f32>,
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
            inside: vec![false; region.elements()],
            rows: vec![Vec::new(); region.lengths()[0]],
            elements: Vec::new(),
            mask: vec![false; region.elements()],
            system: BandSystem {
                layout,
                coefficients: SingleStencil::default(),
                places: Vec::new(),
                groups: Vec::new(),
                images: Vec::new(),
                spread: vec![0.0; layout.places()],
                solution: Vec::new(),
                start: None,
            },
            unit: 1.0,
            residual: Vec::new(),
            directions: Directions::new(0),
            image: Vec::new(),
        }
    }

    /// Sets the coefficients of `F`, by offset along the axes.
    pub fn take_coefficients(&mut self, coefficients: &Stencil) {
        self.unit = coefficients[0][0];
        self.system.coefficients = coefficients.map(|row| row.map(|f| single(f / self.unit)));
    }

    /// Sets up the band around a set. Only rows near those that have changed are searched.
    pub fn surround(&mut self, set: &WorkingSet) {
        let layout = self.layout;
        let [_, size] = layout.lengths;
        let (inside, mask) = (&self.inside, set.mask());
        let changed = inside.par_chunks(size).zip(mask.par_chunks(size));
        let changed = changed.with_min_len(ELEMENTS / size + 1);
        let changed: Vec<bool> = changed.map(|(before, now)| before != now).collect();
        let is_near = |i: usize| {
            let end = (i + WIDTH + 1).min(changed.len());
            changed[i.saturating_sub(WIDTH)..end].contains(&true)
        };
        let lines = layout.lines(0);
        let rows = self.rows[lines.clone()].par_iter_mut().zip(lines);
        let rows = rows.with_min_len(ELEMENTS / size + 1);
        rows.filter(|(_, i)| is_near(*i)).for_each_init(
            || [size + 2 * WIDTH, size].map(|length| vec![false; length]),
            |buffers, (row, i)| layout.find_band_in_row(i, mask, buffers, row),
        );
        self.inside.copy_from_slice(mask);
        self.elements.iter().for_each(|e| self.mask[*e] = false);
        self.elements.clear();
        self.elements.extend(self.rows.iter().flatten());
        self.elements.iter().for_each(|e| self.mask[*e] = true);
        self.system.take_places(&self.rows);
        self.directions = Directions::new(self.elements.len());
        for field in [&mut self.residual, &mut self.image] {
            field.clear();
            field.resize(self.elements.len(), 0.0);
        }
    }

    pub fn is_empty(&self) -> bool {
        self.elements.is_empty()
    }

    /// The band as a mask over the grid.
    pub fn mask(&self) -> &[bool] {
        &self.mask
    }

    /// Sets a field to 0 on the band.
    pub fn clear(&self, field: &mut [f64]) {
        self.elements.iter().for_each(|e| field[*e] = 0.0);
    }

    /// Computes `s` for `filtered`, `F r`, and writes it into the band's elements of `field`.
    pub fn balance(&mut self, filtered: &[f64], field: &mut [f64]) {
        let values = self.elements.iter().map(|element| filtered[*element].abs());
        let Some(unit) = power_of_two(values.fold(0.0, f64::max)) else {
            return;
        };
        let per_unit = 1.0 / unit;
        update(&mut self.residual, &self.elements, |r, e| {
            *r = -filtered[*e] * per_unit;
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
                field[*element] = unit / self.unit * s;
            }
        }
    }
}

impl BandSystem {
    /// Sets the band's elements, given row by row.
    fn take_places(&mut self, rows: &[Vec<usize>]) {
        let layout = self.layout;
        self.clear_spread();
        self.places.clear();
        self.images.clear();
        self.groups.clear();
        let [_, size] = layout.lengths;
        for (i, row) in rows.iter().enumerate() {
            // A group does not continue in the next row.
            let mut end = 0;
            for element in row {
                let (at, index) = ([i, element - i * size], self.places.len());
                let place = layout.place(at);
                if place >= end {
                    end = place + TOGETHER;
                    self.groups.push(Group {
                        place,
                        first: index,
                        members: [false; TOGETHER],
                    });
                }
                if let Some(group) = self.groups.last_mut() {
                    group.members[place - group.place] = true;
                }
                self.places.push(place);
                let images = layout.images(at).map(|place| (place, index));
                self.images.extend(images);
            }
        }
        self.solution.resize(self.places.len(), 0.0);
    }

    /// Whether the residual at the start is one to be balanced.
    fn has_start(&self) -> bool {
        (self.start).is_some_and(|start| start > 0.0 && start.is_finite())
    }

    /// Writes the sum of the field times the coefficients around each of the band's elements.
    fn stencil_into(&self, image: &mut [f64]) {
        let groups = self.groups.chunks(GROUPS);
        let mut rest = image;
        let parts = groups.map(|groups| {
            let (first, last) = (&groups[0], &groups[groups.len() - 1]);
            let count = last.first - first.first + last.members.iter().filter(|m| **m).count();
            let (image, others) = std::mem::take(&mut rest).split_at_mut(count);
            rest = others;
            (groups, image)
        });
        let parts: Vec<(&[Group], &mut [f64])> = parts.collect();
        parts.into_par_iter().for_each(|(groups, image)| {
            Arch::new().dispatch(Stencils {
                groups,
                field: &self.spread,
                width: self.layout.width(),
                coefficients: &self.coefficients,
                image,
            });
        });
    }

    /// Clears the field to which the stencil is applied on the band.
    fn clear_spread(&mut self) {
        let images = self.images.iter().map(|(place, _)| place);
        for place in self.places.iter().chain(images) {
            self.spread[*place] = 0.0;
        }
    }

    /// Copies a direction into the field to which the stencil is applied.
    fn spread(&mut self, direction: &[f64]) {
        for (place, d) in self.places.iter().zip(direction) {
            self.spread[*place] = single(*d);
        }
        for (place, index) in &self.images {
            self.spread[*place] = single(direction[*index]);
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
        self.stencil_into(image);
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

/// The largest power of two up to a number, so that single precision holds the quotient and no digit changes; none if
/// it is 0 or not finite.
fn power_of_two(number: f64) -> Option<f64> {
    (number > 0.0 && number.is_finite()).then(|| number.log2().floor().exp2())
}

#[cfg(test)]
mod tests;
