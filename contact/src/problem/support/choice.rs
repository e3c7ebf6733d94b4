//! The support of a problem on all elements of a region.

use std::sync::Arc;

use pellicle_influence::{ElasticOperator, SurfaceElasticity};

use super::{cell::Cell, divisible::Divisible, given::Given, grid::BodyUnderGrid};
use crate::grid::region::{Boundary, Region};

/// An elastic body under all elements of a region.
pub fn under(elasticity: Arc<SurfaceElasticity>, region: Region) -> Box<dyn Divisible> {
    match region.boundary() {
        Boundary::Free => Box::new(BodyUnderGrid::new(elasticity, region)),
        Boundary::Periodic => Box::new(Cell::new(elasticity, region)),
    }
}

/// A given operator, without known coefficients, under all elements of a region.
pub fn given(operator: Box<dyn ElasticOperator>, region: Region) -> Box<dyn Divisible> {
    Box::new(Given::new(operator, region))
}
