//! `surface.law`: how the springs of a relief shorten.

use pellicle_texture::SpringLaw;
use serde::Serialize;

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

    /// The words of the laws.
    pub const WORDS: &'static [(&'static str, Self)] =
        &[("linear", Self::Linear), ("logarithmic", Self::Logarithmic)];
}

impl From<SpringLaw> for LawCase {
    fn from(law: SpringLaw) -> Self {
        if law == SpringLaw::LINEAR {
            Self::Linear
        } else {
            Self::Logarithmic
        }
    }
}
