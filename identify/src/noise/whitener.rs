//! The whitening factor of the covariance of all points, applied to columns.

use std::ops::Range;

use super::NoiseLevels;
use crate::autoregressive::Innovations;

/// A point's standard deviation is at least this fraction of the typical one, so that a point of value zero does not
/// get an infinite weight under relative noise.
const LEAST_DEVIATION: f64 = 1e-3;

/// `W` with `Wᵀ W = V⁻¹` for the covariance `V` of all points.
#[derive(Debug, Clone)]
pub(crate) struct Whitener {
    spans: Vec<Range<usize>>,
    /// `1/σ_i`.
    weight: Vec<f64>,
    filter: Option<Innovations>,
    log_determinant: f64,
}

impl Whitener {
    /// The factor for curves whose points lie in `spans`, at the model's values and slopes.
    pub fn new(levels: &NoiseLevels, value: &[f64], slope: &[f64], spans: &[Range<usize>]) -> Self {
        let deviation = deviations(levels, value, slope);
        let mut weight = vec![0.0; value.len()];
        let mut log_determinant = 0.0;
        let longest = spans.iter().map(ExactSizeIterator::len).max().unwrap_or(0);
        let filter = (levels.persistence > 0.0 && levels.white_fraction < 1.0)
            .then(|| Innovations::new(longest, levels.persistence, levels.white_fraction));
        for span in spans {
            for point in span.clone() {
                weight[point] = 1.0 / deviation[point];
                log_determinant += 2.0 * deviation[point].ln();
            }
            log_determinant += filter
                .as_ref()
                .map_or(0.0, |f| f.log_determinant(span.len()));
        }
        Self {
            spans: spans.to_vec(),
            weight,
            filter,
            log_determinant,
        }
    }

    /// Replaces `v` by `W v`.
    pub fn whiten(&self, column: &mut [f64]) {
        for (value, weight) in column.iter_mut().zip(&self.weight) {
            *value *= weight;
        }
        if let Some(filter) = &self.filter {
            for span in &self.spans {
                filter.whiten(&mut column[span.clone()]);
            }
        }
    }

    /// `ln det V`.
    pub fn log_determinant(&self) -> f64 {
        self.log_determinant
    }
}

/// `σ_i = √(σ_D² + (ρ y_i)² + (s_i σ_Q)²)`.
fn deviations(levels: &NoiseLevels, value: &[f64], slope: &[f64]) -> Vec<f64> {
    let pairs = value.iter().zip(slope);
    let variance: Vec<f64> = pairs.map(|(y, s)| levels.variance(*y, *s)).collect();
    let typical = variance.iter().sum::<f64>() / variance.len() as f64;
    let least = (LEAST_DEVIATION * LEAST_DEVIATION * typical).max(f64::MIN_POSITIVE);
    variance.iter().map(|v| v.max(least).sqrt()).collect()
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn errors_of_both_axes_add_as_variances() {
        let levels = NoiseLevels {
            observed: 3.0,
            abscissa: 2.0,
            relative: 0.5,
            persistence: 0.0,
            white_fraction: 1.0,
        };
        // 3² + 4², 3² + (½ 8)², 3².
        let whitener = Whitener::new(&levels, &[0.0, 8.0, 0.0], &[2.0, 0.0, 0.0], &[0..2, 2..3]);
        let mut column = [5.0, 10.0, 6.0];
        whitener.whiten(&mut column);
        assert_eq!(column, [1.0, 2.0, 2.0]);
        // ln 25 twice and ln 9, to rounding.
        assert_relative_eq!(
            whitener.log_determinant(),
            5625.0_f64.ln(),
            max_relative = 1e-15
        );
    }
}
