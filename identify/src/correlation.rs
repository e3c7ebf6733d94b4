//! Correlation from covariance.

/// `ρ_ij = C_ij/√(C_ii C_jj)`; zero where a variance is infinite.
pub(crate) fn correlation(covariance: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let entry = |i: usize, j: usize| {
        if i == j {
            return 1.0;
        }
        covariance[i][j] / (covariance[i][i].sqrt() * covariance[j][j].sqrt())
    };
    (0..covariance.len())
        .map(|i| (0..covariance.len()).map(|j| entry(i, j)).collect())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_infinite_variance_gives_zero_correlation() {
        let c = correlation(&[
            vec![4.0, 3.0, 0.0],
            vec![3.0, 9.0, 0.0],
            vec![0.0, 0.0, f64::INFINITY],
        ]);
        assert_eq!(c, [[1.0, 0.5, 0.0], [0.5, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    }
}
