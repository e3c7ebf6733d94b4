//! A body under a few elements of a square, with products among these alone, accurate to about 1e-9.

use std::sync::Arc;

use pellicle_influence::{ElasticOperator, ScatteredOperator, SurfaceElasticity};

use super::{Support, divisible::Divisible};
use crate::grid::{candidates::Candidates, region::Region};

/// The body, its elements and their operator.
pub struct Scattered {
    elasticity: Arc<SurfaceElasticity>,
    region: Region,
    candidates: Arc<Candidates>,
    operator: Box<ScatteredOperator>,
}

impl Scattered {
    /// None if the region is too small.
    pub fn new(
        elasticity: Arc<SurfaceElasticity>,
        region: Region,
        candidates: Arc<Candidates>,
    ) -> Option<Self> {
        let operator = elasticity.among(region.size(), candidates.elements())?;
        Some(Self {
            elasticity,
            region,
            candidates,
            operator: Box::new(operator),
        })
    }
}

impl ElasticOperator for Scattered {
    fn size(&self) -> usize {
        self.region.size()
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.operator.apply_into(pressure, displacement);
    }
}

impl Support for Scattered {
    fn region(&self) -> &Region {
        &self.region
    }

    fn elasticity(&self) -> Option<&Arc<SurfaceElasticity>> {
        Some(&self.elasticity)
    }

    fn candidates(&self) -> Option<&Arc<Candidates>> {
        Some(&self.candidates)
    }

    fn place(&self, element: usize) -> [usize; 2] {
        self.candidates.place(element)
    }

    /// None: elements that overlap are found by the certificate, wherever they are.
    fn border(&self) -> Box<dyn Iterator<Item = usize>> {
        Box::new(std::iter::empty())
    }

    fn gather(&self, field: &[f64]) -> Vec<f64> {
        let region = &self.region;
        let value = |candidate| field[region.index_on_grid(self.candidates.place(candidate))];
        (0..self.candidates.len()).map(value).collect()
    }
}

impl Divisible for Scattered {
    fn apply_among(
        &mut self,
        elements: &[u32],
        pressure: &[f64],
        displacement: &mut [f64],
    ) -> bool {
        self.operator.list(elements);
        self.operator.apply_into(pressure, displacement);
        self.operator.list(self.candidates.elements());
        true
    }

    fn list(&mut self, candidates: &Arc<Candidates>) -> bool {
        self.operator.list(candidates.elements());
        self.candidates = candidates.clone();
        true
    }
}
