//! Widths of expected intervals and spans of forces in words.

use pellicle_identify::{IDENTIFIED_WITHIN, Verdict};

use super::result::ExpectedResult;
use crate::display::{Scale, significant};
use crate::identification::names;

/// A factor from which on an interval counts as lost, even if the bounds are wider.
const MANY: f64 = 1000.0;

/// The number with at most three digits, without zeros at the end.
#[must_use]
pub fn short(value: f64) -> String {
    let rounded = significant(value, 3);
    rounded
        .parse::<f64>()
        .map_or(rounded, |value| value.to_string())
}

/// `0.1 to 10 mN`.
#[must_use]
pub fn span([least, most]: [f64; 2], scale: &Scale) -> String {
    let number = |value: f64| short(value / scale.divisor);
    format!("{} to {} {}", number(least), number(most), scale.label)
}

/// The interval of an unknown over its value: `± 3.4 %`, `factor 2.1`, `lost` where every value between the bounds
/// will fit, `never` where no data can tell it.
#[must_use]
pub fn width(of: &ExpectedResult) -> String {
    if of.verdict == Verdict::NotIdentifiable.to_string() {
        return "never".into();
    }
    match of.factor.filter(|factor| *factor < MANY && !of.is_lost()) {
        Some(factor) if factor <= IDENTIFIED_WITHIN => percents(factor),
        Some(factor) => format!("factor {}", significant(factor, 2)),
        None => "lost".into(),
    }
}

/// What is told in place of numbers that no data can tell: `E (substrate) · R^0.5 ± 0.7 %`.
#[must_use]
pub fn instead(of: &ExpectedResult) -> Option<String> {
    let known = of.known_combination.as_ref()?;
    let product = names::combination(&known.expression);
    let factor = known.interval[1].map(|end| end / known.value);
    let width = match factor {
        Some(factor) if factor <= IDENTIFIED_WITHIN => percents(factor),
        Some(factor) => format!("within a factor {}", significant(factor, 2)),
        None => return None,
    };
    Some(format!("{product} {width}"))
}

fn percents(factor: f64) -> String {
    format!("± {} %", significant(100.0 * (factor - 1.0), 2))
}

/// `1 curve`, `2 curves`.
#[must_use]
pub fn count(number: usize, noun: &str) -> String {
    match number {
        1 => format!("1 {noun}"),
        number => format!("{number} {noun}s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_percents_factors_or_a_word() {
        let of = |factor: Option<f64>, verdict: Verdict| {
            width(&ExpectedResult {
                key: "E".into(),
                unit: "Pa".into(),
                value: 1.0,
                standard_error: None,
                factor,
                interval: [None, None],
                verdict: verdict.to_string(),
                known_combination: None,
            })
        };
        assert_eq!(of(Some(1.0342), Verdict::Identified), "± 3.4 %");
        assert_eq!(of(Some(2.13), Verdict::Weak), "factor 2.1");
        // Between narrow bounds even a narrow interval says nothing.
        assert_eq!(of(Some(1.1), Verdict::NotIdentified), "lost");
        assert_eq!(of(None, Verdict::NotIdentified), "lost");
        assert_eq!(of(None, Verdict::NotIdentifiable), "never");
        assert_eq!(short(0.1), "0.1");
        assert_eq!(short(10.0), "10");
    }
}
