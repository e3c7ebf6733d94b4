//! Numbers as a picture writes them.

use crate::display::superscript;

/// The value with at most this many significant digits and a power of ten where it is far from 1: `3.571·10⁻⁵`, `0.3`.
#[must_use]
pub fn power(value: f64, digits: usize) -> String {
    let text = format!("{value:.*e}", digits.saturating_sub(1));
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-2..4).contains(&exponent) {
        let after = i32::try_from(digits).unwrap_or(0) - 1 - exponent;
        return trimmed(&format!("{value:.*}", usize::try_from(after).unwrap_or(0)));
    }
    match trimmed(mantissa).as_str() {
        "1" => format!("10{}", superscript(exponent)),
        mantissa => format!("{mantissa}·10{}", superscript(exponent)),
    }
}

/// Without zeros at the end of its decimals.
fn trimmed(text: &str) -> String {
    if !text.contains('.') {
        return text.to_owned();
    }
    let text = text.trim_end_matches('0').trim_end_matches('.');
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_numbers_have_a_power_of_ten() {
        assert_eq!(power(0.3571e-4, 4), "3.571·10⁻⁵");
        assert_eq!(power(1e-4, 3), "10⁻⁴");
        assert_eq!(power(0.01, 3), "0.01");
        assert_eq!(power(80.0, 3), "80");
        assert_eq!(power(0.3, 3), "0.3");
        assert_eq!(power(1000.0, 2), "1000");
    }
}
