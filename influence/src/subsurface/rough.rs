//! Stresses to 2e-6 of the largest at a depth, for searches, at a small part of the cost of the exact ones.
//!
//! The functions of the radius are those of [point loads](super::point_kernels), from a [coarser
//! lattice](super::log_lattice::ROUGH) and fewer [panels](super::radial_panels). They do not depend on the element, so
//! that grids of every size share those of a depth. An element is a sum over Gauss points, and far away from it their
//! average; near the surface the closed form of its half-space is exact, and only the layers' correction is summed.

mod depths;
mod element;

pub use depths::RoughDepths;
pub use element::{RoughPressure, RoughTraction};

/// Within this distance from its centre, in sides, the closed form gives an element near the surface.
const NEAR: f64 = 8.0;

/// At depths below this many sides, Gauss points would resolve an element poorly, and the closed form is used.
const NEAR_SURFACE: f64 = 2.0;

#[cfg(test)]
mod tests;
