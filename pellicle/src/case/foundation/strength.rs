//! Strengths: the largest stresses that a body and an interface bear.

use serde::Serialize;

use crate::input::diagnosis::Diagnosis;
use crate::input::dimension::{Dimension, Sign};
use crate::input::table_reader::TableReader;

/// The strength of a body; each limit may be missing.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct BodyStrengthCase {
    /// Von Mises' stress at which the body yields, Pa.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub yield_strength: Option<f64>,
    /// The largest principal stress that the body bears, Pa.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tensile_strength: Option<f64>,
    /// The contact pressure at which its surface yields, Pa.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hardness: Option<f64>,
}

/// The strength of the interface below a layer; each limit may be missing.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct InterfaceStrengthCase {
    /// The shear traction at which the layer detaches, Pa.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interface_shear_strength: Option<f64>,
    /// The tension at which the layer detaches, Pa.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interface_tensile_strength: Option<f64>,
}

impl BodyStrengthCase {
    pub(super) const KEYS: [&str; 3] = ["yield_strength", "tensile_strength", "hardness"];

    pub(super) fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        let [yield_strength, tensile_strength, hardness] =
            Self::KEYS.map(|key| strength(table, key));
        Ok(Self {
            yield_strength: yield_strength?,
            tensile_strength: tensile_strength?,
            hardness: hardness?,
        })
    }
}

impl InterfaceStrengthCase {
    pub(super) const KEYS: [&str; 2] = ["interface_shear_strength", "interface_tensile_strength"];

    pub(super) fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        let [shear, tensile] = Self::KEYS.map(|key| strength(table, key));
        Ok(Self {
            interface_shear_strength: shear?,
            interface_tensile_strength: tensile?,
        })
    }
}

fn strength(table: &TableReader<'_>, key: &str) -> Result<Option<f64>, Diagnosis> {
    let field = table.optional(key);
    let read = field.map(|field| field.quantity(Dimension::Pressure, Sign::Positive));
    read.transpose()
}
