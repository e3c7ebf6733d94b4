//! Errors for invalid numbers of a grid or a relief.

use std::fmt;

use thiserror::Error;

/// A number that a constructor of this crate checks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Quantity {
    /// Side of the square domain, m.
    Side,
    /// Radius of a cylinder, m.
    Radius,
    /// Height of a cylinder, m.
    Height,
    /// Distance between the axes of neighbouring cylinders, m.
    Period,
    /// Position of the cylinder nearest to the axis, m.
    Offset,
    /// Thickness of a film, m.
    Thickness,
    /// Young's modulus of the relief, Pa.
    YoungModulus,
    /// Compliance of the relief, m/Pa.
    Compliance,
    /// Side of a measured map, m.
    Extent,
}

impl fmt::Display for Quantity {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Side => "the side of the domain",
            Self::Radius => "the radius of a cylinder",
            Self::Height => "the height of a cylinder",
            Self::Period => "the period of the cylinders",
            Self::Offset => "the offset of the cylinders",
            Self::Thickness => "the thickness of the film",
            Self::YoungModulus => "Young's modulus of the relief",
            Self::Compliance => "the compliance of the relief",
            Self::Extent => "the extent of the map",
        })
    }
}

/// Why a grid or a relief cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TextureError {
    /// A number that must be positive and finite is not.
    #[error("found {found} for {quantity}, wanted a positive finite number")]
    NotPositive {
        /// The quantity.
        quantity: Quantity,
        /// Its value.
        found: f64,
    },
    /// A number that must be zero or positive, and finite, is not.
    #[error("found {found} for {quantity}, wanted a finite number of zero or more")]
    Negative {
        /// The quantity.
        quantity: Quantity,
        /// Its value.
        found: f64,
    },
    /// Stiffening springs are requested, but they have no height.
    #[error(
        "found a compliance of {found} for stiffening springs, wanted a Young's modulus, which gives them a height"
    )]
    NoHeight {
        /// The compliance, m/Pa.
        found: f64,
    },
    /// A number that must be finite is not.
    #[error("found {found} for {quantity}, wanted a finite number")]
    NotFinite {
        /// The quantity.
        quantity: Quantity,
        /// Its value.
        found: f64,
    },
    /// The number of elements per side is zero or too large for any memory.
    #[error("found {found} elements per side, wanted 1 to {largest}")]
    GridSize {
        /// Number of elements per side requested.
        found: usize,
        /// The most that [`Grid`](crate::Grid) accepts.
        largest: usize,
    },
    /// Neighbouring cylinders overlap.
    #[error(
        "found {radius:?} for the radius of overlapping cylinders, wanted at most half the period of {period:?}"
    )]
    Overlap {
        /// Radius of a cylinder, m.
        radius: f64,
        /// Period of the lattice, m.
        period: f64,
    },
    /// The number of samples is not the product of the map's shape, or the map is empty.
    #[error("found {found} values for a map of {} by {} samples, wanted one per sample", shape[0], shape[1])]
    MapShape {
        /// Samples along x and along y.
        shape: [usize; 2],
        /// Values given.
        found: usize,
    },
    /// A sample of a map is NaN or infinite.
    #[error("found {found} for sample [{}, {}] of the map, wanted a finite number", index[0], index[1])]
    MapSample {
        /// Index along x and along y.
        index: [usize; 2],
        /// The value found there.
        found: f64,
    },
}

/// The value itself, if it is positive and finite.
pub(crate) fn positive(quantity: Quantity, found: f64) -> Result<f64, TextureError> {
    if found > 0.0 && found.is_finite() {
        Ok(found)
    } else {
        Err(TextureError::NotPositive { quantity, found })
    }
}

/// The value itself, if it is zero or positive, and finite.
pub(crate) fn not_negative(quantity: Quantity, found: f64) -> Result<f64, TextureError> {
    if found >= 0.0 && found.is_finite() {
        Ok(found)
    } else {
        Err(TextureError::Negative { quantity, found })
    }
}

/// The value itself, if it is finite.
pub(crate) fn finite(quantity: Quantity, found: f64) -> Result<f64, TextureError> {
    if found.is_finite() {
        Ok(found)
    } else {
        Err(TextureError::NotFinite { quantity, found })
    }
}
