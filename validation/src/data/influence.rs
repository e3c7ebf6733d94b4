//! Influence coefficients to 20 and 30 digits: `influence_two_layer.json`, and `influence_extreme.json` for the softest
//! and stiffest coatings.

use std::collections::BTreeMap;

use pellicle_kernel::{Foundation, KernelError, Material};
use serde::Deserialize;

use super::decimal;

/// Coatings and their coefficients.
#[derive(Debug, Clone, Deserialize)]
pub struct Coefficients {
    /// The coatings by name.
    pub cases: BTreeMap<String, Coating>,
    /// The coefficients.
    pub values: Vec<ReferenceCoefficient>,
}

/// A coating of thickness 1 and modulus 1.
#[derive(Debug, Clone, Copy, Deserialize)]
pub struct Coating {
    /// `χ = E1/E2`.
    #[serde(deserialize_with = "decimal")]
    pub chi: f64,
    /// Poisson's ratio of the coating.
    #[serde(deserialize_with = "decimal")]
    pub nu1: f64,
    /// Poisson's ratio of the substrate.
    #[serde(deserialize_with = "decimal")]
    pub nu2: f64,
}

impl Coating {
    /// Returns the coated half-space.
    ///
    /// # Errors
    /// An error if no material has these numbers.
    pub fn foundation(&self) -> Result<Foundation, KernelError> {
        let coating = Material::new(1.0, self.nu1)?;
        Foundation::coated(1.0, coating, Material::new(1.0 / self.chi, self.nu2)?)
    }
}

/// One coefficient.
#[derive(Debug, Clone, Deserialize)]
pub struct ReferenceCoefficient {
    /// Name of the coating.
    pub case: String,
    /// `λ = H/a`, thickness over half a side.
    #[serde(rename = "lam", deserialize_with = "decimal")]
    pub lambda: f64,
    /// Offset along x, in elements.
    pub m: usize,
    /// Offset along y.
    pub n: usize,
    /// `k E1/a`.
    #[serde(rename = "U", deserialize_with = "decimal")]
    pub value: f64,
    /// The same for a half-space of the coating's material.
    #[serde(rename = "U_homogeneous", deserialize_with = "decimal")]
    pub homogeneous: f64,
}

impl ReferenceCoefficient {
    /// Returns the side of an element for a coating of thickness 1.
    #[must_use]
    pub fn element_side(&self) -> f64 {
        2.0 / self.lambda
    }

    /// Returns the scale of errors, `max(|k|, min(1, Φ(0)) k_Love)`, with the response to the longest waves `Φ(0)`.
    #[must_use]
    pub fn scale(&self, response_at_zero: f64) -> f64 {
        self.value
            .abs()
            .max(response_at_zero.min(1.0) * self.homogeneous)
    }
}

/// Reads coatings with 1/1000 to 10 times the substrate's modulus.
///
/// # Errors
/// Errors if the file does not have this layout.
pub fn two_layer() -> serde_json::Result<Coefficients> {
    let text = include_str!("../../../tests/data/influence_two_layer.json");
    serde_json::from_str(text)
}

/// Reads coatings with a millionth and a million times the substrate's modulus.
///
/// # Errors
/// Errors if the file does not have this layout.
pub fn extreme() -> serde_json::Result<Coefficients> {
    let text = include_str!("../../../tests/data/influence_extreme.json");
    serde_json::from_str(text)
}
