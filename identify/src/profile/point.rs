//! Points of a profile with their slopes, and cubics through two of them.

use std::rc::Rc;

use crate::predictor::Evaluation;

/// A constrained fit of the scan.
pub(crate) struct Point {
    pub at: Rc<Evaluation>,
    pub x: f64,
    /// `√Δ`.
    pub z: f64,
    /// `dz/d|x|`.
    pub slope: f64,
    /// The minimum of the linear problem over the others, as a point over all unknowns.
    pub least: Vec<f64>,
    /// The tangent `dx_k/dx_j` of the others, over all unknowns.
    pub tangent: Vec<f64>,
}

/// The fraction of the distance between two points at which the cubic through both, with their slopes, reaches the
/// target.
pub(super) fn bracketed(inner: &Point, outer: &Point, width: f64, target: f64) -> f64 {
    let z = |t: f64| {
        let ends = [(0.0, inner), (1.0, outer)];
        hermite(ends.map(|(t, of)| [t, of.z, width * of.slope]), t)
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..50 {
        let middle = f64::midpoint(low, high);
        if z(middle) < target {
            low = middle;
        } else {
            high = middle;
        }
    }
    // Away from both ends, so that the bracket always shrinks.
    f64::midpoint(low, high).clamp(0.05, 0.95)
}

/// The cubic through two points, each with its abscissa, value and slope.
pub(super) fn hermite([[u0, y0, s0], [u1, y1, s1]]: [[f64; 3]; 2], at: f64) -> f64 {
    let width = u1 - u0;
    let t = (at - u0) / width;
    let (t2, t3) = (t * t, t * t * t);
    (2.0 * t3 - 3.0 * t2 + 1.0) * y0
        + (t3 - 2.0 * t2 + t) * width * s0
        + (3.0 * t2 - 2.0 * t3) * y1
        + (t3 - t2) * width * s1
}
