//! A body under a rectangle that repeats periodically.

use std::sync::Arc;

use pellicle_influence::{ElasticOperator, PeriodicOperator, PeriodicSymbol, SurfaceElasticity};

use super::{Support, divisible::Divisible};
use crate::{grid::region::Region, problem::gap_scale::GapScale};

/// The body, and its operator once it is needed.
pub struct Cell {
    elasticity: Arc<SurfaceElasticity>,
    region: Region,
    operator: Option<Box<PeriodicOperator>>,
}

impl Cell {
    pub fn new(elasticity: Arc<SurfaceElasticity>, region: Region) -> Self {
        Self {
            elasticity,
            region,
            operator: None,
        }
    }
}

impl ElasticOperator for Cell {
    fn size(&self) -> usize {
        self.region.size()
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        let (elasticity, lengths) = (&self.elasticity, self.region.lengths());
        let made = || Box::new(elasticity.periodic_operator(lengths));
        let operator = self.operator.get_or_insert_with(made);
        operator.apply_into(pressure, displacement);
    }
}

impl Support for Cell {
    fn region(&self) -> &Region {
        &self.region
    }

    fn elasticity(&self) -> Option<&Arc<SurfaceElasticity>> {
        Some(&self.elasticity)
    }

    fn gap_scale(&self) -> GapScale {
        GapScale::Cell {
            mean: self.elasticity.mean_compliance(),
            longest: self.elasticity.cell_response(self.region.grid_size()),
        }
    }

    fn symbol(&self, _: usize) -> Option<PeriodicSymbol> {
        Some(self.elasticity.cell_symbol(self.region.lengths()))
    }
}

impl Divisible for Cell {
    /// None for less than the cell: a part of it does not repeat.
    fn part(&self, region: &Region) -> Option<Box<dyn Divisible>> {
        let whole =
            || -> Box<dyn Divisible> { Box::new(Self::new(self.elasticity.clone(), *region)) };
        region.is_whole().then(whole)
    }

    fn release(&mut self) {
        self.operator = None;
    }
}
