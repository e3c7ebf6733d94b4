//! A curve left out of a fit.

/// A curve that was left out, and why.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Exclusion {
    /// Its parameters are not those of the others.
    Discordant {
        /// Index of the curve, from 0.
        curve: usize,
        /// How far they are from the median, in units of the standard deviation of the others or of its own.
        deviation: f64,
    },
    /// Its residuals are larger than those of the others.
    Rough {
        /// Index of the curve, from 0.
        curve: usize,
        /// How many times as large as those of the median curve.
        factor: f64,
    },
}

impl Exclusion {
    /// Index of the curve.
    #[must_use]
    pub fn curve(&self) -> usize {
        match *self {
            Self::Discordant { curve, .. } | Self::Rough { curve, .. } => curve,
        }
    }
}
