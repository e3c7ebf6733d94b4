//! A number with or without its unit, from a text outside the case.

use pellicle::input::dimension::Dimension;
use pellicle::input::quantity;
use pellicle::input::units::Units;

/// Reads a number of this dimension, in SI units or the case's own.
///
/// # Errors
///
/// What is wanted instead, in words.
pub fn text_of(text: &str, dimension: Option<Dimension>, units: Units) -> Result<f64, String> {
    let bare: Option<f64> = text.trim().parse().ok();
    let has_units = units == Units::Si || dimension == Some(Dimension::Angle);
    let value = match dimension.filter(|_| has_units) {
        Some(dimension) => bare.or_else(|| quantity::parse(text, dimension).ok()),
        None => bare,
    };
    value
        .filter(|value| value.is_finite())
        .ok_or_else(|| match dimension {
            Some(dimension) if has_units => format!(
                "{} such as {}, or a bare number in {}",
                dimension.noun(),
                dimension.example(),
                dimension.si_unit()
            ),
            Some(_) => "a bare number, as the case has no units".into(),
            None => "a number without a unit".into(),
        })
}
