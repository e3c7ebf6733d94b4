//! Ranges of values: `{ from, to, count, spacing = "linear" | "log" }`.

use super::diagnosis::Diagnosis;
use super::reader::Reader;

/// The keys of a range.
pub const KEYS: [&str; 4] = ["from", "to", "count", "spacing"];

/// How the values of a range follow each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spacing {
    /// By the same difference.
    Linear,
    /// By the same factor.
    Log,
}

impl Spacing {
    /// Reads the key `spacing`, linear unless given.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if it is neither of the two words.
    pub fn read(table: &Reader<'_>) -> Result<Self, Diagnosis> {
        match table.optional("spacing") {
            Some(field) => field.choice(&[("linear", Self::Linear), ("log", Self::Log)]),
            None => Ok(Self::Linear),
        }
    }

    /// `count` ≥ 2 values from `from` to `to`, both ends exact.
    #[must_use]
    pub fn between(self, from: f64, to: f64, count: usize) -> Vec<f64> {
        let last = count - 1;
        let value = |i| {
            let t = i as f64 / last as f64;
            match self {
                _ if i == 0 => from,
                _ if i == last => to,
                Self::Linear => from + (to - from) * t,
                Self::Log => from * (to / from).powf(t),
            }
        };
        (0..count).map(value).collect()
    }
}
