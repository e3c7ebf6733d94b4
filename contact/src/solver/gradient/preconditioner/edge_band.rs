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
//! `F` decays so quickly that a band a few elements wide can represent all of `E`, and a few coefficients all of `F`:
//! `F s` is added to `F r` on the elements of the set within their reach, the shore. Without the band the filter is
//! wrong at the edge of the contact, which alone doubles the iterations.

mod layout;
mod stencil;
mod system;

use pellicle_influence::SectorGrid;
use rayon::prelude::*;

pub use self::stencil::Stencil;
use self::{
    layout::{Elements, Layout},
    stencil::{REACH, SingleStencil},
    system::BandSystem,
};
use crate::vector::single;

/// Elements from the set to the outer rim of the band, along both axes. One more does not help; one less costs a tenth
/// more products.
const WIDTH: usize = 3;
/// Elements beyond a border on which the whole band and its stencil lie.
pub const ROOM: usize = WIDTH + REACH;
/// Relative residual to which `s` is solved, and the most steps for it: 3 are taken on a homogeneous body, up to all
/// under a stiff coating.
const ACCURACY: f32 = 0.1;
const MOST_STEPS: usize = 12;
/// Fewest elements per thread.
const ELEMENTS: usize = 1 << 12;

/// The band around one working set, on the grid of a filter.
pub struct EdgeBand {
    layout: Layout,
    /// The set that it surrounds.
    inside: Vec<bool>,
    band: Elements,
    /// The same as a mask.
    mask: Vec<bool>,
    /// The elements of the set within reach of the band.
    shore: Elements,
    /// The first coefficient of `F`.
    unit: f64,
    system: BandSystem,
}

impl EdgeBand {
    /// An empty band on a grid.
    pub fn new(grid: SectorGrid) -> Self {
        let layout = Layout {
            lengths: grid.lengths(),
            beyond: grid.mirrored_lines(REACH),
        };
        Self {
            layout,
            inside: vec![false; grid.elements()],
            band: Elements::none(layout),
            mask: vec![false; grid.elements()],
            shore: Elements::none(layout),
            unit: 1.0,
            system: BandSystem::new(layout),
        }
    }

    /// Sets the coefficients of `F`, by offset along the axes.
    pub fn take_coefficients(&mut self, coefficients: &Stencil) {
        self.unit = coefficients[0][0];
        let coefficients: SingleStencil =
            coefficients.map(|row| row.map(|f| single(f / self.unit)));
        self.system.take_coefficients(coefficients);
    }

    /// Sets up the band around a set. Only rows near those that have changed are searched.
    pub fn surround(&mut self, set: &[bool]) {
        let layout = self.layout;
        let [_, size] = layout.lengths;
        let changed = self.inside.par_chunks(size).zip(set.par_chunks(size));
        let changed = changed.with_min_len(ELEMENTS / size + 1);
        let changed: Vec<bool> = changed.map(|(before, now)| before != now).collect();
        let has_changed_near = |i: usize, reach: usize| {
            let end = (i + reach + 1).min(changed.len());
            changed[i.saturating_sub(reach)..end].contains(&true)
        };
        self.inside.copy_from_slice(set);
        self.system.leave(&self.band);
        self.band.mark(&mut self.mask, false);
        let is_outside = |member: bool| !member;
        (self.band).find(layout, |i| has_changed_near(i, WIDTH), [set; 2], is_outside);
        self.band.mark(&mut self.mask, true);
        let (near_band, is_member) = ([&self.mask, set], |member: bool| member);
        (self.shore).find(
            layout,
            |i| has_changed_near(i, WIDTH + REACH),
            near_band,
            is_member,
        );
        self.system.enter(&self.band);
    }

    pub fn is_empty(&self) -> bool {
        self.band.groups.is_empty()
    }

    /// The band as a mask over the grid.
    pub fn mask(&self) -> &[bool] {
        &self.mask
    }

    /// Marks the band in a mask over the grid.
    pub fn mark(&self, mask: &mut [bool]) {
        self.band.mark(mask, true);
    }

    /// Sets a field to 0 on the band.
    pub fn clear(&self, field: &mut [f64]) {
        for group in &self.band.groups {
            group.update(field, |value, _| *value = 0.0);
        }
    }

    /// Adds `F s` on the shore to a field that is `F r` there and on the band.
    pub fn settle(&mut self, field: &mut [f64]) {
        if let Some(unit) = self.system.solve(&self.band, field) {
            let answers = self.system.answers(&self.band, &self.shore);
            for (group, answer) in self.shore.groups.iter().zip(answers) {
                group.update(field, |value, k| *value += unit * f64::from(answer[k]));
            }
        }
    }

    /// Computes `s` for `filtered`, `F r`, and writes it into the band's elements of `field`.
    pub fn balance(&mut self, filtered: &[f64], field: &mut [f64]) {
        if let Some(unit) = self.system.solve(&self.band, filtered) {
            let unit = unit / self.unit;
            for (group, s) in self.band.groups.iter().zip(self.system.solution()) {
                group.update(field, |value, k| *value = unit * f64::from(s[k]));
            }
        }
    }
}

#[cfg(test)]
mod tests;
