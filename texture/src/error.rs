//! Errors for invalid numbers of a grid or a relief.

use std::fmt;

use thiserror::Error;

/// A number that a constructor of this crate checks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Quantity {
    /// Side of the square domain, m.
    Side,
    /// Radius of a cylinder or of the rim of a dimple, m.
    Radius,
    /// Height of a cylinder, m.
    Height,
    /// Distance between neighbouring cylinders, dimples or grooves, m.
    Period,
    /// Position of a cylinder, a dimple or a groove, m.
    Offset,
    /// Rotation of a pattern, radians.
    Rotation,
    /// Depth of a recess, m.
    Depth,
    /// Width of a groove, m.
    Width,
    /// Radius of the arcs that round edges, m.
    EdgeRadius,
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
            Self::Radius => "the radius of a cylinder or a rim",
            Self::Height => "the height of a cylinder",
            Self::Period => "the period of the pattern",
            Self::Offset => "the offset of the pattern",
            Self::Rotation => "the rotation of the pattern",
            Self::Depth => "the depth of a recess",
            Self::Width => "the width of a groove",
            Self::EdgeRadius => "the edge radius",
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
    /// Neighbouring cylinders or rims overlap.
    #[error(
        "found {radius:?} for the radius of overlapping circles, wanted at most half the period of {period:?}"
    )]
    Overlap {
        /// Radius of a cylinder or a rim, m.
        radius: f64,
        /// Period of the lattice, m.
        period: f64,
    },
    /// The arcs that round an edge are longer than what they round.
    #[error(
        "found {found:?} for the edge radius, wanted at most {largest:?}, with which nothing of the edge is left"
    )]
    EdgeRadius {
        /// The edge radius, m.
        found: f64,
        /// The largest that fits, m.
        largest: f64,
    },
    /// Neighbouring recesses overlap once their edges are rounded.
    #[error(
        "found {found:?} for the edge radius, wanted less: rounded recesses are {width:?} wide, more than the period of {period:?}"
    )]
    RoundedOverlap {
        /// The edge radius, m.
        found: f64,
        /// Width of a recess with its roundings, m.
        width: f64,
        /// Period of the pattern, m.
        period: f64,
    },
    /// A dimple is deeper than half a sphere.
    #[error(
        "found {depth:?} for the depth of a dimple, wanted at most the radius of its rim, {radius:?}: half a sphere"
    )]
    DeepDimple {
        /// The depth, m.
        depth: f64,
        /// Radius of the rim, m.
        radius: f64,
    },
    /// Grooves overlap, or leave nothing between vertical walls.
    #[error("found {width:?} for the width of a groove, wanted less than the period of {period:?}")]
    WideGroove {
        /// The width, m.
        width: f64,
        /// Period of the grooves, m.
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
