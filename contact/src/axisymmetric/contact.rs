//! Axisymmetric contacts of a given radius.

use pellicle_influence::ElasticBodies;

use super::{AxisymmetricElasticity, AxisymmetricPressure};
use crate::ContactError;

/// The contact of a flat punch.
#[derive(Debug, Clone, PartialEq)]
pub struct PunchContact {
    /// Radius a, m.
    pub radius: f64,
    /// Stiffness `S = dF/dD`, N/m; also that of any other indenter whose contact has this radius.
    pub stiffness: f64,
    /// `dS/da`, N/m².
    pub stiffness_slope: f64,
    /// Pressure per penetration (m), N/m³, infinite at the edge.
    pub pressure: AxisymmetricPressure,
}

/// The contact of a curved indenter, without adhesion.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisymmetricContact {
    /// Contact radius a, m.
    pub radius: f64,
    /// Force F, N.
    pub force: f64,
    /// Penetration D, m.
    pub penetration: f64,
    /// Elastic energy `U = ∫ F dD`, J.
    pub energy: f64,
    /// The pressure, 0 at the edge.
    pub pressure: AxisymmetricPressure,
    /// A flat punch of the same radius: its stiffness is `dF/dD` of this contact.
    pub punch: PunchContact,
}

/// The stiffness `S = dF/dD` (N/m) of a contact of this radius (m), and `dS/da` (N/m²): `2 E* a` and `2 E*` without
/// layers. Accurate to 1e-12.
///
/// For many radii on the same bodies use [`AxisymmetricElasticity::punch`], which keeps what they share.
///
/// ```
/// use pellicle_contact::axisymmetric::punch_stiffness;
/// use pellicle_kernel::{Foundation, Material};
///
/// let silica = Foundation::half_space(Material::new(72e9, 0.17)?);
/// let diamond = Material::new(1141e9, 0.07)?;
/// // A diamond indenter in series.
/// let bodies = pellicle_influence::ElasticBodies::new(silica, Some(diamond));
/// let [stiffness, slope] = punch_stiffness(&bodies, 1e-6)?;
/// let modulus = 1.0 / ((1.0 - 0.17_f64.powi(2)) / 72e9 + (1.0 - 0.07_f64.powi(2)) / 1141e9);
/// assert!((stiffness / (2.0 * modulus * 1e-6) - 1.0).abs() < 1e-14); // a few roundings
/// assert!((slope / (2.0 * modulus) - 1.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of [`AxisymmetricElasticity::punch`].
pub fn punch_stiffness(bodies: &ElasticBodies, radius: f64) -> Result<[f64; 2], ContactError> {
    let punch = AxisymmetricElasticity::new(bodies).punch(radius)?;
    Ok([punch.stiffness, punch.stiffness_slope])
}
