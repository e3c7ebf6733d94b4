//! One two-dimensional transform for operators and filters: of fields that are zero-padded, periodic, or mirrored.

pub(crate) mod cosine;
mod even;
mod fourier;
mod half;
mod lines;
mod mirror;
mod padding;
mod plane;

pub(crate) use even::EvenLines;
pub(crate) use fourier::FourierLines;
pub(crate) use half::HalfLines;
pub(crate) use lines::{Columns, Lines};
pub(crate) use mirror::{LINES, MirrorTransform};
pub(crate) use padding::half_length;
pub(crate) use plane::{PlaneSpectrum, PlaneTransform};

/// How a field continues beyond an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Parity {
    /// By its mirror image.
    Even,
    /// By its mirror image with the opposite sign.
    Odd,
}

impl Parity {
    /// The sign of the mirror image.
    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Even => 1.0,
            Self::Odd => -1.0,
        }
    }
}
