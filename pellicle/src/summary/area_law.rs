//! The contact of a rough surface against the laws of light loads.
//!
//! Theories of rough contact give the contact fraction `A/A_0` as a function of the reduced pressure
//!
//! ```text
//! p* = p̄/(E* h'_rms),    p̄ = Q/A_0,    A/A_0 → κ p*  for p* → 0:
//! ```
//!
//! Bush, Gibson and Thomas (1975) have `κ = √(2π)`, Persson (2001) has `A/A_0 = erf(√2 p*)`, so `κ = √(8/π)`. `E*` is
//! that of the bodies at the wavenumber `√(m₄/m₂)` of the waves in which the slopes are, with the moments `m₂` and `m₄`
//! of the map's spectrum, from its mean square slope and curvature. On a half-space it is `E/(1 − ν²)` under a rigid
//! body.

use pellicle_contact::{LoadingPath, Step};
use pellicle_texture::nan_from_null;
use serde::{Deserialize, Serialize};

use super::roughness::RoughnessSummary;
use crate::case::Case;
use crate::case::surface::{ComplianceCase, SurfaceCase};

/// A relief of no springs is the body itself.
const RIGID: ComplianceCase = ComplianceCase::Compliance(0.0);

/// The area of a contact against the pressure on it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct AreaLaw {
    /// `p* = p̄/(E* h'_rms)`.
    #[serde(deserialize_with = "nan_from_null")]
    pub reduced_pressure: f64,
    /// `κ = (A/A_0)/p*`.
    #[serde(deserialize_with = "nan_from_null")]
    pub kappa: f64,
}

/// `E* h'_rms` of a case in which one map takes part, the other surface being smooth, and no springs, Pa; none
/// otherwise.
#[must_use]
pub fn reference_pressure(
    case: &Case,
    path: &LoadingPath,
    roughness: Option<&RoughnessSummary>,
) -> Option<f64> {
    let roughness = match (&case.surface, case.indenter.map()) {
        (SurfaceCase::Rough(_), None) => roughness?.surface.as_ref()?,
        (SurfaceCase::Map(of), None) if of.compliance == RIGID => roughness?.surface.as_ref()?,
        (SurfaceCase::Bare, Some(_)) => roughness?.indenter.as_ref()?,
        _ => return None,
    };
    // E* = 2/(k C(k)) at k² = m₄/m₂, where the mean curvature is ∇²h/2
    let wavenumber = 2.0 * roughness.rms_curvature / roughness.rms_slope;
    let modulus = 2.0 / (wavenumber * path.tables.bodies().compliance(wavenumber));
    let pressure = modulus * roughness.rms_slope;
    (pressure > 0.0 && pressure.is_finite()).then_some(pressure)
}

impl AreaLaw {
    /// The numbers of a step; none without contact.
    #[must_use]
    pub fn of(step: &Step, reference_pressure: f64) -> Option<Self> {
        let rough = step.rough.as_ref()?;
        let reduced_pressure = step.solution.force / rough.nominal_area / reference_pressure;
        Some(Self {
            reduced_pressure,
            kappa: rough.contact_fraction / reduced_pressure,
        })
    }
}
