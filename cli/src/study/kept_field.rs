//! A field of every case kept in one file.

use serde::{Deserialize, Serialize};

/// A field that can be kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum KeptField {
    /// Pressure `p`.
    Pressure,
    /// Displacement `u` of the surface.
    Displacement,
    /// Gap `g`.
    Gap,
    /// Shortening `w*` of the relief.
    Shortening,
    /// Profile `f*` of the relief.
    Profile,
}

impl KeptField {
    /// The words of `study.keep`, in the order of [`Fields::numbers`](crate::output::fields::Fields::numbers).
    pub const CHOICES: [(&'static str, Self); 5] = [
        ("pressure", Self::Pressure),
        ("displacement", Self::Displacement),
        ("gap", Self::Gap),
        ("shortening", Self::Shortening),
        ("profile", Self::Profile),
    ];

    /// Whether the field is computed from the pressure by a product with `K`.
    #[must_use]
    pub fn is_of_the_surface(self) -> bool {
        matches!(self, Self::Displacement | Self::Gap | Self::Shortening)
    }
}
