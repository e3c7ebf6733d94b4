//! Tests of whether the model follows the data.
//!
//! There are up to seven tests, each with its own probability under a true model: χ² if the noise is known, runs of
//! signs and the Durbin–Watson statistic for correlated residuals, the lower half of the abscissae against the whole, a
//! smooth change of the curve that the model lacks, or for repeats one that all of them share, and the persistence of
//! correlated noise, which must not be long enough to hide a misfit. The misfit probability is the smallest of these
//! times their number (Bonferroni), so a true model is refused no more often than this, however the tests are
//! correlated.

use crate::{
    Correlation, Problem,
    departure::{HIGHEST_DEGREE, range, smooth_columns},
    distribution::{chi_squared_above, fisher_above, normal_below},
    metric::Metric,
    orthonormal_basis::{OrthonormalBasis, dot},
    predictor::Evaluation,
};

/// A fit is refused below this probability.
pub const REFUSAL: f64 = 0.01;

/// Below this `χ²/ν`, which only noise given in part or whole can leave, the residuals are less than a tenth of the
/// noise: their order then says nothing about the model, however regular it is.
const NEGLIGIBLE: f64 = 0.01;

/// How well the model follows the data.
#[derive(Debug, Clone, PartialEq)]
pub struct Goodness {
    /// Number of fitted points.
    pub points: usize,
    /// Points plus priors, minus unknowns and nuisances.
    pub degrees_of_freedom: f64,
    /// `χ²/ν`; near one by construction where the noise is estimated.
    pub chi_squared_per_degree: f64,
    /// Probability of a larger χ²; `None` if the noise is estimated.
    pub chi_squared_p: Option<f64>,
    /// Probability of as few runs of equal sign among the whitened residuals.
    pub runs_p: f64,
    /// `d = Σ (r_i − r_{i−1})²/Σ r_i²` of the whitened residuals, 2 without correlation.
    pub durbin_watson: f64,
    /// Probability of a `d` as small as this.
    pub durbin_watson_p: f64,
    /// Probability of as large a difference between the unknowns fitted to the lower half of the abscissae and to all;
    /// `None` if the halves do not determine them.
    pub lower_half_p: Option<f64>,
    /// Probability that noise with a correlation length of at most a tenth of its curve looks as persistent as the
    /// estimated noise; `None` if no correlation is estimated.
    pub persistence_p: Option<f64>,
    /// Probability of as large a smooth part of the residuals: the curve times a polynomial in the logarithm of the
    /// abscissa, beyond what unknowns and nuisances can reproduce; `None` if they reproduce all of it.
    pub smooth_p: Option<f64>,
    /// For repeats, the probability that independent curves have as large a smooth part of the residuals in common;
    /// `None` for fewer than three.
    pub common_p: Option<f64>,
    /// The smallest of these times their number, at most 1; 1 also for residuals of less than a tenth of the noise
    /// given. Below [`REFUSAL`] the fit is a misfit.
    pub misfit_p: f64,
}

/// The residuals that are tested.
pub(crate) struct Residuals<'a> {
    /// Whitened residuals of each curve.
    pub series: Vec<&'a [f64]>,
    /// `χ²`, priors included.
    pub chi_squared: f64,
    pub points: usize,
    pub degrees: f64,
    /// Whether the noise is fully known.
    pub known: bool,
}

/// The probabilities of the tests that need more than the residuals; see [`Goodness`].
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct OtherTests {
    pub lower_half: Option<f64>,
    pub smooth: Option<f64>,
    pub persistence: Option<f64>,
    pub common: Option<f64>,
}

impl Residuals<'_> {
    /// Judges the residuals, with the probabilities of the other tests.
    pub fn judge(&self, others: &OtherTests) -> Goodness {
        let OtherTests {
            lower_half: lower_half_p,
            smooth: smooth_p,
            persistence: persistence_p,
            common: common_p,
        } = *others;
        let chi_squared = self.chi_squared;
        let chi_squared_p = self
            .known
            .then(|| chi_squared_above(chi_squared, self.degrees))
            .filter(|_| self.degrees > 0.0);
        let runs_p = runs(&self.series);
        let (durbin_watson, durbin_watson_p) = durbin_watson(&self.series);
        let all: Vec<f64> = [
            chi_squared_p,
            Some(runs_p),
            Some(durbin_watson_p),
            lower_half_p,
            persistence_p,
            smooth_p,
            common_p,
        ]
        .into_iter()
        .flatten()
        .collect();
        // Without degrees of freedom the model follows any data.
        let is_negligible = chi_squared < NEGLIGIBLE * self.degrees || self.degrees <= 0.0;
        let worst = all.iter().copied().fold(1.0, f64::min);
        Goodness {
            points: self.points,
            degrees_of_freedom: self.degrees,
            chi_squared_per_degree: if self.degrees > 0.0 {
                chi_squared / self.degrees
            } else {
                0.0
            },
            chi_squared_p,
            runs_p,
            durbin_watson,
            durbin_watson_p,
            lower_half_p,
            persistence_p,
            smooth_p,
            common_p,
            misfit_p: if is_negligible {
                1.0
            } else {
                (worst * all.len() as f64).min(1.0)
            },
        }
    }
}

