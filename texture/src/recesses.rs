//! Equal recesses in the plane of the tops, dimples or grooves: in the body's own surface, or in a coat of springs.

use crate::dimples::Dimples;
use crate::error::{Quantity, TextureError, positive};
use crate::grooves::{GrooveProfile, Grooves};
use crate::spring_law::SpringLaw;

/// The form of the recesses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RecessShape {
    /// Spherical caps on a lattice.
    Dimples(Dimples),
    /// Straight channels.
    Grooves(Grooves),
}

/// A plane with recesses. Without a modulus it is the body's own surface, without springs; with one it is made of
/// springs, each as long as its height above the deepest point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recesses {
    shape: RecessShape,
    young_modulus: Option<f64>,
    law: SpringLaw,
}

impl From<RecessShape> for Recesses {
    fn from(shape: RecessShape) -> Self {
        Self {
            shape,
            young_modulus: None,
            law: SpringLaw::LINEAR,
        }
    }
}

impl Recesses {
    /// Returns the same recesses between springs of Young's modulus E (Pa): `η = (height above the deepest point)/E`.
    ///
    /// # Errors
    ///
    /// [`TextureError::NotPositive`] if the modulus is not positive and finite.
    pub fn with_springs(self, young_modulus: f64) -> Result<Self, TextureError> {
        let young_modulus = positive(Quantity::YoungModulus, young_modulus)?;
        let is_linear = self.law.is_linear();
        let found = Self {
            young_modulus: Some(young_modulus),
            ..self
        };
        Ok(if is_linear { found } else { found.stiffening() })
    }

    /// Returns the same recesses with springs of the [logarithmic law](SpringLaw); unchanged if there are none.
    #[must_use]
    pub fn stiffening(self) -> Self {
        let law = self.young_modulus.map(SpringLaw::of_checked);
        Self {
            law: law.unwrap_or(SpringLaw::LINEAR),
            ..self
        }
    }

    /// The form of the recesses.
    #[must_use]
    pub fn shape(&self) -> RecessShape {
        self.shape
    }

    /// Young's modulus of the springs, Pa; none for the body's own surface.
    #[must_use]
    pub fn young_modulus(&self) -> Option<f64> {
        self.young_modulus
    }

    /// The law of the springs.
    #[must_use]
    pub fn spring_law(&self) -> SpringLaw {
        self.law
    }

    /// Depth of the deepest point below the plane, m.
    #[must_use]
    pub fn depth(&self) -> f64 {
        match self.shape {
            RecessShape::Dimples(dimples) => dimples.depth(),
            RecessShape::Grooves(grooves) => grooves.spec().depth,
        }
    }

    /// Mean compliance of the springs, m/Pa, between vertical walls only where the plane is; 0 without springs.
    #[must_use]
    pub fn mean_compliance(&self) -> f64 {
        let mean_depth = match self.shape {
            RecessShape::Dimples(dimples) => dimples.mean_depth(),
            RecessShape::Grooves(grooves) => grooves.mean_depth(),
        };
        self.compliance_at_depth(mean_depth)
    }

    /// Compliance of a spring whose top lies at this depth (m) below the plane, m/Pa: `(d − depth)/E`.
    pub(crate) fn compliance_at_depth(&self, depth: f64) -> f64 {
        let modulus = self.young_modulus;
        modulus.map_or(0.0, |modulus| (self.depth() - depth).max(0.0) / modulus)
    }

    /// Half the width of a recess, m.
    #[must_use]
    pub fn half_width(&self) -> f64 {
        match self.shape {
            RecessShape::Dimples(dimples) => dimples.radius(),
            RecessShape::Grooves(grooves) => 0.5 * grooves.spec().width,
        }
    }

    /// Depth below the plane at a point, m.
    pub(crate) fn depth_at(&self, point: [f64; 2]) -> f64 {
        match &self.shape {
            RecessShape::Dimples(dimples) => dimples.depth_at(point),
            RecessShape::Grooves(grooves) => grooves.depth_at(point),
        }
    }

    /// Whether a point lies on the relief: between vertical walls it does not, everywhere else it does.
    pub(crate) fn contains(&self, point: [f64; 2]) -> bool {
        match &self.shape {
            RecessShape::Grooves(grooves) if self.has_walls() => grooves.is_beside(point),
            RecessShape::Dimples(_) | RecessShape::Grooves(_) => true,
        }
    }

