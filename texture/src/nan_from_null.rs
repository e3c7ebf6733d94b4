//! Numbers that are not finite, as JSON stores them.

use serde::{Deserialize, Deserializer};

/// Reads a number, or NaN from `null`, since JSON cannot express a number that is not finite. For
/// `#[serde(deserialize_with)]`, here and in the crates above.
///
/// # Errors
///
/// Those of the deserializer if it finds neither.
pub fn nan_from_null<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Option::<f64>::deserialize(deserializer).map(|number| number.unwrap_or(f64::NAN))
}