/// The probability of as few runs, over all series. With `n₊` and `n₋` signs in one series, the number of runs has mean
/// `1 + 2n₊n₋/n` and variance `2n₊n₋(2n₊n₋ − n)/(n²(n − 1))` (A. Wald and J. Wolfowitz, Ann. Math. Stat. 11, 147
/// (1940)). It is taken as normal, with the continuity correction.
fn runs(series: &[&[f64]]) -> f64 {
    let (mut found, mut mean, mut variance) = (0.0, 0.0, 0.0);
    for residuals in series.iter().filter(|r| r.len() > 1) {
        let n = residuals.len() as f64;
        let positive = residuals.iter().filter(|&&r| r > 0.0).count() as f64;
        let pairs = 2.0 * positive * (n - positive);
        let changes = residuals
            .windows(2)
            .filter(|w| (w[0] > 0.0) != (w[1] > 0.0))
            .count();
        found += 1.0 + changes as f64;
        mean += 1.0 + pairs / n;
        variance += pairs * (pairs - n) / (n * n * (n - 1.0));
    }
    if variance <= 0.0 {
        return 1.0;
    }
    normal_below((found + 0.5 - mean) / variance.sqrt())
}

/// `d` and the probability of a smaller one: J. Durbin and G. S. Watson, Biometrika 37, 409 (1950). Without
/// correlation `d` has mean 2, slightly more after a fit, and variance `4/n`, slightly less.
fn durbin_watson(series: &[&[f64]]) -> (f64, f64) {
    let (mut differences, mut squares, mut points) = (0.0, 0.0, 0.0);
    for residuals in series {
        differences += residuals
            .windows(2)
            .map(|w| (w[1] - w[0]).powi(2))
            .sum::<f64>();
        // The first and last points count half in the differences, so that d is 2 for short series too.
        let ends =
            residuals.first().map_or(0.0, |r| r * r) + residuals.last().map_or(0.0, |r| r * r);
        differences += ends;
        squares += dot(residuals, residuals);
        points += residuals.len() as f64;
    }
    if squares <= 0.0 {
        return (2.0, 1.0);
    }
    let d = differences / squares;
    (d, normal_below((d - 2.0) * points.sqrt() / 2.0))
}

/// The score of a difference between the unknowns of the lower half of the abscissae and of all, and its degrees of
/// freedom.
///
/// This is the score test of a second set of unknowns for the upper half, which needs no second fit. With `Z` the
/// derivatives at the upper half alone, projected off the nuisances and unknowns, `S = rᵀZ(ZᵀZ)⁻¹Zᵀr` is χ² (C. R. Rao,
/// Proc. Camb. Phil. Soc. 44, 50 (1948)).
pub(crate) fn lower_half_score(
    problem: &Problem,
    metric: &Metric,
    at: &Evaluation,
    determined: &[usize],
) -> [f64; 2] {
    let upper = upper_half(&problem.abscissa());
    let columns = determined.iter().map(|&j| {
        let halves = at.jacobian[j].iter().zip(&upper);
        halves
            .map(|(derivative, &up)| if up { *derivative } else { 0.0 })
            .collect()
    });
    score(metric, at, determined, columns)
}

/// The score of a smooth part of the residuals, and its degrees of freedom: the model's curve times Chebyshev
/// polynomials in `ln` of the abscissa, of all degrees up to the fourth (J. Neyman, Skand. Aktuarietidskr. 20, 149
/// (1937), in the form of Rao's test).
pub(crate) fn smooth_score(
    problem: &Problem,
    metric: &Metric,
    at: &Evaluation,
    determined: &[usize],
) -> [f64; 2] {
    let abscissa = problem.abscissa();
    let range = range(abscissa.iter().copied());
    let columns = smooth_columns(&abscissa, &at.value, range, HIGHEST_DEGREE).into_iter();
    score(metric, at, determined, columns)
}

