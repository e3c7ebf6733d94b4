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
    /// The filter of each span; one for all where their points are alike, none for white noise.
    filters: Vec<Innovations>,
    log_determinant: f64,
}

impl Whitener {
    /// The factor for curves whose points lie in `spans`, at the model's values and slopes.
    pub fn new(levels: &NoiseLevels, value: &[f64], slope: &[f64], spans: &[Range<usize>]) -> Self {
        let deviation = deviations(levels, value, slope);
        let mut weight = vec![0.0; value.len()];
        let mut log_determinant = 0.0;
        let filters = filters(levels, slope, &deviation, spans);
        for (index, span) in spans.iter().enumerate() {
            for point in span.clone() {
                weight[point] = 1.0 / deviation[point];
                log_determinant += 2.0 * deviation[point].ln();
            }
            let filter = filters.get(index).or(filters.first());
            log_determinant += filter.map_or(0.0, |f| f.log_determinant(span.len()));
        }
        Self {
            spans: spans.to_vec(),
            weight,
            filters,
            log_determinant,
        }
    }

    /// Replaces `v` by `W v`.
    pub fn whiten(&self, column: &mut [f64]) {
        for (value, weight) in column.iter_mut().zip(&self.weight) {
            *value *= weight;
        }
        for (index, span) in self.spans.iter().enumerate() {
            if let Some(filter) = self.filters.get(index).or(self.filters.first()) {
                filter.whiten(&mut column[span.clone()]);
            }
        }
    }

    /// `ln det V`.
    pub fn log_determinant(&self) -> f64 {
        self.log_determinant
    }
}

/// The filters of the correlated part of the noise: of all but the errors of the abscissa, which are white.
fn filters(
    levels: &NoiseLevels,
    slope: &[f64],
    deviation: &[f64],
    spans: &[Range<usize>],
) -> Vec<Innovations> {
    let (persistence, white) = (levels.persistence, levels.white_fraction);
    if persistence == 0.0 || white >= 1.0 {
        return Vec::new();
    }
    if levels.abscissa == 0.0 {
        let longest = spans.iter().map(ExactSizeIterator::len).max();
        return vec![Innovations::new(longest.unwrap_or(0), persistence, white)];
    }
    // h² = 1 − (s σ_Q/σ)²
    let part = |point: usize| {
        let of_abscissa = slope[point] * levels.abscissa / deviation[point];
        (1.0 - of_abscissa * of_abscissa).max(0.0).sqrt()
    };
    let filter =
        |span: &Range<usize>| Innovations::of(span.clone().map(part).collect(), persistence, white);
    spans.iter().map(filter).collect()
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
