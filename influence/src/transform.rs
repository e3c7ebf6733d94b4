//! One two-dimensional transform for operators and filters: of fields that are zero around themselves, periodic, or
//! mirrored.

pub(crate) mod cosine;
mod even;
mod fourier;
mod lines;
mod padding;
mod plane;

pub(crate) use even::EvenLines;
pub(crate) use fourier::FourierLines;
pub(crate) use lines::Lines;
pub(crate) use padding::half_length;
pub(crate) use plane::PlaneTransform;
