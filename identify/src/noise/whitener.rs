//! The whitening factor of the covariance of all points, applied to columns.

use std::ops::Range;

use super::{NoiseLevels, PointErrors};
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
    /// The factor for curves whose points lie in `spans`, at the model's values and slopes, with the known errors of
    /// each point; no errors are zeros.
    pub fn new(
        levels: &NoiseLevels,
        [value, slope]: [&[f64]; 2],
        errors: &[PointErrors],
        spans: &[Range<usize>],
    ) -> Self {
        let deviation = deviations(levels.variances(value, slope, errors));
        let mut weight = vec![0.0; value.len()];
        let mut log_determinant = 0.0;
        let filters = filters(levels, [slope, &deviation], errors, spans);
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

/// The filters of the correlated part of the noise: of all but the errors of the abscissa and the known ones of single
/// points, which are white.
fn filters(
    levels: &NoiseLevels,
    [slope, deviation]: [&[f64]; 2],
    errors: &[PointErrors],
    spans: &[Range<usize>],
) -> Vec<Innovations> {
    let (persistence, white) = (levels.persistence, levels.white_fraction);
    if persistence == 0.0 || white >= 1.0 {
        return Vec::new();
    }
    if levels.abscissa == 0.0 && errors.is_empty() {
        let longest = spans.iter().map(ExactSizeIterator::len).max();
        return vec![Innovations::new(longest.unwrap_or(0), persistence, white)];
    }
    // h² = 1 − (s σ_Q/σ)² − (σ_known/σ)²
    let part = |point: usize| {
        let of_abscissa = slope[point] * levels.abscissa / deviation[point];
        let known = errors.get(point);
        let known = known.map_or(0.0, |of| {
            of.variance(slope[point]) / deviation[point].powi(2)
        });
        (1.0 - of_abscissa * of_abscissa - known).max(0.0).sqrt()
    };
    let filter =
        |span: &Range<usize>| Innovations::of(span.clone().map(part).collect(), persistence, white);
    spans.iter().map(filter).collect()
}

/// The standard deviations of variances, none far below the typical one.
fn deviations(variance: Vec<f64>) -> Vec<f64> {
    let typical = variance.iter().sum::<f64>() / variance.len() as f64;
    let least = (LEAST_DEVIATION * LEAST_DEVIATION * typical).max(f64::MIN_POSITIVE);
    variance.into_iter().map(|v| v.max(least).sqrt()).collect()
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
        let (value, slope) = ([0.0, 8.0, 0.0], [2.0, 0.0, 0.0]);
        let whitener = Whitener::new(&levels, [&value, &slope], &[], &[0..2, 2..3]);
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

    #[test]
    fn known_errors_of_a_point_add_to_its_variance_and_are_white() {
        let levels = NoiseLevels {
            observed: 3.0,
            abscissa: 0.0,
            relative: 0.0,
            persistence: 0.9,
            white_fraction: 0.0,
        };
        let own = PointErrors {
            observed: 16.0,
            ..PointErrors::default()
        };
        let flat = [[1.0; 2], [0.0; 2]];
        let [value, slope] = &flat;
        let spans = crate::problem::spans(std::iter::once(2));
        let whitener = Whitener::new(&levels, [value, slope], &[own, own], &spans);
        // The covariance 9 · 0.9 of variances 9 + 16.
        let wanted = (25.0_f64 * 25.0 - 8.1 * 8.1).ln();
        assert_relative_eq!(whitener.log_determinant(), wanted, max_relative = 1e-14);
    }
}
