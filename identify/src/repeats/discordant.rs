//! Curves that disagree with the others: of another place, or measured wrongly.
//!
//! Each curve's own parameters, and the size of its residuals, are compared with the median of all, in units of
//! `1.4826` times the median absolute deviation, which no minority of curves can spoil (F. R. Hampel, J. Am. Stat.
//! Assoc. 69, 383 (1974)). The limit depends on the number of curves, so that no more than one in 200 sets of good
//! curves has such a curve. Large residuals say that a curve is not one of the model, and it is left out. Other
//! parameters do not: a specimen may have a soft place, of which the common value and the scatter must know.

use super::curve_fit::CurveFit;
use crate::{Exclusion, outlier::median};

/// Numbers of normal variates, each with the 99.5 % quantile of their largest deviation in those units, from 10⁵
/// samples.
const LIMITS: [(f64, f64); 13] = [
    (4.0, 22.8),
    (5.0, 26.5),
    (6.0, 13.2),
    (7.0, 13.5),
    (8.0, 9.6),
    (9.0, 10.1),
    (10.0, 8.1),
    (12.0, 7.2),
    (15.0, 6.7),
    (20.0, 5.8),
    (30.0, 5.2),
    (50.0, 4.8),
    (100.0, 4.5),
];
/// The median absolute deviation of normal variates is their standard deviation divided by this.
const NORMAL: f64 = 1.4826;
/// To be rough, a curve must also have residuals this many times as large as the median curve's.
const ROUGH: f64 = 2.0;

/// A curve far from the others: its place in the list, the column of the parameter, its distance.
pub(super) struct Discordant {
    pub place: usize,
    pub column: usize,
    pub deviation: f64,
}

/// The curve whose parameter in one of these columns lies farthest beyond the limit.
pub(super) fn farthest(curves: &[&CurveFit], columns: &[usize]) -> Option<Discordant> {
    let limit = limit(curves.len())?;
    let of_column = |&column: &usize| {
        let values: Vec<f64> = curves.iter().map(|curve| curve.own[column]).collect();
        let pairs = curves.iter().zip(deviations(&values)).enumerate();
        let scaled = pairs.map(move |(place, (curve, of))| Discordant {
            place,
            column,
            deviation: of.value / of.scale.max(curve.own_variance[column].sqrt()),
        });
        scaled.collect::<Vec<_>>()
    };
    columns
        .iter()
        .flat_map(of_column)
        .filter(|one| one.deviation.abs() > limit)
        .max_by(|a, b| a.deviation.abs().total_cmp(&b.deviation.abs()))
}

/// The curve whose residuals are farthest above those of the others. Of a curve larger than the median one they may be
/// larger in proportion.
pub(super) fn roughest(curves: &[CurveFit]) -> Option<Exclusion> {
    let limit = limit(curves.len())?;
    let size = median(curves.iter().map(CurveFit::size).collect());
    let of_curve = |curve: &CurveFit| (curve.roughness() / (curve.size() / size).max(1.0)).ln();
    let roughness: Vec<f64> = curves.iter().map(of_curve).collect();
    curves
        .iter()
        .zip(deviations(&roughness))
        .map(|(curve, of)| (curve, of.value.exp(), of.value / of.scale))
        .filter(|(_, factor, deviation)| *factor > ROUGH && *deviation > limit)
        .max_by(|a, b| a.2.total_cmp(&b.2))
        .map(|(curve, roughness, _)| Exclusion {
            curve: curve.index,
            roughness,
        })
}

struct Deviation {
    /// Deviation from the median.
    value: f64,
    /// Scale of all deviations.
    scale: f64,
}

fn deviations(values: &[f64]) -> Vec<Deviation> {
    let centre = median(values.to_vec());
    let distances = values.iter().map(|v| (v - centre).abs()).collect();
    let scale = NORMAL * median(distances);
    values
        .iter()
        .map(|v| Deviation {
            value: v - centre,
            scale,
        })
        .collect()
}

/// The limit for this many curves; `None` for fewer than four, which have no clear majority.
fn limit(curves: usize) -> Option<f64> {
    let count = curves as f64;
    if count < LIMITS[0].0 {
        return None;
    }
    let above = LIMITS
        .iter()
        .position(|(n, _)| *n >= count)
        .unwrap_or(LIMITS.len() - 1);
    let below = if LIMITS[above].0 > count {
        above - 1
    } else {
        above
    };
    // The larger of the two neighbours: even and odd numbers differ.
    Some(LIMITS[above].1.max(LIMITS[below].1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_outlier_does_not_move_the_median() {
        assert_eq!(median(vec![1.0, 2.0, 1e9, 3.0, 2.5]), 2.5);
        assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), 2.5);
    }

    #[test]
    fn limits_are_for_at_least_four_curves() {
        assert_eq!(limit(3), None);
        assert_eq!(limit(8), Some(9.6));
        assert_eq!(limit(11), Some(8.1));
        assert_eq!(limit(1000), Some(4.5));
    }
}
