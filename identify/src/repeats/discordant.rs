//! Curves that disagree with the others, for example because the surface was detected wrongly.
//!
//! Each curve's own parameters are compared with the median of all, in units of `1.4826` times the median absolute
//! deviation, which no minority of curves can spoil (F. R. Hampel, J. Am. Stat. Assoc. 69, 383 (1974)). The limit
//! depends on the number of curves, so that no more than one in 200 sets of good curves loses a curve.

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

/// The worst of the discordant curves.
pub(super) fn discordant(curves: &[CurveFit]) -> Option<Exclusion> {
    let limit = limit(curves.len())?;
    let parameters = curves.first()?.own.len();
    let mut worst: Option<(f64, Exclusion)> = None;
    let mut offer = |excess: f64, exclusion: Exclusion| {
        if excess > 1.0 && worst.as_ref().is_none_or(|(most, _)| excess > *most) {
            worst = Some((excess, exclusion));
        }
    };
    for column in 0..parameters {
        let values: Vec<f64> = curves.iter().map(|curve| curve.own[column]).collect();
        for (curve, deviation) in curves.iter().zip(deviations(&values)) {
            let scale = deviation.scale.max(curve.own_variance[column].sqrt());
            let excess = deviation.value.abs() / (scale * limit);
            offer(
                excess,
                Exclusion::Discordant {
                    curve: curve.index,
                    deviation: deviation.value / scale,
                },
            );
        }
    }
    let roughness: Vec<f64> = curves.iter().map(|curve| curve.roughness().ln()).collect();
    for (curve, deviation) in curves.iter().zip(deviations(&roughness)) {
        if deviation.value.exp() > ROUGH {
            let exclusion = Exclusion::Rough {
                curve: curve.index,
                factor: deviation.value.exp(),
            };
            offer(deviation.value / (deviation.scale * limit), exclusion);
        }
    }
    worst.map(|(_, exclusion)| exclusion)
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
