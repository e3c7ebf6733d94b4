//! High-precision contact solutions, read from `tests/data`. Each file's `meta` line says what computed it.

use serde::Deserialize;

/// Approach and load of a paraboloid `z = r²/2` or cone `z = r` at contact radius 1 on a coated half-space with
/// `E2 = 1`: `axisymmetric_contact.json`, auxiliary-function method, 22 digits.
#[derive(Debug, Clone, Deserialize)]
pub struct AxisymmetricContact {
    /// Poisson's ratio of the coating.
    pub nu1: String,
    /// Poisson's ratio of the substrate.
    pub nu2: String,
    /// Young's modulus of the coating.
    #[serde(rename = "E1")]
    pub e1: String,
    /// Coating thickness over contact radius.
    #[serde(rename = "H_over_a")]
    pub thickness: String,
    /// `paraboloid z=r^2/2 (R=1)` or `cone z=r`.
    pub shape: String,
    /// Approach.
    pub delta: String,
    /// Load.
    #[serde(rename = "P")]
    pub load: String,
}

/// A contact on a small grid: `discrete_contact.json`, two independent solvers.
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
    /// Coating thickness.
    #[serde(rename = "H")]
    pub thickness: f64,
    /// Half the side of the domain.
    #[serde(rename = "L")]
    pub half_side: f64,
    /// Elements per side.
    #[serde(rename = "N")]
    pub size: usize,
    /// `paraboloid` or `wavy`.
    pub surface: String,
    /// Approach.
    pub delta: String,
    /// Load.
    #[serde(rename = "P")]
    pub load: String,
    /// Which of the two was given: `delta` or `P`.
    pub given: String,
    /// Elements in contact.
    pub n_contact: usize,
    /// Largest pressure.
    pub pmax: String,
    /// Pressures of the row `i = N/2`.
    #[serde(rename = "pressure_row_N_half")]
    pub pressure_row: Vec<String>,
    /// Pressures of the diagonal.
    pub pressure_diag: Vec<String>,
    /// All pressures, on the smaller grids.
    #[serde(default)]
    pub pressure: Vec<Vec<String>>,
}

#[derive(Deserialize)]
struct Values<T> {
    values: Vec<T>,
}

/// The values of `axisymmetric_contact.json`.
///
/// # Panics
/// If the file does not fit the type.
#[must_use]
pub fn axisymmetric_contacts() -> Vec<AxisymmetricContact> {
    let file: Values<_> =
        serde_json::from_str(include_str!("../data/axisymmetric_contact.json")).expect("fits");
    file.values
}

/// The values of `discrete_contact.json`.
///
/// # Panics
/// If the file does not fit the type.
#[must_use]
pub fn discrete_contacts() -> Vec<DiscreteContact> {
    let file: Values<_> =
        serde_json::from_str(include_str!("../data/discrete_contact.json")).expect("fits");
    file.values
}

/// A decimal number of a data file.
///
/// # Panics
/// If it is none.
#[must_use]
pub fn number(text: &str) -> f64 {
    text.parse().expect("a decimal number")
}