/// `S = rᵀZ(ZᵀZ)⁻¹Zᵀr` for columns `Z` over the points, projected off the nuisances and unknowns, and its degrees of
/// freedom.
pub(crate) fn score(
    metric: &Metric,
    at: &Evaluation,
    determined: &[usize],
    columns: impl Iterator<Item = Vec<f64>>,
) -> [f64; 2] {
    let system = metric.system(at);
    let fitted = OrthonormalBasis::of(determined.iter().map(|&j| system.jacobian[j].clone()));
    let mut residual = system.residual;
    fitted.remove_from(&mut residual);
    let mut added = fitted.clone();
    for column in columns {
        added.push(metric.reduce(column));
    }
    let before = dot(&residual, &residual);
    added.remove_from(&mut residual);
    let rank = added.rank() - fitted.rank();
    [before - dot(&residual, &residual), rank as f64]
}

/// How the noise level that scales a score is known.
#[derive(Debug, Clone, Copy)]
pub(crate) enum NoiseScale {
    /// Exactly.
    Known,
    /// Estimated with these degrees of freedom from residuals of this χ², which contain the score.
    OfResiduals { degrees: f64, chi_squared: f64 },
    /// Estimated with these degrees of freedom, together with a correlation that absorbs part of a misfit.
    OfCorrelated(f64),
}

impl NoiseScale {
    /// The scale of a problem's noise, whose size is known with these degrees of freedom; the residuals themselves
    /// have the χ² and the degrees of `residuals`. Of noise that is known in part, the size of the rest may be known
    /// far less well than that of both.
    pub fn of(problem: &Problem, degrees: f64, residuals: [f64; 2]) -> Self {
        let [chi_squared, of_residuals] = residuals;
        let noise = problem.noise();
        if noise.is_known() {
            Self::Known
        } else if noise.correlation == Correlation::Estimated {
            Self::OfCorrelated(degrees)
        } else if degrees < of_residuals {
            Self::OfResiduals {
                degrees: of_residuals,
                chi_squared,
            }
        } else {
            Self::OfResiduals {
                degrees,
                chi_squared: degrees,
            }
        }
    }

    /// The probability of a score `S` of `q` columns as large as this; `None` for no columns. If the `ν` degrees of
    /// freedom contain the score, `(S/q)/((χ² − S)/(ν − q))` is Fisher's F; otherwise `S/q` is.
    pub fn probability(self, [score, q]: [f64; 2]) -> Option<f64> {
        (q > 0.0).then(|| match self {
            Self::Known => chi_squared_above(score, q),
            Self::OfCorrelated(degrees) => fisher_above(score / q, q, degrees),
            // What is estimated is nothing beside what is given.
            Self::OfResiduals { degrees, .. } if degrees.is_infinite() => {
                chi_squared_above(score, q)
            }
            Self::OfResiduals { degrees, .. } if degrees <= q => 1.0,
            Self::OfResiduals { chi_squared, .. } if chi_squared <= score => 0.0,
            Self::OfResiduals {
                degrees,
                chi_squared,
            } => {
                let rest = (chi_squared - score) / (degrees - q);
                fisher_above(score / q / rest, q, degrees - q)
            }
        })
    }
}

/// Whether each point lies above the median of the abscissae.
fn upper_half(abscissa: &[f64]) -> Vec<bool> {
    let mut sorted = abscissa.to_vec();
    sorted.sort_by(f64::total_cmp);
    let median = sorted
        .get(sorted.len() / 2)
        .copied()
        .unwrap_or(f64::INFINITY);
    abscissa.iter().map(|q| *q >= median).collect()
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn the_runs_of_a_known_series_have_the_known_probability() {
        // + + + + + − − − − −: 2 runs, mean 6, variance 50·40/(100·9) = 20/9; Φ((2.5 − 6)/1.4907) = 0.00944.
        let residuals = [1.0, 1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0, -1.0];
        // To the digits written above.
        assert_relative_eq!(runs(&[&residuals]), 0.00944, max_relative = 2e-3);
    }

    #[test]
    fn durbin_watson_detects_a_drift_and_passes_an_alternating_series() {
        let drift: Vec<f64> = (0..100).map(|i| f64::from(i) - 49.5).collect();
        let (d, p) = durbin_watson(&[&drift]);
        assert!(d < 0.1 && p < 1e-15, "d = {d}, p = {p}");
        let alternating: Vec<f64> = (0..100)
            .map(|i| if i % 2 == 0 { 1.0 } else { -1.0 })
            .collect();
        let (d, p) = durbin_watson(&[&alternating]);
        assert!(d > 3.9 && p > 0.999, "d = {d}, p = {p}");
    }
}
