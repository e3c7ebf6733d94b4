//! The sign that a quantity must have.

use crate::input::dimension::Dimension;

/// The sign a quantity must have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sign {
    /// Any finite number.
    Any,
    /// Zero or more.
    NotNegative,
    /// More than zero.
    Positive,
}

impl Sign {
    pub(super) fn allows(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Any => true,
                Self::NotNegative => value >= 0.0,
                Self::Positive => value > 0.0,
            }
    }

    /// Describes the wanted values: `a positive length such as "5 nm"`.
    #[must_use]
    pub fn wanted(self, dimension: Dimension) -> String {
        let noun = dimension.noun();
        let bare = noun.trim_start_matches("an ").trim_start_matches("a ");
        let noun = match self {
            Self::Any => format!("a finite {bare}"),
            Self::NotNegative => format!("{noun} of zero or more"),
            Self::Positive => format!("a positive {bare}"),
        };
        let or_bare = match dimension {
            Dimension::Angle => "a bare number in radians",
            _ => "a bare number",
        };
        format!("{noun} such as {}, or {or_bare}", dimension.example())
    }
}
