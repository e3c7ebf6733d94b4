//! Gauss–Legendre rules, and adaptive integrals to a tolerance.
//!
//! Only this module uses the `quadrature` crate. Its double-exponential rule is fast but does not report failures: it
//! replaces NaN and ±∞ by 0, stops after 385 evaluations whether or not the tolerance is met, and gives 31.7 for the
//! divergent `∫₀¹ dx/x`. Here every value is checked, and every interval is compared with its two halves. Their
//! difference is the error; the interval with the largest error is halved until the sum of the errors is below the
//! tolerance. If the budget of intervals is used up first, an error is returned.

use std::cell::Cell;
use std::num::NonZeroUsize;

use gauss_quad::GaussLegendre;

use crate::error::InfluenceError;

/// Number of intervals after which an integral is abandoned.
const LARGEST_COUNT: usize = 4096;

/// One point of a rule on [−1, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Node {
    /// Position in (−1, 1).
    pub position: f64,
    /// Weight; the weights of a rule add up to 2.
    pub weight: f64,
}

/// The rule of `points` points, exact for polynomials of degree 2 · `points` − 1.
pub(crate) fn legendre(points: NonZeroUsize) -> Vec<Node> {
    GaussLegendre::new(points)
        .into_iter()
        .map(|(position, weight)| Node { position, weight })
        .collect()
}

/// `legendre` for a number of points fixed at compile time.
pub(crate) fn legendre_of<const POINTS: usize>() -> Vec<Node> {
    const { assert!(POINTS > 0) };
    NonZeroUsize::new(POINTS).map_or_else(Vec::new, legendre)
}

/// An integral and an estimate of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Integral {
    pub value: f64,
    /// Estimated absolute error, at most the tolerance.
    pub error: f64,
}

/// `∫ f dx` from `lower` to `upper` to the absolute `tolerance`, starting with `pieces` intervals of equal length.
///
/// The integrand must be finite on the closed interval. One piece per one or two periods of an oscillating
/// integrand saves halvings.
///
/// # Errors
///
/// Limits that are not finite and ascending, an integrand that is not finite, a tolerance that is not reached.
pub(crate) fn integrate(
    f: impl Fn(f64) -> f64,
    [lower, upper]: [f64; 2],
    pieces: usize,
    tolerance: f64,
) -> Result<Integral, InfluenceError> {
    if !(lower.is_finite() && upper.is_finite() && lower < upper) {
        return Err(InfluenceError::IntegrationLimits { lower, upper });
    }
    let pieces = pieces.max(1);
    let rule = IntegrandRule {
        f,
        target: tolerance / (4 * pieces) as f64,
    };
    let end = |piece: usize| lower + (upper - lower) * (piece as f64 / pieces as f64);
    let mut intervals = Vec::with_capacity(pieces);
    for piece in 0..pieces {
        let ends = [end(piece), end(piece + 1)];
        intervals.push(rule.interval(ends, rule.apply(ends)?)?);
    }
    let mut error = total(&intervals, |interval| interval.error);
    while error > tolerance {
        if intervals.len() >= LARGEST_COUNT.max(2 * pieces) {
            return Err(InfluenceError::QuadratureTolerance {
                lower,
                upper,
                wanted: tolerance,
                found: error,
            });
        }
        let worst = intervals.swap_remove(worst_of(&intervals));
        for (ends, whole) in worst.halves() {
            intervals.push(rule.interval(ends, whole)?);
        }
        error = total(&intervals, |interval| interval.error);
    }
    Ok(Integral {
        value: total(&intervals, |interval| interval.left + interval.right),
        error,
    })
}

/// An interval and the integrals over its halves.
#[derive(Clone, Copy, Debug)]
struct Interval {
    ends: [f64; 2],
    left: f64,
    right: f64,
    error: f64,
}

impl Interval {
    fn middle(&self) -> f64 {
        f64::midpoint(self.ends[0], self.ends[1])
    }

    fn halves(&self) -> [([f64; 2], f64); 2] {
        let [lower, upper] = self.ends;
        [
            ([lower, self.middle()], self.left),
            ([self.middle(), upper], self.right),
        ]
    }
}

/// The crate's rule for one integrand.
struct IntegrandRule<F> {
    f: F,
    /// Absolute error requested of one application.
    target: f64,
}

impl<F: Fn(f64) -> f64> IntegrandRule<F> {
    /// Halves an interval whose integral by the rule is `whole`.
    fn interval(&self, ends: [f64; 2], whole: f64) -> Result<Interval, InfluenceError> {
        let middle = f64::midpoint(ends[0], ends[1]);
        let left = self.apply([ends[0], middle])?;
        let right = self.apply([middle, ends[1]])?;
        Ok(Interval {
            ends,
            left,
            right,
            error: (whole - left - right).abs(),
        })
    }

