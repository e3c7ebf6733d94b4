//! Young's modulus of a layer: uniform, or graded from the top of the layer to its bottom.

use serde::Serialize;

use crate::declare::macros::record;
use crate::declare::{pressure, word};

/// Young's modulus of a layer, Pa.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ModulusCase {
    /// The same at every depth.
    Uniform(f64),
    /// Changing with depth.
    Graded(GradingCase),
}

record! {
    /// A Young's modulus that changes with depth.
    #[derive(Copy)]
    pub struct GradingCase {
        from: f64 = pressure().positive(), "modulus at the top of the layer";
        to: f64 = pressure().positive(), "modulus at its bottom";
        profile: GradingProfile = word(PROFILES), "how it changes in between";
    }
}

const PROFILES: &[(&str, GradingProfile)] = &[
    ("linear", GradingProfile::Linear),
    ("exponential", GradingProfile::Exponential),
];

/// The profile of a graded modulus between top and bottom.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum GradingProfile {
    /// Changes by the same amount over equal depths.
    Linear,
    /// Changes by the same factor over equal depths.
    Exponential,
}

impl ModulusCase {
    /// The modulus at the top, Pa.
    #[must_use]
    pub fn at_top(self) -> f64 {
        match self {
            Self::Uniform(modulus) | Self::Graded(GradingCase { from: modulus, .. }) => modulus,
        }
    }
}

impl GradingCase {
    /// The modulus (Pa) at this fraction of the thickness, 0 at the top and 1 at the bottom.
    #[must_use]
    pub fn at(self, part: f64) -> f64 {
        let Self { from, to, profile } = self;
        match profile {
            GradingProfile::Linear => from + (to - from) * part,
            GradingProfile::Exponential => from * (to / from).powf(part),
        }
    }
}
