//! What is not finite is `null` in JSON, and not a number when it is read back.

use serde::{Deserialize, Deserializer};

/// Reads a number, or NaN where `null` stands.
///
/// # Errors
///
/// Those of the reader if something else stands there.
pub fn or_nan<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Option::<f64>::deserialize(deserializer).map(|number| number.unwrap_or(f64::NAN))
}

/// Reads two numbers, or NaN where `null` stands.
///
/// # Errors
///
/// Those of the reader if something else stands there.
pub fn pair_or_nan<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[f64; 2], D::Error> {
    let pair = <[Option<f64>; 2]>::deserialize(deserializer)?;
    Ok(pair.map(|number| number.unwrap_or(f64::NAN)))
}
