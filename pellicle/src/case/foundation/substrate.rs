//! The base of the layers: an elastic half-space or a rigid base.

use pellicle_kernel::{Base, KernelError, Material};
use serde::Serialize;

use super::strength::BodyStrengthCase;
use crate::declare::macros::record;
use crate::declare::{Codec, Scope, either, literal, number, part, pressure};
use crate::input::table_reader::TableReader;

const WANTED: &str = "{ young_modulus = .., poisson_ratio = .. } or \"rigid\"";

/// The range, which the kernel checks.
pub(in crate::case) const POISSON_RATIOS: std::ops::RangeInclusive<f64> = 0.0..=0.5;
pub(in crate::case) const POISSON_RATIO: &str = "Poisson's ratio, a number in [0, 0.5]";

/// The base of the layers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SubstrateCase {
    /// A base that does not deform.
    Rigid,
    /// An elastic half-space.
    #[serde(untagged)]
    Elastic(MaterialCase),
}

record! {
    /// An isotropic elastic material.
    #[derive(Copy)]
    pub struct MaterialCase {
        young_modulus: f64 = pressure().positive(), "Young's modulus";
        poisson_ratio: f64 = number(POISSON_RATIO).within(POISSON_RATIOS), "Poisson's ratio";
        #[serde(flatten)] strength: BodyStrengthCase = part(), "its strength";
    }
    check |material: &MaterialCase, table: &TableReader<'_>, _: &Scope<'_>| {
        // The modulus is known to be positive here, so only the ratio can be rejected.
        let refused = |error| Err(table.required("poisson_ratio", "")?.refused(&error));
        material.build().map_or_else(refused, |_| Ok(()))
    };
}

impl SubstrateCase {
    /// Reads `"rigid"` or a material.
    #[must_use]
    pub const fn codec() -> impl Codec<Out = Self> {
        either(
            literal("rigid", WANTED),
            |()| Self::Rigid,
            Self::Elastic,
            WANTED,
        )
    }

    pub(super) fn build(self) -> Result<Base, KernelError> {
        match self {
            Self::Rigid => Ok(Base::Rigid),
            Self::Elastic(material) => material.build().map(Base::HalfSpace),
        }
    }
}

impl MaterialCase {
    fn build(self) -> Result<Material, KernelError> {
        Material::new(self.young_modulus, self.poisson_ratio)
    }
}

impl From<Material> for MaterialCase {
    fn from(material: Material) -> Self {
        Self {
            young_modulus: material.young_modulus(),
            poisson_ratio: material.poisson_ratio(),
            strength: BodyStrengthCase::default(),
        }
    }
}
