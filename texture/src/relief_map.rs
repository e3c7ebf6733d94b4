//! A relief given by a measured height map.

use rayon::prelude::*;

use crate::error::{Quantity, TextureError, not_negative, positive};
use crate::grid::Grid;
use crate::height_map::HeightMap;
use crate::spring_law::SpringLaw;

/// The compliance of a measured relief.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MapCompliance {
    /// Uniform compliance η, m/Pa; 0 for a rigid relief.
    Uniform(f64),
    /// Young's modulus E, Pa: `η = (height above the deepest point) / E`, so the deepest point is rigid.
    YoungModulus(f64),
}

/// A measured relief: a compliance and a height map whose highest point is level with the plane of the tops.
///
/// Outside the map's rectangle the height at its rim continues outwards, so a domain may be larger than the measured
/// area; [`ReliefMap::covers`] says whether the map covers a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct ReliefMap {
    map: HeightMap,
    compliance: MapCompliance,
    law: SpringLaw,
    /// Height of the base of the springs; unused if the compliance is uniform.
    ground: f64,
    highest: f64,
}

impl ReliefMap {
    /// Builds a relief from a map, whose heights may be relative to any plane, and its compliance.
    ///
    /// # Errors
    ///
    /// [`TextureError::Negative`] if a uniform compliance is negative or not finite, [`TextureError::NotPositive`] if
    /// Young's modulus is not positive and finite.
    pub fn new(map: HeightMap, compliance: MapCompliance) -> Result<Self, TextureError> {
        let ground = match compliance {
            MapCompliance::Uniform(found) => {
                not_negative(Quantity::Compliance, found)?;
                0.0
            }
            MapCompliance::YoungModulus(found) => {
                positive(Quantity::YoungModulus, found)?;
                map.lowest()
            }
        };
        let highest = map.highest();
        Ok(Self {
            map,
            compliance,
            law: SpringLaw::LINEAR,
            ground,
            highest,
        })
    }

    /// Returns the same relief with springs of the [logarithmic law](SpringLaw), never squeezed beyond their height
    /// above the deepest point.
    ///
    /// # Errors
    ///
    /// [`TextureError::NoHeight`] for a uniform compliance, whose springs have no height.
    pub fn stiffening(self) -> Result<Self, TextureError> {
        let law = match self.compliance {
            MapCompliance::Uniform(found) => return Err(TextureError::NoHeight { found }),
            MapCompliance::YoungModulus(modulus) => SpringLaw::of_checked(modulus),
        };
        Ok(Self { law, ..self })
    }

    /// The law of the springs.
    #[must_use]
    pub fn spring_law(&self) -> SpringLaw {
        self.law
    }

    /// The map as given.
    #[must_use]
    pub fn map(&self) -> &HeightMap {
        &self.map
    }

    /// The compliance as given.
    #[must_use]
    pub fn compliance(&self) -> MapCompliance {
        self.compliance
    }

    /// Distance from the deepest to the highest point, m.
    #[must_use]
    pub fn peak_to_valley(&self) -> f64 {
        self.highest - self.map.lowest()
    }

    /// Mean of the compliance η over the samples, m/Pa.
    #[must_use]
    pub fn mean_compliance(&self) -> f64 {
        match self.compliance {
            MapCompliance::Uniform(compliance) => compliance,
            MapCompliance::YoungModulus(modulus) => {
                let heights = self.map.heights();
                let above: f64 = heights.iter().map(|height| height - self.ground).sum();
                above / heights.len() as f64 / modulus
            }
        }
    }

    /// Whether every element centre of the grid lies in the map's rectangle.
    #[must_use]
    pub fn covers(&self, grid: &Grid) -> bool {
        self.map
            .covers(grid.point(grid.lengths().map(|length| length - 1)))
    }

    /// Surface profile `f*` at a point (m): 0 at the highest point, negative elsewhere.
    #[must_use]
    pub fn profile_at(&self, point: [f64; 2]) -> f64 {
        self.map.height(point) - self.highest
    }

    /// Turns heights of the map into the profile, in place.
    pub(crate) fn profile_of(&self, mut heights: Vec<f64>) -> Vec<f64> {
        heights
            .par_iter_mut()
            .for_each(|height| *height -= self.highest);
        heights
    }

    /// Compliance η at a point, m/Pa.
    #[must_use]
    pub fn compliance_at(&self, point: [f64; 2]) -> f64 {
        self.compliance_of(self.map.height(point))
    }

    /// Compliance η at a height of the map, m/Pa.
    pub(crate) fn compliance_of(&self, height: f64) -> f64 {
        match self.compliance {
            MapCompliance::Uniform(compliance) => compliance,
            // η = (height above the deepest point) / E
            MapCompliance::YoungModulus(modulus) => (height - self.ground).max(0.0) / modulus,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp() -> HeightMap {
        HeightMap::new(vec![5.0, 6.0, 7.0], [3, 1], [3.0, 3.0]).unwrap()
    }

    #[test]
    fn the_highest_sample_is_level_with_the_tops_and_the_deepest_is_rigid() {
        let relief = ReliefMap::new(ramp(), MapCompliance::YoungModulus(4.0)).unwrap();
        assert_eq!(
            [-1.0, 0.0, 1.0].map(|x| relief.profile_at([x, 0.0])),
            [-2.0, -1.0, 0.0]
        );
        assert_eq!(
            [-1.0, 0.0, 1.0].map(|x| relief.compliance_at([x, 0.0])),
            [0.0, 0.25, 0.5]
        );
        assert_eq!(relief.peak_to_valley(), 2.0);
        assert_eq!(relief.mean_compliance(), 0.25);
    }

    #[test]
    fn a_domain_larger_than_the_map_is_detected() {
        let relief = ReliefMap::new(ramp(), MapCompliance::Uniform(0.0)).unwrap();
        assert!(relief.covers(&Grid::new(3.0, 10).unwrap()));
        assert!(!relief.covers(&Grid::new(4.0, 10).unwrap()));
        assert_eq!(relief.profile_at([40.0, 0.0]), 0.0);
    }

    #[test]
    fn springs_can_stiffen_only_if_they_have_a_height() {
        let relief = |compliance| ReliefMap::new(ramp(), compliance).unwrap().stiffening();
        let law = relief(MapCompliance::YoungModulus(4.0)).map(|relief| relief.spring_law());
        assert_eq!(law, SpringLaw::logarithmic(4.0));
        assert_eq!(
            relief(MapCompliance::Uniform(0.5)).unwrap_err(),
            TextureError::NoHeight { found: 0.5 }
        );
    }

    #[test]
    fn a_negative_compliance_is_refused() {
        let error = TextureError::Negative {
            quantity: Quantity::Compliance,
            found: -1.0,
        };
        assert_eq!(
            ReliefMap::new(ramp(), MapCompliance::Uniform(-1.0)),
            Err(error)
        );
        assert!(ReliefMap::new(ramp(), MapCompliance::YoungModulus(f64::NAN)).is_err());
    }
}
