//! The derivatives of a step in a summary.

use pellicle_contact::nan_from_null;
use serde::{Deserialize, Serialize};

/// The derivatives of a step by one number θ of the case, per unit of θ.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SensitivitySummary {
    /// Key of the number in the case.
    pub parameter: String,
    /// θ, in SI units or the case's own.
    #[serde(deserialize_with = "nan_from_null")]
    pub value: f64,
    /// `∂D/∂θ` at constant force, of the elements in contact.
    pub penetration: Option<f64>,
    /// The same along the curve, without the steps of elements that enter the contact; none for fewer than six forces.
    pub smooth_penetration: Option<f64>,
    /// `∂Q/∂θ` at constant penetration, of the elements in contact.
    pub force: Option<f64>,
    /// `∂E/∂θ` at constant force, `E = ∫ D dQ`.
    #[serde(deserialize_with = "nan_from_null")]
    pub energy: f64,
}
