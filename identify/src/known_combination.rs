//! Products of powers of unknowns that the data determine although they do not determine the unknowns.

use crate::Unknown;

/// A product of powers of unknowns that the data determine although they do not determine the unknowns.
#[derive(Debug, Clone, PartialEq)]
pub struct KnownCombination {
    /// The product in symbols, such as `E * R^0.5`.
    pub expression: String,
    /// Its value, in the units of its factors.
    pub value: f64,
    /// Its interval; `None` on an open side.
    pub interval: [Option<f64>; 2],
}

/// The product of an unknown and powers of others, as text.
pub(crate) fn expression(unknowns: &[Unknown], unknown: usize, powers: &[(usize, f64)]) -> String {
    powers.iter().fold(
        unknowns[unknown].name().to_owned(),
        |product, &(k, exponent)| format!("{product} * {}{}", unknowns[k].name(), power(exponent)),
    )
}

/// Explains that an unknown is not identifiable, and names the combination that is known instead.
pub(crate) fn not_identifiable(known: Option<&KnownCombination>) -> String {
    match known {
        Some(known) => format!(
            "No data can determine it: other values give the same curves if others change too. \
             What they determine near the best fit is {}.",
            known.expression
        ),
        None => "No data can determine it: the curves do not depend on it.".to_owned(),
    }
}

/// An exponent as text; empty for one.
fn power(exponent: f64) -> String {
    if (exponent - 1.0).abs() < f64::EPSILON {
        String::new()
    } else {
        format!("^{exponent}")
    }
}
