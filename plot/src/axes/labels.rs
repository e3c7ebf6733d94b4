//! Labels of an axis.

use pellicle::display::superscript;

/// Returns the label of a tick on an axis of this length, with as many decimals as its ticks need and a true minus
/// sign.
#[must_use]
pub fn tick(value: f64, length: f64) -> String {
    // About six ticks on an axis: a tenth of its length determines the first digit, and one more is kept.
    let needed = (1.0 - (length / 10.0).log10().floor()).clamp(0.0, 12.0);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 0 and 12"
    )]
    let text = format!("{value:.*}", needed as usize);
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        &text
    };
    match text {
        "-0" => "0".into(),
        _ => text.replace('-', "−"),
    }
}

/// Largest number of digits in a label.
const DIGITS: usize = 12;

/// Returns the labels of a logarithmic axis, with as many digits as distinguish them; values far from 1 are written as
/// powers of ten.
#[must_use]
pub fn logarithmic_ticks(ticks: &[f64]) -> Vec<String> {
    let labels = |digits| ticks.iter().map(|tick| power(*tick, digits)).collect();
    // A label is correct if it reads back as its tick, up to rounding.
    let is_right = |digits: &usize| {
        ticks.iter().all(|tick| {
            let rounded = format!("{tick:.*e}", digits - 1);
            let rounded: f64 = rounded.parse().unwrap_or(f64::NAN);
            (rounded - tick).abs() <= 1e-9 * tick.abs()
        })
    };
    labels((1..DIGITS).find(is_right).unwrap_or(DIGITS))
}

/// Returns the title of an axis: `p, GPa`, or `p (case units)` for a case without units.
#[must_use]
pub fn axis_title(symbol: &str, unit: &str) -> String {
    match unit {
        "" => format!("{symbol} (case units)"),
        unit => format!("{symbol}, {unit}"),
    }
}

/// Writes a value with at most this many significant digits, and with a power of ten if it is far from 1: `3.571·10⁻⁵`,
/// `0.3`.
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

/// Removes trailing zeros from the decimals.
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
    fn labels_have_no_rounding_noise() {
        assert_eq!(tick(0.1 + 0.2, 1.0), "0.3");
        assert_eq!(tick(-0.060_000_000_000_000_005, 0.12), "−0.06");
        assert_eq!(tick(-1e-18, 0.12), "0");
        assert_eq!(tick(40.0, 100.0), "40");
        assert_eq!(tick(2.5, 20.0), "2.5");
    }

    #[test]
    fn labels_of_a_logarithmic_axis_distinguish_its_ticks() {
        assert_eq!(logarithmic_ticks(&[0.1, 0.2, 0.5]), ["0.1", "0.2", "0.5"]);
        assert_eq!(logarithmic_ticks(&[1.0, 1.5, 2.0]), ["1", "1.5", "2"]);
        assert_eq!(logarithmic_ticks(&[1e-5, 1e-3]), ["10⁻⁵", "10⁻³"]);
        assert_eq!(logarithmic_ticks(&[20.0, 20.5, 21.0]), ["20", "20.5", "21"]);
    }

    #[test]
    fn an_axis_title_has_its_unit() {
        assert_eq!(axis_title("p", "GPa"), "p, GPa");
        assert_eq!(axis_title("p", ""), "p (case units)");
    }

    #[test]
    fn small_numbers_are_written_with_a_power_of_ten() {
        assert_eq!(power(0.3571e-4, 4), "3.571·10⁻⁵");
        assert_eq!(power(1e-4, 3), "10⁻⁴");
        assert_eq!(power(0.01, 3), "0.01");
        assert_eq!(power(80.0, 3), "80");
        assert_eq!(power(0.3, 3), "0.3");
        assert_eq!(power(1000.0, 2), "1000");
    }
}
