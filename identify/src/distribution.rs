//! Quantiles and probabilities of the distributions that intervals and tests need.

use statrs::distribution::{ChiSquared, ContinuousCDF as _, FisherSnedecor, Normal, StudentsT};

/// Degrees of freedom above which Student's distribution equals the normal one to five digits.
const MANY: f64 = 1e6;

/// The two-sided quantile of Student's distribution, such as 1.96 for level 0.95 and many degrees of freedom.
pub(crate) fn student_quantile(level: f64, degrees: f64) -> f64 {
    let p = f64::midpoint(1.0, level);
    if degrees >= MANY {
        return Normal::standard().inverse_cdf(p);
    }
    StudentsT::new(0.0, 1.0, degrees).map_or(f64::NAN, |t| t.inverse_cdf(p))
}

/// Degrees of freedom of Student's distribution with the same quantiles of level 0.95 as a normal number over a
/// standard error whose square `C` is lognormal about the true one, `Var(ln C) = variance`.
///
/// A variance that depends on an estimated correlation has this distribution. In 400 measurements of 60, 120, 240 and
/// 800 points each, its geometric mean equalled the variance of the unknown within 4 %, and 95 % of the quotients were
/// below 2.7, 2.3, 2.1 and 2.05. This function gives 2.75, 2.45, 2.16 and 2.01; Satterthwaite's `2/Var(ln C)` degrees
/// give 4.3 for 60 points.
pub(crate) fn lognormal_degrees(variance: f64) -> f64 {
    let wanted = lognormal_quantile(variance);
    let (mut low, mut high) = (1.0_f64.ln(), MANY.ln());
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if student_quantile(0.95, middle.exp()) > wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high).exp()
}

/// The `q` for which `|z| < q e^{x/2}` has probability 0.95, with `z` and `x` normal with variances one and `variance`.
fn lognormal_quantile(variance: f64) -> f64 {
    // The trapezoidal rule over eight standard deviations is exact to rounding for a smooth integrand.
    let nodes: Vec<(f64, f64)> = (-64..=64)
        .map(|i| f64::from(i) / 8.0)
        .map(|u| (u, (-0.5 * u * u).exp()))
        .collect();
    let total: f64 = nodes.iter().map(|(_, weight)| weight).sum();
    let inside = |q: f64| {
        let probability = |u: f64| 2.0 * normal_below(q * (0.5 * variance.sqrt() * u).exp()) - 1.0;
        let sum: f64 = nodes
            .iter()
            .map(|(u, weight)| weight * probability(*u))
            .sum();
        sum / total
    };
    let (mut low, mut high) = (1.0, 1e4);
    for _ in 0..100 {
        let middle = f64::midpoint(low, high);
        if inside(middle) < 0.95 {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high)
}

/// The probability that χ² exceeds a value.
pub(crate) fn chi_squared_above(value: f64, degrees: f64) -> f64 {
    ChiSquared::new(degrees).map_or(f64::NAN, |chi| chi.sf(value))
}

/// The probability that Fisher's F exceeds a value.
pub(crate) fn fisher_above(value: f64, numerator: f64, denominator: f64) -> f64 {
    if denominator >= MANY {
        return chi_squared_above(value * numerator, numerator);
    }
    FisherSnedecor::new(numerator, denominator).map_or(f64::NAN, |f| f.sf(value))
}

/// The probability that a standard normal variable is below a value.
pub(crate) fn normal_below(value: f64) -> f64 {
    Normal::standard().cdf(value)
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn quantiles_match_the_tables() {
        // Abramowitz and Stegun, Handbook of Mathematical Functions, table 26.10 and its limit, to their digits.
        assert_relative_eq!(student_quantile(0.95, 1.0), 12.706, max_relative = 1e-4);
        assert_relative_eq!(student_quantile(0.95, 10.0), 2.228, max_relative = 3e-4);
        assert_relative_eq!(student_quantile(0.95, 1e9), 1.959_964, max_relative = 1e-6);
        // Table 26.8: χ² = 3.84146 with one degree of freedom at 5 %.
        assert_relative_eq!(chi_squared_above(3.84146, 1.0), 0.05, max_relative = 1e-5);
    }

    #[test]
    fn a_lognormal_variance_has_shorter_tails_than_a_chi_squared_one_of_equal_degrees() {
        assert_relative_eq!(lognormal_quantile(0.0), 1.959_964, max_relative = 1e-6);
        for degrees in [2.0, 8.0, 50.0] {
            let found = lognormal_degrees(2.0 / degrees);
            assert!(found > degrees, "{degrees}: {found}");
            assert_relative_eq!(
                student_quantile(0.95, found),
                lognormal_quantile(2.0 / degrees),
                max_relative = 1e-9
            );
        }
        // Checked on the quotients themselves: of a million, 95 % are below 2.78 with Var(ln C) = 1, to 0.01.
        let mut state = 1_u64;
        let mut uniform = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            ((state >> 11) as f64 + 0.5) / 9_007_199_254_740_992.0
        };
        let wanted = lognormal_quantile(1.0);
        let below = (0..1_000_000)
            .filter(|_| {
                // G. E. P. Box and M. E. Muller, Ann. Math. Stat. 29, 610 (1958): two normal variates.
                let (radius, angle) = (
                    (-2.0 * uniform().ln()).sqrt(),
                    std::f64::consts::TAU * uniform(),
                );
                (radius * angle.cos()).abs() < wanted * (0.5 * radius * angle.sin()).exp()
            })
            .count();
        // Four standard deviations of a binomial variable.
        assert!((below as f64 - 950_000.0).abs() < 900.0, "{below}");
    }

    #[test]
    fn fisher_with_one_numerator_degree_is_student_squared() {
        let t = student_quantile(0.95, 7.0);
        // The accuracy of an inverse distribution in statrs.
        assert_relative_eq!(fisher_above(t * t, 1.0, 7.0), 0.05, max_relative = 1e-6);
    }
}
