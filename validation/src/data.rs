//! Reference values with many digits, embedded from `tests/data`. The entry `meta` of each file names the program that
//! computed it.

pub mod compliance;
pub mod contact;
pub mod influence;

use serde::{Deserialize, Deserializer, de::Error};

/// A list under the key `values`.
#[derive(Deserialize)]
struct ValueList<T> {
    values: Vec<T>,
}

/// Reads a number given as a string with more digits than an `f64` holds.
fn decimal<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let text = String::deserialize(deserializer)?;
    text.parse().map_err(D::Error::custom)
}

/// Reads such a number if it is there.
fn optional_decimal<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    decimal(deserializer).map(Some)
}

/// Such a number, as an item of a list.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(try_from = "String")]
pub struct Decimal(pub f64);

impl TryFrom<String> for Decimal {
    type Error = std::num::ParseFloatError;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        text.parse().map(Self)
    }
}
