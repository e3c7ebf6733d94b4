//! The base of the layers: an elastic half-space or a rigid base.

use pellicle_kernel::{Base, KernelError, Material};
use serde::Serialize;

use super::strength::BodyStrengthCase;
use crate::input::diagnosis::Diagnosis;
use crate::input::dimension::Dimension;
use crate::input::table_reader::TableReader;
use crate::input::value_reader::ValueReader;

pub(super) const WANTED: &str = "{ young_modulus = .., poisson_ratio = .. } or \"rigid\"";

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

/// An isotropic elastic material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MaterialCase {
    /// Young's modulus `E`, Pa.
    pub young_modulus: f64,
    /// Poisson's ratio `ν`.
    pub poisson_ratio: f64,
    /// Its strength.
    #[serde(flatten)]
    pub strength: BodyStrengthCase,
}

/// The keys of a material, without those of its strengths.
const KEYS: [&str; 2] = ["young_modulus", "poisson_ratio"];

impl SubstrateCase {
    pub(super) fn read(field: ValueReader<'_>) -> Result<Self, Diagnosis> {
        if !field.is_table() {
            return match field.text() {
                Ok("rigid") => Ok(Self::Rigid),
                _ => Err(field.wanted(WANTED)),
            };
        }
        let table = field.table()?;
        table.only(&[&KEYS[..], &BodyStrengthCase::KEYS].concat())?;
        Ok(Self::Elastic(MaterialCase::read(&table)?))
    }

    pub(super) fn build(self) -> Result<Base, KernelError> {
        match self {
            Self::Rigid => Ok(Base::Rigid),
            Self::Elastic(material) => material.build().map(Base::HalfSpace),
        }
    }
}

impl MaterialCase {
    fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        let material = Self {
            young_modulus: table.positive("young_modulus", Dimension::Pressure)?,
            poisson_ratio: table
                .required("poisson_ratio", POISSON_RATIO)?
                .number(POISSON_RATIO)?,
            strength: BodyStrengthCase::read(table)?,
        };
        // The modulus is known to be positive here, so only the ratio can be rejected.
        let ratio = table.required("poisson_ratio", POISSON_RATIO)?;
        material.build().map_err(|error| ratio.refused(&error))?;
        Ok(material)
    }

    fn build(self) -> Result<Material, KernelError> {
        Material::new(self.young_modulus, self.poisson_ratio)
    }
}