    /// Fraction of the plane that lies on the relief.
    pub(crate) fn area_fraction(&self) -> f64 {
        match &self.shape {
            RecessShape::Grooves(grooves) if self.has_walls() => 1.0 - grooves.area_fraction(),
            RecessShape::Dimples(_) | RecessShape::Grooves(_) => 1.0,
        }
    }

    fn has_walls(&self) -> bool {
        matches!(&self.shape, RecessShape::Grooves(grooves)
            if grooves.spec().profile == GrooveProfile::Rectangular)
    }

    /// Distance from a point to the nearest vertical wall, m, negative in the recess; none without walls.
    pub(crate) fn distance_to_wall(&self, point: [f64; 2]) -> Option<f64> {
        match &self.shape {
            RecessShape::Dimples(_) => None,
            RecessShape::Grooves(grooves) => grooves.distance_to_wall(point),
        }
    }

    /// The same without the sign, m; at least half the width of the arc that rounds the edge.
    pub(crate) fn distance_to_edge(&self, point: [f64; 2]) -> Option<f64> {
        match &self.shape {
            RecessShape::Dimples(_) => None,
            RecessShape::Grooves(grooves) => {
                let half_arc = 0.5 * grooves.spec().edge_radius;
                let distance = grooves.distance_to_wall(point)?;
                Some(distance.abs().max(half_arc))
            }
        }
    }

    /// Width in the plane of the arc that rounds an edge, m; 0 if it is sharp.
    pub(crate) fn arc_width(&self) -> f64 {
        match &self.shape {
            RecessShape::Dimples(dimples) => dimples.arc_width(),
            RecessShape::Grooves(grooves) => grooves.arc_width(),
        }
    }

    /// Distance from a point to the nearest ridge, m; infinite without ridges.
    pub(crate) fn distance_to_ridge(&self, point: [f64; 2]) -> f64 {
        match &self.shape {
            RecessShape::Dimples(dimples) => dimples.distance_to_ridge(point),
            RecessShape::Grooves(grooves) => grooves.distance_to_ridge(point),
        }
    }

    /// Distance from a vector (m) to the nearest one that moves the recesses onto themselves, m.
    pub(crate) fn distance_to_translation(&self, vector: [f64; 2]) -> f64 {
        match &self.shape {
            RecessShape::Dimples(dimples) => dimples.pattern().distance_to_translation(vector),
            RecessShape::Grooves(grooves) => grooves.distance_to_translation(vector),
        }
    }

    /// Whether the recesses are symmetric in x and y.
    pub(crate) fn is_mirrored(&self) -> bool {
        match &self.shape {
            RecessShape::Dimples(dimples) => dimples.pattern().is_mirrored(),
            RecessShape::Grooves(grooves) => grooves.is_mirrored(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Grid, Lattice, Pattern, Relief};

    fn dimples() -> Recesses {
        let pattern = Pattern::new(Lattice::Square, 8.0, [0.0, 0.0]).unwrap();
        RecessShape::Dimples(Dimples::new(pattern, 3.0, 1.0, 0.0).unwrap()).into()
    }

    #[test]
    fn springs_are_as_long_as_the_height_above_the_deepest_point() {
        let bare = dimples();
        let grid = Grid::new(8.0, 5).unwrap();
        let sampled = Relief::Recesses(bare).sample(&grid);
        assert!(sampled.compliance().iter().all(|eta| *eta == 0.0));
        let on_springs = bare.with_springs(4.0).unwrap();
        let softer = Relief::Recesses(on_springs).sample(&grid);
        assert_eq!(softer.profile(), sampled.profile());
        assert_eq!((softer.profile()[0], softer.compliance()[0]), (0.0, 0.25));
        assert_eq!((softer.profile()[12], softer.compliance()[12]), (-1.0, 0.0));
        assert_eq!(bare.mean_compliance(), 0.0);
    }

    #[test]
    fn only_springs_stiffen_and_they_do_so_by_their_modulus() {
        assert!(dimples().stiffening().spring_law().is_linear());
        let stiffening = dimples().with_springs(4.0).unwrap().stiffening();
        assert_eq!(Ok(stiffening.spring_law()), SpringLaw::logarithmic(4.0));
        let other = stiffening.with_springs(5.0).unwrap();
        assert_eq!(Ok(other.spring_law()), SpringLaw::logarithmic(5.0));
    }
}
