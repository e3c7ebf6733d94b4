//! The stresses to compute: sliding, and bodies and interfaces with their strengths.

use serde::{Deserialize, Serialize};

use super::quantity::StressQuantity;
use super::residual::ResidualStress;

/// Sliding of the indenter along the surface: a traction `q = μ p` that drags the surface with the indenter, uncoupled
/// from the pressure (Goodman's approximation).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Sliding {
    /// Coefficient of friction `μ`.
    pub friction: f64,
    /// Direction in rad, from +x to +y.
    pub direction: f64,
}

impl Sliding {
    /// The factors of the traction along x and y per pressure.
    #[must_use]
    pub fn tractions(&self) -> [f64; 2] {
        let (sin, cos) = self.direction.sin_cos();
        [self.friction * cos, self.friction * sin]
    }

    /// The sliding that the other body feels: the opposite traction.
    #[must_use]
    pub fn opposite(self) -> Self {
        Self {
            friction: -self.friction,
            ..self
        }
    }
}

/// Strengths of a body, in Pa; none if no critical load is wanted.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct BodyStrengths {
    /// Von Mises' stress at which the body yields.
    pub yield_strength: Option<f64>,
    /// Largest principal stress that the body bears.
    pub tensile_strength: Option<f64>,
}

/// Strengths of an interface, in Pa; none if no critical load is wanted.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct InterfaceStrengths {
    /// Shear traction at which the interface debonds.
    pub shear_strength: Option<f64>,
    /// Tension at which the interface debonds.
    pub tensile_strength: Option<f64>,
}

/// A layer or the substrate: one or more layers of a foundation (a graded layer has several).
#[derive(Debug, Clone, PartialEq)]
pub struct BodyPart {
    /// Its name in results, such as `layer[0]` or `substrate`.
    pub name: String,
    /// Depth of its top, m.
    pub top: f64,
    /// Depth of its bottom, m; infinite for a substrate.
    pub bottom: f64,
    /// Its strengths.
    pub strengths: BodyStrengths,
}

/// The interface between two of the bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct InterfacePart {
    /// Index, counted from 0 at the surface.
    pub index: usize,
    /// Depth, m.
    pub depth: f64,
    /// Its strengths.
    pub strengths: InterfaceStrengths,
}

/// The stresses to compute.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StressModel {
    /// Sliding of the indenter.
    pub sliding: Sliding,
    /// Bodies from the surface down, without a rigid base.
    pub bodies: Vec<BodyPart>,
    /// Interfaces from the surface down, including one with a rigid base.
    pub interfaces: Vec<InterfacePart>,
    /// What the bodies carry without a load.
    pub residual: ResidualStress,
    /// The quantities whose extremes are wanted; none for all.
    pub only: Option<Vec<StressQuantity>>,
}

impl StressModel {
    /// Whether the extremes of a quantity are wanted.
    #[must_use]
    pub fn wants(&self, quantity: StressQuantity) -> bool {
        let only = self.only.as_ref();
        only.is_none_or(|only| only.contains(&quantity))
    }
}

/// How a coating fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Criterion {
    /// Von Mises' stress reaches a body's yield strength.
    Yield,
    /// The largest principal stress reaches a body's tensile strength.
    Tension,
    /// The shear traction reaches an interface's strength.
    InterfaceShear,
    /// The tension reaches an interface's strength.
    InterfaceTension,
}

impl Criterion {
    /// The quantity that reaches the strength.
    #[must_use]
    pub fn quantity(self) -> StressQuantity {
        match self {
            Self::Yield => StressQuantity::VonMises,
            Self::Tension => StressQuantity::MaxPrincipal,
            Self::InterfaceShear => StressQuantity::ShearTraction,
            Self::InterfaceTension => StressQuantity::Tension,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_6;

    use super::Sliding;

    #[test]
    fn the_traction_per_pressure_has_the_magnitude_of_friction_and_the_direction_of_sliding() {
        let sliding = Sliding {
            friction: 0.4,
            direction: FRAC_PI_6,
        };
        let [x, y] = sliding.tractions();
        assert!((x - 0.2 * 3.0_f64.sqrt()).abs() < 1e-15 && (y - 0.2).abs() < 1e-15);
    }
}