    /// The rule itself, with a check of the integrand's values.
    fn apply(&self, [lower, upper]: [f64; 2]) -> Result<f64, InfluenceError> {
        let offence = Cell::new(None);
        let checked = |x: f64| {
            let value = (self.f)(x);
            if !value.is_finite() {
                offence.set(Some((x, value)));
            }
            value
        };
        #[expect(
            clippy::disallowed_methods,
            reason = "this is the adapter: values are checked above, errors by halving"
        )]
        let output = quadrature::integrate(checked, lower, upper, self.target);
        match offence.get() {
            Some((at, value)) => Err(InfluenceError::IntegrandNotFinite {
                at,
                value,
                lower,
                upper,
            }),
            None => Ok(output.integral),
        }
    }
}

fn total(intervals: &[Interval], part: impl Fn(&Interval) -> f64) -> f64 {
    intervals.iter().map(part).sum()
}

fn worst_of(intervals: &[Interval]) -> usize {
    let errors = intervals.iter().map(|interval| interval.error).enumerate();
    errors
        .fold(
            (0, 0.0),
            |worst, next| if next.1 > worst.1 { next } else { worst },
        )
        .0
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::{integrate, legendre_of};
    use crate::error::InfluenceError;

    fn error_of(f: impl Fn(f64) -> f64, ends: [f64; 2], expected: f64) -> f64 {
        (integrate(f, ends, 1, 1e-12).unwrap().value - expected).abs()
    }

    #[test]
    fn hard_integrands_reach_the_tolerance() {
        // Infinite slope at an end, a kink inside, a narrow peak, 80 oscillations: each to the tolerance.
        assert!(error_of(f64::sqrt, [0.0, 1.0], 2.0 / 3.0) < 1e-12);
        assert!(error_of(|x| (x - 0.3).abs(), [0.0, 1.0], 0.29) < 1e-12);
        let peak = |x: f64| 1e-3 / (1e-6 + (x - 0.7).powi(2));
        let area = (300_f64).atan() + 700_f64.atan();
        assert!(error_of(peak, [0.0, 1.0], area) < 1e-12);
        assert!(error_of(|x| (500.0 * x).cos(), [0.0, 1.0], 500_f64.sin() / 500.0) < 1e-12);
    }

    #[test]
    fn the_reported_error_bounds_the_actual_error() {
        let found = integrate(|x: f64| (x * x).sin(), [0.0, 10.0], 3, 1e-9).unwrap();
        // ∫₀¹⁰ sin x² dx, mpmath 1.3 at 30 digits.
        let made = (found.value - 0.583_670_899_929_623_3).abs();
        assert!(found.error <= 1e-9 && made <= 1e-9);
    }

    #[test]
    fn a_divergent_integral_is_an_error() {
        let outcome = integrate(|x: f64| 1.0 / x, [0.0, 1.0], 1, 1e-8);
        assert!(matches!(
            outcome,
            Err(InfluenceError::QuadratureTolerance { .. }
                | InfluenceError::IntegrandNotFinite { .. })
        ));
        let outcome = integrate(|x: f64| 1.0 / (x - 0.3).powi(2), [0.0, 1.0], 1, 1e-8);
        assert!(outcome.is_err());
    }

    #[test]
    fn an_integrand_that_is_nan_at_a_point_is_an_error() {
        let somewhere = |x: f64| if x > 0.9 { f64::NAN } else { 1.0 };
        assert!(matches!(
            integrate(somewhere, [0.0, 1.0], 1, 1e-8),
            Err(InfluenceError::IntegrandNotFinite { at, .. }) if at > 0.9
        ));
    }

    #[test]
    fn reversed_or_infinite_limits_are_an_error() {
        for ends in [
            [1.0, 0.0],
            [0.0, 0.0],
            [0.0, f64::INFINITY],
            [f64::NAN, 1.0],
        ] {
            let outcome = integrate(f64::cos, ends, 1, 1e-8);
            assert!(matches!(
                outcome,
                Err(InfluenceError::IntegrationLimits { .. })
            ));
        }
    }

    #[test]
    fn a_tolerance_below_rounding_is_an_error() {
        let outcome = integrate(|x: f64| (10.0 * x).sin() * x.exp(), [0.0, PI], 1, 1e-30);
        assert!(matches!(
            outcome,
            Err(InfluenceError::QuadratureTolerance { found, .. }) if found > 1e-30
        ));
    }

    #[test]
    fn twenty_points_integrate_the_38th_power_exactly() {
        let integral: f64 = legendre_of::<20>()
            .iter()
            .map(|node| node.weight * node.position.powi(38))
            .sum();
        // Rounding of 20 terms of at most 1e-2.
        assert!((integral - 2.0 / 39.0).abs() < 1e-16);
    }
}
