//! `[[foundation.layer]]`: one layer, homogeneous or graded.

use pellicle_kernel::{Base, GradedLayer, GradingOptions, Interface, KernelError, Layer, Material};
use serde::Serialize;

use super::modulus::ModulusCase;
use super::strength::{BodyStrengthCase, InterfaceStrengthCase};
use super::substrate::POISSON_RATIO;
use crate::input::diagnosis::Diagnosis;
use crate::input::dimension::{Dimension, Sign};
use crate::input::value_reader::ValueReader;

const MODULUS: &str = "a positive pressure such as \"70 GPa\", a bare number, or { from = .., to = .., profile = \"linear\" }";

/// One layer and the interface below it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LayerCase {
    /// Thickness, m.
    pub thickness: f64,
    /// Young's modulus.
    pub young_modulus: ModulusCase,
    /// Poisson's ratio `ν`.
    pub poisson_ratio: f64,
    /// The interface below it.
    pub interface: InterfaceCase,
    /// Its strength.
    #[serde(flatten)]
    pub strength: BodyStrengthCase,
    /// The strength of the interface below it.
    #[serde(flatten)]
    pub interface_strength: InterfaceStrengthCase,
}

/// The keys of a layer, without those of its strengths.
const KEYS: [&str; 4] = ["thickness", "young_modulus", "poisson_ratio", "interface"];

/// The interface between a layer and the body below.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum InterfaceCase {
    /// An interface given by its name.
    Named(NamedInterface),
    /// An imperfect bond.
    Spring(SpringCase),
}

/// An interface without parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum NamedInterface {
    /// The layer is bonded to the body below.
    Bonded,
    /// The layer slides without friction.
    Frictionless,
}

/// An imperfect bond, across which displacements jump in proportion to the traction.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SpringCase {
    /// Jump of the normal displacement per traction, m/Pa.
    pub normal_compliance: f64,
    /// Jump of the displacement along the interface per traction, m/Pa.
    pub shear_compliance: f64,
}

impl InterfaceCase {
    fn read(field: &ValueReader<'_>) -> Result<Self, Diagnosis> {
        if !field.is_table() {
            let named = field.choice(&[
                ("bonded", NamedInterface::Bonded),
                ("frictionless", NamedInterface::Frictionless),
            ])?;
            return Ok(Self::Named(named));
        }
        let table = field.clone().table()?;
        table.only(&["normal_compliance", "shear_compliance"])?;
        let compliance = |key| {
            let value = table.required(key, &Sign::NotNegative.wanted(Dimension::Compliance))?;
            value.quantity(Dimension::Compliance, Sign::NotNegative)
        };
        Ok(Self::Spring(SpringCase {
            normal_compliance: compliance("normal_compliance")?,
            shear_compliance: compliance("shear_compliance")?,
        }))
    }

    fn build(self) -> Result<Interface, KernelError> {
        match self {
            Self::Named(NamedInterface::Bonded) => Ok(Interface::Bonded),
            Self::Named(NamedInterface::Frictionless) => Ok(Interface::Frictionless),
            Self::Spring(SpringCase {
                normal_compliance,
                shear_compliance,
            }) => Interface::spring(normal_compliance, shear_compliance),
        }
    }
}

impl LayerCase {
    pub(super) fn read(field: ValueReader<'_>) -> Result<Self, Diagnosis> {
        let table = field.table()?;
        let strengths = [
            &KEYS[..],
            &BodyStrengthCase::KEYS,
            &InterfaceStrengthCase::KEYS,
        ];
        table.only(&strengths.concat())?;
        let interface = match table.optional("interface") {
            Some(field) => InterfaceCase::read(&field)?,
            None => InterfaceCase::Named(NamedInterface::Bonded),
        };
        let thickness = table.positive("thickness", Dimension::Length)?;
        let modulus = table.required("young_modulus", MODULUS)?;
        let layer = Self {
            thickness,
            young_modulus: ModulusCase::read(modulus)?,
            poisson_ratio: table
                .required("poisson_ratio", POISSON_RATIO)?
                .number(POISSON_RATIO)?,
            interface,
            strength: BodyStrengthCase::read(&table)?,
            interface_strength: InterfaceStrengthCase::read(&table)?,
        };
        // The modulus is known to be positive here, so only the ratio can be rejected.
        let ratio = table.required("poisson_ratio", POISSON_RATIO)?;
        let material = layer.material(layer.young_modulus.at_top());
        material.map_err(|error| ratio.refused(&error))?;
        Ok(layer)
    }

    /// Returns the layer as one or more homogeneous layers on top of those below, and the error of the split if it is
    /// graded.
    pub(super) fn split(
        &self,
        below: &[Layer],
        base: Base,
    ) -> Result<(Vec<Layer>, Option<f64>), KernelError> {
        let interface = self.interface.build()?;
        let thickness = self.thickness;
        match self.young_modulus {
            ModulusCase::Uniform(modulus) => {
                let layer = Layer::new(thickness, self.material(modulus)?, interface)?;
                Ok(([&[layer], below].concat(), None))
            }
            ModulusCase::Graded(grading) => {
                let material = |depth: f64| self.material(grading.at(depth / thickness));
                let graded = GradedLayer::new(thickness, interface, material)?;
                let split = graded.split(below, base, &GradingOptions::default())?;
                let layers = split.foundation.layers().to_vec();
                Ok((layers, Some(split.error_estimate)))
            }
        }
    }

    /// Whether the interface below carries no shear.
    #[must_use]
    pub fn slides(&self) -> bool {
        self.interface == InterfaceCase::Named(NamedInterface::Frictionless)
    }

    fn material(&self, young_modulus: f64) -> Result<Material, KernelError> {
        Material::new(young_modulus, self.poisson_ratio)
    }
}
