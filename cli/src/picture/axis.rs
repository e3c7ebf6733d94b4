//! The labels of an axis.

use super::number::power;

/// The label of a tick of an axis of this length: as many decimals as its ticks need, with a true minus sign.
#[must_use]
pub fn label(value: f64, length: f64) -> String {
    // About six ticks on an axis: the first digit of a tenth of it, and the one after.
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

/// Most digits of a label.
const DIGITS: usize = 12;

/// The labels of the ticks of a logarithmic axis: as many digits as tell them apart, in powers of ten where they are
/// far from 1.
#[must_use]
pub fn logarithmic_labels(ticks: &[f64]) -> Vec<String> {
    let labels = |digits| ticks.iter().map(|tick| power(*tick, digits)).collect();
    // A label is right if it reads back as its tick, but for rounding.
    let is_right = |digits: &usize| {
        ticks.iter().all(|tick| {
            let rounded = format!("{tick:.*e}", digits - 1);
            let rounded: f64 = rounded.parse().unwrap_or(f64::NAN);
            (rounded - tick).abs() <= 1e-9 * tick.abs()
        })
    };
    labels((1..DIGITS).find(is_right).unwrap_or(DIGITS))
}

/// `p, GPa`; the bare symbol's own words for a case without units.
#[must_use]
pub fn title(symbol: &str, unit: &str) -> String {
    match unit {
        "" => format!("{symbol} (case units)"),
        unit => format!("{symbol}, {unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_have_no_rounding_noise() {
        assert_eq!(label(0.1 + 0.2, 1.0), "0.3");
        assert_eq!(label(-0.060_000_000_000_000_005, 0.12), "−0.06");
        assert_eq!(label(-1e-18, 0.12), "0");
        assert_eq!(label(40.0, 100.0), "40");
        assert_eq!(label(2.5, 20.0), "2.5");
    }

    #[test]
    fn labels_of_a_logarithmic_axis_tell_its_ticks_apart() {
        assert_eq!(logarithmic_labels(&[0.1, 0.2, 0.5]), ["0.1", "0.2", "0.5"]);
        assert_eq!(logarithmic_labels(&[1.0, 1.5, 2.0]), ["1", "1.5", "2"]);
        assert_eq!(logarithmic_labels(&[1e-5, 1e-3]), ["10⁻⁵", "10⁻³"]);
        assert_eq!(
            logarithmic_labels(&[20.0, 20.5, 21.0]),
            ["20", "20.5", "21"]
        );
    }

    #[test]
    fn an_axis_names_its_unit() {
        assert_eq!(title("p", "GPa"), "p, GPa");
        assert_eq!(title("p", ""), "p (case units)");
    }
}
