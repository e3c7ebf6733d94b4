//! Rules of 16 points on the pieces between neighbouring borders, and borders that follow the integrand.

use std::num::NonZeroUsize;
use std::sync::LazyLock;

use gauss_quad::GaussLegendre;

/// Points of the quadrature rule.
pub(super) const POINTS: usize = 16;

/// Nodes and weights on [−1, 1].
pub(super) static RULE: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| {
    let points = NonZeroUsize::new(POINTS).expect("the number of points is not 0");
    GaussLegendre::new(points).into_iter().collect()
});

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

/// Returns borders between two ends, halving every piece that is too wide.
pub(super) fn halved([start, end]: [f64; 2], is_too_wide: &dyn Fn([f64; 2]) -> bool) -> Vec<f64> {
    let mut borders = vec![start];
    let mut ends = vec![end];
    while let (Some(last), Some(next)) = (borders.last().copied(), ends.last().copied()) {
        if is_too_wide([last, next]) {
            ends.push(f64::midpoint(last, next));
        } else {
            borders.push(next);
            ends.pop();
        }
    }
    borders
}
