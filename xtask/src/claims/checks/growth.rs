//! How the largest pressure grows as the grid is refined.

use super::super::Finding;
use super::super::finding::significant;

/// Holds if the largest pressure grows more slowly than `N^threshold` from one grid to a finer one.
///
/// On a half-space the pressure under a rigid edge grows as `ρ^(−1/2)` towards it, so the largest element mean as
/// `N^(1/2)`; a line load, which is what a plate gives, as `N`; a pressure that is finite at the edge as `N^0`.
pub(in super::super) fn peak_settles(
    coarse: (usize, f64),
    fine: (usize, f64),
    threshold: f64,
) -> Finding {
    let exponent = exponent(coarse, fine);
    Finding::new(
        exponent.abs() < threshold,
        format!(
            "{}, grows as N^{}",
            significant(fine.1, 4),
            significant(exponent, 2)
        ),
    )
}

/// The exponent m of `p ~ N^m` between two grids.
pub(in super::super) fn exponent(coarse: (usize, f64), fine: (usize, f64)) -> f64 {
    (fine.1 / coarse.1).ln() / (fine.0 as f64 / coarse.0 as f64).ln()
}

/// The exponent that fits the largest pressures on several grids best, by least squares of the logarithms; none for
/// fewer than two grids.
pub(in super::super) fn fitted_exponent(peaks: &[(usize, f64)]) -> Option<f64> {
    let points: Vec<[f64; 2]> = peaks
        .iter()
        .map(|&(n, p)| [(n as f64).ln(), p.ln()])
        .collect();
    let count = points.len() as f64;
    let mean = [0, 1].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / count);
    let covariance: f64 = points
        .iter()
        .map(|[x, y]| (x - mean[0]) * (y - mean[1]))
        .sum();
    let variance: f64 = points.iter().map(|[x, _]| (x - mean[0]).powi(2)).sum();
    (variance > 0.0).then(|| covariance / variance)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_singular_peak_does_not_settle() {
        let root = |n: usize| (n, (n as f64).sqrt());
        assert!(!peak_settles(root(512), root(1024), 0.1).holds);
        assert!(
            (exponent(root(512), root(1024)) - 0.5).abs() < 1e-12,
            "exact but for rounding"
        );
    }

    #[test]
    fn a_finite_peak_settles() {
        assert!(peak_settles((512, 0.98), (1024, 1.0), 0.1).holds);
    }

    #[test]
    fn the_fit_finds_the_exponent_of_a_power_law_and_none_of_one_point() {
        let peaks: Vec<_> = [64, 128, 256, 512]
            .map(|n| (n, 3.0 * (n as f64).powf(0.7)))
            .to_vec();
        // Exact but for rounding of the logarithms.
        assert!((fitted_exponent(&peaks).unwrap() - 0.7).abs() < 1e-12);
        assert_eq!(fitted_exponent(&peaks[..1]), None);
    }
}
