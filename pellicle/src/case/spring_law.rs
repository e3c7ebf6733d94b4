//! `surface.law`: how the springs of a relief shorten.

use serde::Serialize;

use crate::input::diagnosis::Diagnosis;
use crate::input::table_reader::TableReader;

/// The law of the springs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum LawCase {
    /// `w* = η p`.
    #[default]
    Linear,
    /// `w* = h (1 − exp(−p/E))`.
    Logarithmic,
}

impl LawCase {
    /// The key in `[surface]`.
    pub const KEY: &'static str = "law";

    /// Reads the key; the default is linear.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the value is not a law.
    pub fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        let choices = [("linear", Self::Linear), ("logarithmic", Self::Logarithmic)];
        let field = table.optional(Self::KEY);
        field.map_or(Ok(Self::Linear), |field| field.choice(&choices))
    }
}
