//! A number with its standard uncertainty.

use serde::{Deserialize, Serialize};

/// A number with its standard uncertainty, zero for an exact one.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Uncertain {
    /// The value.
    pub value: f64,
    /// The standard uncertainty, in the unit of the value.
    pub sd: f64,
}

impl Uncertain {
    /// An exact number.
    #[must_use]
    pub fn exact(value: f64) -> Self {
        Self { value, sd: 0.0 }
    }
}
