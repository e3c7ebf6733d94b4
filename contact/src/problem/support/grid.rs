//! A body whose surface continues without load, under all of a grid, of its half or quadrant, or under a square in it.

use std::sync::Arc;

use pellicle_influence::{
    ConvolutionOperator, ElasticOperator, PeriodicSymbol, SurfaceElasticity, WindowOperator,
};

use super::{Support, divisible::Divisible, scattered::Scattered};
use crate::grid::{candidates::Candidates, region::Region};

/// The body, and the operators built so far.
pub struct BodyUnderGrid {
    elasticity: Arc<SurfaceElasticity>,
    region: Region,
    operator: Option<Box<ConvolutionOperator>>,
    /// From pressures on one region to displacements on another around it.
    spread: Option<([Region; 2], Box<WindowOperator>)>,
}

impl BodyUnderGrid {
    pub fn new(elasticity: Arc<SurfaceElasticity>, region: Region) -> Self {
        Self {
            elasticity,
            region,
            operator: None,
            spread: None,
        }
    }

    fn spread_of(&mut self, regions: [Region; 2]) -> &mut WindowOperator {
        let known = self.spread.take_if(|(of, _)| *of == regions);
        let made = || {
            let [part, reach] = regions;
            let origin = part.within(&reach).origin();
            let operator = (self.elasticity).under_window(reach.shape(), origin, part.size());
            (regions, Box::new(operator))
        };
        let (_, operator) = self.spread.insert(known.unwrap_or_else(made));
        operator
    }
}

impl ElasticOperator for BodyUnderGrid {
    fn size(&self) -> usize {
        self.region.size()
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        let (elasticity, shape) = (&self.elasticity, self.region.shape());
        let made = || Box::new(elasticity.operator_on(shape));
        let operator = self.operator.get_or_insert_with(made);
        operator.apply_into(pressure, displacement);
    }
}

impl Support for BodyUnderGrid {
    fn region(&self) -> &Region {
        &self.region
    }

    fn elasticity(&self) -> Option<&Arc<SurfaceElasticity>> {
        Some(&self.elasticity)
    }

    fn symbol(&self, room: usize) -> Option<PeriodicSymbol> {
        let shape = self.region.shape();
        let size = if room == 0 || self.may_grow() {
            shape.size()
        } else {
            let side = shape.whole_size() + 2 * room;
            SurfaceElasticity::fast_size(shape.for_square(side).size())
        };
        Some(self.elasticity.symbol(shape.with_size(size).whole_size()))
    }
}

impl Divisible for BodyUnderGrid {
    fn part(&self, region: &Region) -> Option<Box<dyn Divisible>> {
        Some(Box::new(Self::new(self.elasticity.clone(), *region)))
    }

    /// Products among candidates include no mirror images.
    fn takes_candidates(&self) -> bool {
        self.region.weight() == 1
    }

    fn among(&self, region: &Region, candidates: &Arc<Candidates>) -> Option<Box<dyn Divisible>> {
        if !self.takes_candidates() {
            return None;
        }
        let among = Scattered::new(self.elasticity.clone(), *region, candidates.clone())?;
        Some(Box::new(among))
    }

    fn apply_around(
        &mut self,
        [part, reach]: [&Region; 2],
        pressure: &[f64],
        displacement: &mut [f64],
    ) {
        if part.is_whole() {
            self.apply_into(pressure, displacement);
        } else {
            let spread = self.spread_of([*part, *reach]);
            spread.apply_into(pressure, displacement);
        }
    }

    fn release(&mut self) {
        (self.operator, self.spread) = (None, None);
    }
}
