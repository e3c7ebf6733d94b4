//! What one check found on one grid.

/// Whether a sentence holds on one grid, and the number that decides it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// Whether it holds there.
    pub holds: bool,
    /// The deciding quantity in words and digits, for the tables.
    pub measured: String,
}

impl Finding {
    /// A finding with its number in words.
    pub(super) fn new(holds: bool, measured: impl Into<String>) -> Self {
        Self {
            holds,
            measured: measured.into(),
        }
    }

    /// A finding about something of which there is nothing to look at, which never bears a sentence out.
    pub(super) fn nothing(missing: &str) -> Self {
        Self::new(false, format!("no {missing}"))
    }
}

/// Smaller fractions are shown as 0: solutions are certified to 1e-8, and their differences mean less than that.
const NOTHING: f64 = 1e-7;

/// A fraction as a percentage with three significant digits.
pub(super) fn percent(fraction: f64) -> String {
    if fraction.abs() < NOTHING {
        return "0 %".into();
    }
    format!("{} %", significant(100.0 * fraction, 3))
}

/// A number with so many significant digits; powers of ten where plain digits would be long.
pub(super) fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let last = digits.saturating_sub(1);
    let scientific = format!("{value:.last$e}");
    let exponent: i32 = scientific
        .rsplit_once('e')
        .and_then(|(_, exponent)| exponent.parse().ok())
        .unwrap_or_default();
    if !(-3..=4).contains(&exponent) {
        return scientific;
    }
    let decimals = usize::try_from(i64::try_from(last).unwrap_or(0) - i64::from(exponent));
    format!("{value:.*}", decimals.unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_significant_digits() {
        let shown = [0.011_084_9, 0.0, 1.0, 12.3456, -0.339, 99.999].map(|x| significant(x, 3));
        assert_eq!(shown, ["0.0111", "0", "1.00", "12.3", "-0.339", "100"]);
        assert_eq!(significant(3.571e-6, 3), "3.57e-6");
    }

    #[test]
    fn a_share_is_shown_in_percent() {
        assert_eq!(percent(0.011_084_9), "1.11 %");
        assert_eq!(percent(1.0), "100 %");
        assert_eq!(percent(-3e-16), "0 %");
    }
}
