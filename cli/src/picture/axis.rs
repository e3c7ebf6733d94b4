//! The labels of an axis.

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
    fn an_axis_names_its_unit() {
        assert_eq!(title("p", "GPa"), "p, GPa");
        assert_eq!(title("p", ""), "p (case units)");
    }
}
