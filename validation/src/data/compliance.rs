//! The response `Φ` and the compliance `C` to 40 digits: `compliance_two_layer.json` and `compliance_n_layers.json`.

use std::collections::BTreeMap;

use pellicle_kernel::{Base, Foundation, Interface, KernelError, Layer, Material};
use serde::Deserialize;

use super::{Decimal, ValueList, decimal, optional_decimal};

/// `Φ` of one layer of thickness 1 at one wavenumber, for the bases and interfaces that were computed.
#[derive(Debug, Clone, Deserialize)]
pub struct OneLayerResponse {
    /// `χ = E1/E2`.
    #[serde(deserialize_with = "decimal")]
    pub chi: f64,
    /// Poisson's ratio of the layer.
    #[serde(deserialize_with = "decimal")]
    pub nu1: f64,
    /// Poisson's ratio of the half-space.
    #[serde(deserialize_with = "decimal")]
    pub nu2: f64,
    /// Wavenumber times thickness.
    #[serde(deserialize_with = "decimal")]
    pub s: f64,
    /// `Φ`, bonded to the half-space.
    #[serde(rename = "Phi", deserialize_with = "decimal")]
    pub bonded: f64,
    /// `Φ − 1` for the same.
    #[serde(rename = "Phi_minus_1", deserialize_with = "decimal")]
    pub bonded_minus_one: f64,
    /// `Φ`, sliding on the half-space.
    #[serde(rename = "Phi_slip", default, deserialize_with = "optional_decimal")]
    pub sliding: Option<f64>,
    /// `Φ`, bonded to a rigid base.
    #[serde(
        rename = "Phi_rigid_bonded",
        default,
        deserialize_with = "optional_decimal"
    )]
    pub bonded_to_rigid: Option<f64>,
    /// `Φ`, sliding on a rigid base.
    #[serde(
        rename = "Phi_rigid_slip",
        default,
        deserialize_with = "optional_decimal"
    )]
    pub sliding_on_rigid: Option<f64>,
}

impl OneLayerResponse {
    /// Returns the layer on its half-space, or on a rigid base.
    ///
    /// # Errors
    /// An error if no material has these numbers.
    pub fn foundation(&self, interface: Interface, rigid: bool) -> Result<Foundation, KernelError> {
        let layer = Layer::new(1.0, Material::new(self.chi, self.nu1)?, interface)?;
        let base = if rigid {
            Base::Rigid
        } else {
            Base::HalfSpace(Material::new(1.0, self.nu2)?)
        };
        Foundation::new(vec![layer], base)
    }
}

/// Stacks and their computed values.
#[derive(Debug, Clone, Deserialize)]
pub struct LayerStacks {
    /// The stacks by name.
    pub stacks: BTreeMap<String, LayerStack>,
    /// The values.
    pub values: Vec<StackValue>,
}

/// Layers from the surface down, and their base.
#[derive(Debug, Clone, Deserialize)]
pub struct LayerStack {
    /// Thickness, Young's modulus and Poisson's ratio of each layer.
    layers: Vec<[Decimal; 3]>,
    /// Young's modulus and Poisson's ratio of the half-space, or the word `rigid`.
    substrate: StackSubstrate,
    /// The interface between each layer and the next: `bonded` or `slip`.
    interfaces: Vec<StackInterface>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
enum StackSubstrate {
    HalfSpace([Decimal; 2]),
    Rigid(RigidWord),
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum RigidWord {
    Rigid,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum StackInterface {
    Bonded,
    Slip,
}

impl From<StackInterface> for Interface {
    fn from(interface: StackInterface) -> Self {
        match interface {
            StackInterface::Bonded => Self::Bonded,
            StackInterface::Slip => Self::Frictionless,
        }
    }
}

impl LayerStack {
    /// Returns the foundation.
    ///
    /// # Errors
    /// An error if no material has these numbers.
    pub fn foundation(&self) -> Result<Foundation, KernelError> {
        let layers = self.layers.iter().zip(&self.interfaces);
        let layers = layers.map(|(layer, interface)| {
            let [thickness, young_modulus, poisson_ratio] = layer.map(|Decimal(number)| number);
            let material = Material::new(young_modulus, poisson_ratio)?;
            Layer::new(thickness, material, (*interface).into())
        });
        let base = match &self.substrate {
            StackSubstrate::HalfSpace([Decimal(young_modulus), Decimal(poisson_ratio)]) => {
                Base::HalfSpace(Material::new(*young_modulus, *poisson_ratio)?)
            }
            StackSubstrate::Rigid(RigidWord::Rigid) => Base::Rigid,
        };
        Foundation::new(layers.collect::<Result<_, _>>()?, base)
    }
}

/// One stack at one wavenumber.
#[derive(Debug, Clone, Deserialize)]
pub struct StackValue {
    /// Name of the stack.
    pub stack: String,
    /// Wavenumber `k`.
    #[serde(rename = "k", deserialize_with = "decimal")]
    pub wavenumber: f64,
    /// `C(k)`.
    #[serde(rename = "C", deserialize_with = "decimal")]
    pub compliance: f64,
    /// `Φ`.
    #[serde(rename = "Phi", deserialize_with = "decimal")]
    pub response: f64,
}

/// Reads the values for one layer.
///
/// # Errors
/// Errors if the file does not have this layout.
pub fn one_layer() -> serde_json::Result<Vec<OneLayerResponse>> {
    let text = include_str!("../../../tests/data/compliance_two_layer.json");
    Ok(serde_json::from_str::<ValueList<_>>(text)?.values)
}

/// Reads the values for stacks of two and three layers.
///
/// # Errors
/// Errors if the file does not have this layout.
pub fn stacks() -> serde_json::Result<LayerStacks> {
    serde_json::from_str(include_str!("../../../tests/data/compliance_n_layers.json"))
}
