//! Reference contacts: `axisymmetric_contact.json` for the continuum, `discrete_contact.json` for small grids.

use serde::Deserialize;

use super::{Decimal, ValueList, decimal};

/// Approach and load of an indenter at contact radius 1 on a coated half-space of modulus 1: auxiliary-function method,
/// 22 digits.
#[derive(Debug, Clone, Deserialize)]
pub struct AxisymmetricContact {
    /// Young's modulus of the coating.
    #[serde(rename = "E1", deserialize_with = "decimal")]
    pub e1: f64,
    /// Poisson's ratio of the coating.
    #[serde(deserialize_with = "decimal")]
    pub nu1: f64,
    /// Poisson's ratio of the substrate.
    #[serde(deserialize_with = "decimal")]
    pub nu2: f64,
    /// Thickness of the coating, in contact radii.
    #[serde(rename = "H_over_a", deserialize_with = "decimal")]
    pub thickness: f64,
    /// The indenter.
    pub shape: AxisymmetricIndenter,
    /// Approach.
    #[serde(rename = "delta", deserialize_with = "decimal")]
    pub penetration: f64,
    /// Load.
    #[serde(rename = "P", deserialize_with = "decimal")]
    pub force: f64,
}

/// The indenters of the axisymmetric contacts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub enum AxisymmetricIndenter {
    /// `z = r²/2`.
    #[serde(rename = "paraboloid z=r^2/2 (R=1)")]
    Paraboloid,
    /// `z = r`.
    #[serde(rename = "cone z=r")]
    Cone,
}

/// A contact on a small grid, solved by two independent programs that agree to 1e-12 of the peak.
#[derive(Debug, Clone, Deserialize)]
pub struct DiscreteContact {
    /// Young's modulus of the coating.
    #[serde(rename = "E1")]
    pub e1: f64,
    /// Young's modulus of the substrate.
    #[serde(rename = "E2")]
    pub e2: f64,
    /// Poisson's ratio of the coating.
    pub nu1: f64,
    /// Poisson's ratio of the substrate.
    pub nu2: f64,
    /// Thickness of the coating.
    #[serde(rename = "H")]
    pub thickness: f64,
    /// Half the side of the domain.
    #[serde(rename = "L")]
    pub half_side: f64,
    /// Elements per side.
    #[serde(rename = "N")]
    pub size: usize,
    /// The profile of the indenter.
    #[serde(rename = "surface")]
    pub profile: DiscreteProfile,
    /// Approach.
    #[serde(rename = "delta", deserialize_with = "decimal")]
    pub penetration: f64,
    /// Load.
    #[serde(rename = "P", deserialize_with = "decimal")]
    pub force: f64,
    /// Which of the two was given.
    pub given: Given,
    /// Elements in contact.
    #[serde(rename = "n_contact")]
    pub contact_elements: usize,
    /// Largest pressure.
    #[serde(rename = "pmax", deserialize_with = "decimal")]
    pub max_pressure: f64,
    /// Pressures in the row `i = N/2`.
    #[serde(rename = "pressure_row_N_half")]
    pub pressure_row: Vec<Decimal>,
    /// Pressures on the diagonal.
    #[serde(rename = "pressure_diag")]
    pub pressure_diagonal: Vec<Decimal>,
    /// All pressures, for the smaller grids.
    #[serde(default)]
    pub pressure: Vec<Vec<Decimal>>,
}

/// The profiles pressed into the small grids.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum DiscreteProfile {
    /// `(x² + y²)/2`.
    Paraboloid,
    /// `0.1 (x² + y²/2) + 0.02 (1 − cos(7x + 0.3) cos(5y − 0.2))`.
    Wavy,
}

impl DiscreteProfile {
    /// Returns the height at a point.
    #[must_use]
    pub fn height(self, x: f64, y: f64) -> f64 {
        match self {
            Self::Paraboloid => f64::midpoint(x * x, y * y),
            Self::Wavy => {
                let waves = (7.0 * x + 0.3).cos() * (5.0 * y - 0.2).cos();
                0.1 * (x * x + 0.5 * y * y) + 0.02 * (1.0 - waves)
            }
        }
    }
}

/// Which quantity of a contact was given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub enum Given {
    /// The approach.
    #[serde(rename = "delta")]
    Penetration,
    /// The load.
    #[serde(rename = "P")]
    Force,
}

/// Reads the axisymmetric contacts.
///
/// # Errors
/// Errors if the file does not have this layout.
pub fn axisymmetric() -> serde_json::Result<Vec<AxisymmetricContact>> {
    let text = include_str!("../../../tests/data/axisymmetric_contact.json");
    Ok(serde_json::from_str::<ValueList<_>>(text)?.values)
}

/// Reads the contacts on small grids.
///
/// # Errors
/// Errors if the file does not have this layout.
pub fn discrete() -> serde_json::Result<Vec<DiscreteContact>> {
    let text = include_str!("../../../tests/data/discrete_contact.json");
    Ok(serde_json::from_str::<ValueList<_>>(text)?.values)
}
