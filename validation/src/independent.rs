//! Independent solutions for axisymmetric contact and stress: no grid, no elements, no transform of the other crates.
//!
//! Both start from the kernel's amplitudes of single waves, which are tested separately, and share nothing else with
//! the code that they check. Pressures come from [`fredholm`]'s integral equation, fields from [`hankel`]'s integrals.

pub mod fredholm;
pub mod hankel;

use std::num::NonZeroUsize;
use std::sync::LazyLock;

use gauss_quad::GaussLegendre;

/// Points of the quadrature rule.
const POINTS: NonZeroUsize = NonZeroUsize::new(16).expect("16 is not 0");

/// Nodes and weights on [−1, 1].
static RULE: LazyLock<Vec<(f64, f64)>> =
    LazyLock::new(|| GaussLegendre::new(POINTS).into_iter().collect());

/// Returns nodes and weights of a 16-point rule on each interval between neighbouring `borders`.
#[must_use]
pub fn composite(borders: &[f64]) -> Vec<(f64, f64)> {
    let piece = |ends: &[f64]| {
        let (middle, half) = (f64::midpoint(ends[0], ends[1]), (ends[1] - ends[0]) / 2.0);
        RULE.iter()
            .map(move |(node, weight)| (middle + half * node, half * weight))
            .collect::<Vec<_>>()
    };
    borders.windows(2).flat_map(piece).collect()
}

/// Returns borders from 0 to `end`: powers of two up to `width`, then steps of that width.
#[must_use]
pub fn graded(end: f64, width: f64) -> Vec<f64> {
    let small = (0..24).rev().map(|halvings| width * 0.5_f64.powi(halvings));
    let steps = (end / width).ceil().max(1.0);
    let rest = (2..)
        .map(|step| width * f64::from(step))
        .take_while(|border| *border < width * (steps + 0.5));
    std::iter::once(0.0).chain(small).chain(rest).collect()
}
