//! Where pressures live: some elements of a grid, and the elastic body under them.
//!
//! | kind | elements | images of one | beyond its border |
//! |---|---|---|---|
//! | [grid](grid) | all of a square, of its half or quadrant | by mirror symmetry | nothing presses |
//! | the same, a part of a larger grid | a square in it, at the axes of a half or quadrant | by mirror symmetry | contact may continue |
//! | [cell](cell) | all of a square that repeats | in the nearest cells | the same again |
//! | [scattered](scattered) | a few of a square | none | found by the certificate |
//! | [given](given) | all of a square, under any operator | none | nothing presses |
//!
//! Solvers and preconditioners use the verbs of [`Support`] and never ask which kind it is; a path and the certificate,
//! which solve on a part and judge on all of it, also those of [`Divisible`](divisible::Divisible). A new kind is one
//! file here.

mod cell;
pub mod choice;
pub mod divisible;
mod given;
mod grid;
pub mod scattered;

use std::sync::Arc;

use pellicle_influence::{ElasticOperator, PeriodicSymbol, SurfaceElasticity};

use crate::{
    grid::{candidates::Candidates, region::Region},
    problem::gap_scale::GapScale,
};

/// The elements of a problem's fields, and the displacements that pressures on them cause.
///
/// Its product [`apply_into`](ElasticOperator::apply_into) is `K p` on its elements.
pub trait Support: ElasticOperator {
    /// The square, or part of one, that holds all elements.
    fn region(&self) -> &Region;

    /// The coefficients of the body; none if only its operator is known.
    fn elasticity(&self) -> Option<&Arc<SurfaceElasticity>>;

    /// The elements, if they are not all of the [region](Self::region).
    fn candidates(&self) -> Option<&Arc<Candidates>> {
        None
    }

    /// Row and column of an element in the region.
    fn place(&self, element: usize) -> [usize; 2] {
        let size = self.region().size();
        [element / size, element % size]
    }

    /// `K` between two elements and their mirror images, in m/Pa, without periodic images; NaN if it is unknown.
    fn coefficient(&self, [element, other]: [usize; 2]) -> f64 {
        let (shape, ends) = (self.region().shape(), [element, other]);
        let [from, to] = ends.map(|element| self.place(element));
        self.elasticity().map_or(f64::NAN, |elasticity| {
            elasticity.coefficient_on(shape, from, to)
        })
    }

    /// The displacement (m/Pa) of an element in the middle under a unit pressure on itself alone: one product if the
    /// coefficients are unknown.
    fn own_coefficient(&mut self) -> f64 {
        if let Some(elasticity) = self.elasticity() {
            return elasticity.coefficient([0, 0]);
        }
        let (size, elements) = (self.region().size(), self.region().elements());
        let (mut unit, mut displacement) = (vec![0.0; elements], vec![0.0; elements]);
        let middle = (size / 2) * (size + 1);
        unit[middle] = 1.0;
        self.apply_into(&unit, &mut displacement);
        displacement[middle]
    }

    /// Elements of the whole surface for which one stands, itself included.
    fn weight(&self) -> usize {
        self.region().weight()
    }

    /// The elements at which the contact may continue beyond the support, so that it must be enlarged.
    fn border(&self) -> Box<dyn Iterator<Item = usize>> {
        Box::new(self.region().border())
    }

    /// Whether the contact may continue beyond the support.
    fn may_grow(&self) -> bool {
        self.border().next().is_some()
    }

    /// The elements' values of a field on all of the region's grid.
    fn gather(&self, field: &[f64]) -> Vec<f64> {
        self.region().cut(field)
    }

    /// The length to which gaps are compared, in SI units.
    fn gap_scale(&self) -> GapScale {
        GapScale::Penetration
    }

    /// The symbol of `K` on a periodic grid that covers the elements, and at least `room` more beyond a border at which
    /// the contact may end; none if it is unknown or they are few.
    fn symbol(&self, _room: usize) -> Option<PeriodicSymbol> {
        None
    }
}

#[cfg(test)]
mod tests;
