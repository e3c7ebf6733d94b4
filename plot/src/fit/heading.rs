//! The heading of a picture of a fit.

/// The two lines above a picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FitHeading {
    /// The title of the fit.
    pub title: String,
    /// The verdict, with its numbers.
    pub numbers: String,
}
