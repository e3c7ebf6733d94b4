//! The zero of the depth: where the loading, extrapolated, begins.
//!
//! The first part of a loading follows `P = α (h − h₀)^m` with an exponent near 2 under a sharp tip and 3/2 under its
//! round end; ISO 14577-1 extrapolates such a law to no force.

use std::ops::Range;

use super::Uncertain;
use super::unloading::UnloadingFit;
use crate::measured::cycles::{is_first_loading, median};

/// The forces to which the law is fitted, as parts of the largest: below, noise and the baseline count, above, the law
/// of a blunt tip has changed.
const FORCES: Range<f64> = 0.01..0.3;
/// The exponents of loadings: from a flat punch to what hardens with the depth.
const EXPONENTS: [f64; 2] = [1.0, 3.0];
/// The fewest points of the fit.
const FEWEST_POINTS: usize = 8;

/// The depth (m) at which a loading begins, of corrected depths (m) and forces (N) from the place `start` to the hold
/// `top`; none for too few points.
pub(super) fn first_contact(
    depth: &[f64],
    force: &[f64],
    start: usize,
    top: &Range<usize>,
) -> Option<Uncertain> {
    let largest = median(&force[top.clone()]);
    let [low, high] = [FORCES.start, FORCES.end].map(|part| part * largest);
    let is_first = is_first_loading(&force[..top.start]);
    // From the deepest, as an unloading runs; without what is loaded again.
    let points = (start..top.start).rev();
    let chosen = points.filter(|at| is_first[*at] && (low..=high).contains(&force[*at]));
    let (depths, forces): (Vec<f64>, Vec<f64>) = chosen.map(|at| (depth[at], force[at])).unzip();
    if depths.len() < FEWEST_POINTS {
        return None;
    }
    let law = UnloadingFit::within(EXPONENTS, &depths, &forces, high).ok()?;
    Some(law.without_force())
}
