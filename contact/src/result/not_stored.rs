//! The value of a number that a file does not store.

/// NaN, for `#[serde(default)]`.
pub fn nan() -> f64 {
    f64::NAN
}
