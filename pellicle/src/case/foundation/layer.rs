//! `[[foundation.layer]]`: one layer, homogeneous or graded.

use pellicle_kernel::{Base, GradedLayer, GradingOptions, Interface, KernelError, Layer, Material};
use serde::Serialize;

use super::modulus::ModulusCase;
use super::strength::{BodyStrengthCase, InterfaceStrengthCase};
use super::substrate::{MaterialCase, POISSON_RATIO, POISSON_RATIOS};
use crate::declare::macros::record;
use crate::declare::{Codec, Scope, compliance, either, length, number, part, pressure, word};
use crate::input::table_reader::TableReader;

const MODULUS: &str = "a positive pressure such as \"70 GPa\", a bare number, or { from = .., to = .., profile = \"linear\" }";

/// A residual stress beyond this part of the modulus is a wrong unit: films crack or peel at some hundredths of it.
const LARGEST_RESIDUAL_STRAIN: f64 = 0.1;

record! {
    /// One layer and the interface below it.
    #[derive(Copy)]
    pub struct LayerCase {
        thickness: f64 = length().positive(), "thickness of the layer";
        young_modulus: ModulusCase = either(pressure().positive(), ModulusCase::Uniform, ModulusCase::Graded, MODULUS),
            "Young's modulus, the same everywhere or changing with depth";
        poisson_ratio: f64 = number(POISSON_RATIO).within(POISSON_RATIOS), "Poisson's ratio";
        interface: InterfaceCase = InterfaceCase::codec().or(InterfaceCase::BONDED, "\"bonded\""),
            "the interface below the layer";
        #[serde(skip_serializing_if = "is_none")]
        residual_stress: f64 = pressure().or(0.0, "0"),
            "what the layer carries without a load, the same along x and y; tension is positive";
        #[serde(flatten)] strength: BodyStrengthCase = part(), "its strength";
        #[serde(flatten)] interface_strength: InterfaceStrengthCase = part(), "strength of the interface below";
    }
    check |layer: &LayerCase, table: &TableReader<'_>, _: &Scope<'_>| {
        // The modulus is known to be positive here, so only the ratio can be rejected.
        let refused = |error| Err(table.required("poisson_ratio", POISSON_RATIO)?.refused(&error));
        let modulus = layer.young_modulus.at_top();
        if layer.residual_stress.abs() > LARGEST_RESIDUAL_STRAIN * modulus {
            let wanted = "at most a tenth of the Young's modulus: strains are small";
            return Err(table.required("residual_stress", wanted)?.wanted(wanted));
        }
        layer.material(modulus).map_or_else(refused, |_| Ok(()))
    };
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]
fn is_none(stress: &f64) -> bool {
    *stress == 0.0
}

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

record! {
    /// An imperfect bond, across which displacements jump in proportion to the traction.
    #[derive(Copy)]
    pub struct SpringCase {
        normal_compliance: f64 = compliance().not_negative(), "jump of the normal displacement per traction";
        shear_compliance: f64 = compliance().not_negative(), "jump of the displacement along the interface per traction";
    }
}

const NAMED: &[(&str, NamedInterface)] = &[
    ("bonded", NamedInterface::Bonded),
    ("frictionless", NamedInterface::Frictionless),
];

impl InterfaceCase {
    const BONDED: Self = Self::Named(NamedInterface::Bonded);

    const fn codec() -> impl Codec<Out = Self> {
        either(word(NAMED), Self::Named, Self::Spring, "an interface")
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

impl From<Layer> for LayerCase {
    fn from(layer: Layer) -> Self {
        let material = MaterialCase::from(layer.material());
        Self {
            thickness: layer.thickness(),
            young_modulus: ModulusCase::Uniform(material.young_modulus),
            poisson_ratio: material.poisson_ratio,
            interface: layer.interface().into(),
            residual_stress: 0.0,
            strength: material.strength,
            interface_strength: InterfaceStrengthCase::default(),
        }
    }
}

impl From<Interface> for InterfaceCase {
    fn from(interface: Interface) -> Self {
        match interface {
            Interface::Bonded => Self::Named(NamedInterface::Bonded),
            Interface::Frictionless => Self::Named(NamedInterface::Frictionless),
            spring @ Interface::Spring(_) => Self::Spring(SpringCase {
                normal_compliance: spring.normal_compliance(),
                shear_compliance: spring.shear_compliance(),
            }),
        }
    }
}
