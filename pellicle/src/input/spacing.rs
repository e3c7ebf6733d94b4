//! Ranges of values: `{ from, to, count, spacing = "linear" | "log" }`.

use super::diagnosis::Diagnosis;
use super::table_reader::TableReader;

/// The keys of a range.
pub const KEYS: [&str; 4] = ["from", "to", "count", "spacing"];

/// The spacing of the values of a range.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spacing {
    /// Equal differences.
    Linear,
    /// Equal ratios.
    Log,
}

impl Spacing {
    /// Reads the key `spacing`; the default is linear.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the value is neither.
    pub fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        match table.optional("spacing") {
            Some(field) => field.choice(&[("linear", Self::Linear), ("log", Self::Log)]),
            None => Ok(Self::Linear),
        }
    }

    /// Returns `count` ≥ 2 values from `from` to `to`. Both ends are exact, the others have 15 digits: 0.3 rather than
    /// 0.30000000000000004.
    #[must_use]
    pub fn between(self, from: f64, to: f64, count: usize) -> Vec<f64> {
        let last = count - 1;
        let value = |i| {
            let t = i as f64 / last as f64;
            match self {
                _ if i == 0 => from,
                _ if i == last => to,
                Self::Linear => rounded(from + (to - from) * t),
                Self::Log => rounded(from * (to / from).powf(t)),
            }
        };
        (0..count).map(value).collect()
    }
}

/// Rounds to 15 digits.
#[must_use]
pub fn rounded(value: f64) -> f64 {
    format!("{value:.14e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intermediate_values_are_rounded_to_the_shortest_decimals() {
        assert_eq!(
            Spacing::Linear.between(0.1, 0.5, 5),
            [0.1, 0.2, 0.3, 0.4, 0.5]
        );
        assert_eq!(
            Spacing::Log.between(1e-3, 8e-3, 4),
            [1e-3, 2e-3, 4e-3, 8e-3]
        );
        assert_eq!(Spacing::Linear.between(-1.0, 1.0, 3), [-1.0, 0.0, 1.0]);
    }
}
