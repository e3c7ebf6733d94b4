//! The two problems by name.

use std::fmt;

use clap::ValueEnum;
use serde::Serialize;

/// Which of the rivals' common problems.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Case {
    /// A paraboloid on a smooth half-space.
    Hertz,
    /// The same above rigid flat-topped pillars.
    Pillars,
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Hertz => "hertz",
            Self::Pillars => "pillars",
        })
    }
}
