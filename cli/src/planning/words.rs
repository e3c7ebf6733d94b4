//! Short numbers, spans of forces and counts in words.

use crate::display::{DisplayUnit, significant};

/// Writes a number with at most three digits, without trailing zeros.
#[must_use]
pub fn short(value: f64) -> String {
    let rounded = significant(value, 3);
    rounded
        .parse::<f64>()
        .map_or(rounded, |value| value.to_string())
}

/// Writes a range: `0.1 to 10 mN`.
#[must_use]
pub fn span([least, most]: [f64; 2], scale: &DisplayUnit) -> String {
    let number = |value: f64| short(value / scale.divisor);
    format!("{} to {} {}", number(least), number(most), scale.label)
}

/// Writes a count: `1 curve`, `2 curves`.
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
    fn short_numbers_have_no_trailing_zeros() {
        assert_eq!(short(0.1), "0.1");
        assert_eq!(short(10.0), "10");
    }
}
