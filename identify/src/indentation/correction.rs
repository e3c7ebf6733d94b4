//! The drift of the depth, from a hold at a constant force.

use std::ops::Range;

use super::{IndentationError, Uncertain};
use crate::autoregressive::{MOST_PERSISTENT, dependence, persistence};
use crate::orthonormal_basis::{OrthonormalBasis, dot};

/// The first part of a hold is left out: there the body still recovers.
const SETTLING: f64 = 1.0 / 3.0;
/// The fewest points of a line.
const FEWEST_POINTS: usize = 4;

/// The hold that gives the drift.
#[derive(Debug, Clone, PartialEq)]
pub struct DriftHold {
    /// The points of the hold.
    pub points: Range<usize>,
    /// Rate of the depth, m/s, over the hold without its first third.
    pub rate: Uncertain,
    /// The rate over the first half of what is left, and over the second, m/s.
    pub halves: [Uncertain; 2],
}

impl DriftHold {
    /// The line through the depths of a hold.
    pub(super) fn of(
        time: &[f64],
        depth: &[f64],
        points: Range<usize>,
    ) -> Result<Self, IndentationError> {
        let [first, last] = [points.start, points.end - 1].map(|at| time[at]);
        let settled = first + SETTLING * (last - first);
        let middle = f64::midpoint(settled, last);
        let rate = |from: f64, to: f64| {
            let chosen = points.clone().filter(|at| (from..=to).contains(&time[*at]));
            let (t, h): (Vec<f64>, Vec<f64>) = chosen.map(|at| (time[at], depth[at])).unzip();
            Line::through(&t, &h, None)
                .map(|line| line.slope)
                .ok_or(IndentationError::NoHold)
        };
        Ok(Self {
            rate: rate(settled, last)?,
            halves: [rate(settled, middle)?, rate(middle, last)?],
            points,
        })
    }

    /// Whether the two halves differ beyond their noise, so that the rate is not one of the instrument alone.
    #[must_use]
    pub fn bends(&self) -> bool {
        let [one, other] = self.halves;
        let error = one.sd.hypot(other.sd);
        // Four standard errors, and a change that matters.
        (one.value - other.value).abs() > 4.0 * error
            && (one.value - other.value).abs() > 0.5 * self.rate.value.abs()
    }
}

/// The correlation of neighbours of which `n` residuals of a line tell: theirs is too small by `(1 + 4 φ)/n`. After
/// F. H. C. Marriott and J. A. Pope, Biometrika 41, 390 (1954), who have 3 φ for a mean.
fn persistence_beside_line(residual: &[f64]) -> f64 {
    let told = persistence(residual);
    (told + (1.0 + 4.0 * told) / residual.len() as f64).min(MOST_PERSISTENT)
}

/// A straight line through points.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    /// The value at the last abscissa.
    pub(super) last: Uncertain,
    /// The slope.
    pub(super) slope: Uncertain,
}

impl Line {
    /// The line of least squares; so many neighbouring points count as one, as many as the residuals tell if that is
    /// not known. None for too few points.
    pub(super) fn through(x: &[f64], y: &[f64], known: Option<f64>) -> Option<Self> {
        if x.len() < FEWEST_POINTS {
            return None;
        }
        let last = *x.last()?;
        let from_last = x.iter().map(|x| x - last).collect();
        let basis = OrthonormalBasis::of([vec![1.0; x.len()], from_last]);
        let mut rest = y.to_vec();
        let components = basis.remove_from(&mut rest);
        let [value, slope] = basis.coefficients(&components)[..] else {
            return None;
        };
        let dependence = known.unwrap_or_else(|| dependence(persistence_beside_line(&rest), 0.0));
        let variance = dot(&rest, &rest) / (x.len() as f64 - 2.0) * dependence;
        let covariance = basis.inverse_gram();
        let with_sd = |value: f64, k: usize| Uncertain {
            value,
            sd: (variance * covariance[k][k]).sqrt(),
        };
        Some(Self {
            last: with_sd(value, 0),
            slope: with_sd(slope, 1),
        })
    }
}
