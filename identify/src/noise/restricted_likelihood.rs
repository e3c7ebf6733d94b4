//! The sizes and the correlation of the noise, estimated from the residuals.
//!
//! They maximise the restricted likelihood of the residuals, which accounts for the part that the fit has absorbed:
//! `−2 ℓ_R = ln det V + ln det XᵀV⁻¹X + rᵀ P r`. `X` holds the derivatives with respect to all unknowns and nuisances,
//! and `rᵀ P r` is the part of the residual that no combination of them explains: H. D. Patterson and R. Thompson,
//! Biometrika 58, 545 (1971). No prediction is needed: the residuals of the present point serve for every trial. The
//! degrees of freedom of an interval follow from Satterthwaite's rule, `ν = 2 C²/Var(C)`, with `Var(C)` from the
//! curvature of `ℓ_R`: F. G. Giesbrecht and J. C. Burns, Biometrics 41, 477 (1985). Where a correlation is estimated,
//! `ln C` is normal instead. A part of the noise that is estimated as nothing beside the others adds nothing to
//! `Var(C)` and costs no degree of freedom; if nothing else is estimated, `ν` is infinite.

use faer::{Mat, Side};

use super::{Amount, Correlation, Noise, NoiseLevels, simplex};
use crate::{
    IdentifyError, Problem,
    distribution::{chi_squared_above, lognormal_degrees},
    metric::Metric,
    orthonormal_basis::{OrthonormalBasis, dot},
    predictor::Evaluation,
};

/// Logits of the correlation stay between these, so that the persistence stays between 0.0009 and 0.9991.
const LOGIT_LIMIT: f64 = 7.0;
/// An estimated size is not sought below this fraction of its initial value.
const LEAST_SIZE: f64 = 1e-6;
/// Step for differencing the likelihood in logarithms and logits: long enough for the rounding of `ℓ_R` to be
/// negligible, and short compared with a standard error, which is at least about 0.05 with 300 points.
const DIFFERENCE: f64 = 0.05;
/// Curvatures of `−2 ℓ_R` below this carry no information: they mean a standard error above six in a logarithm.
const FLAT: f64 = 0.05;

/// A correlation estimated from many points leaves at least this many degrees of freedom: Student's quantile is then
/// 2.94, one and a half times the normal one. Where the likelihood is flat, `Var(ln C)` from its curvature exaggerates
/// without limit; of measurements of 60 points with a correlation of 0.85, 95 % of the quotients were below 2.7.
const LEAST_DEGREES: f64 = 3.5;
/// The same for few points: at least one for each eight of them.
const POINTS_PER_DEGREE: f64 = 8.0;

/// A curve is at least this many correlation lengths of its noise long; a longer correlation counts as a misfit.
const LEAST_CORRELATION_LENGTHS: f64 = 10.0;

/// One problem with its residuals, from which the noise is estimated.
#[derive(Clone)]
pub(crate) struct Part<'a> {
    pub problem: &'a Problem,
    pub at: &'a Evaluation,
    /// Unknowns that count as fitted; those that are not identifiable are left out.
    pub free: &'a [usize],
    /// Further columns over the points that count as fitted.
    pub departures: &'a [Vec<f64>],
}

/// The restricted likelihood as a function of the estimated numbers of the noise, for one problem or several with the
/// same noise.
pub(crate) struct RestrictedLikelihood<'a> {
    parts: Vec<Part<'a>>,
    base: NoiseLevels,
    noise: Noise,
    /// Upper limit of the persistence.
    most_persistence: f64,
}

impl<'a> RestrictedLikelihood<'a> {
    pub fn new(parts: Vec<Part<'a>>, noise: Noise, base: NoiseLevels) -> Self {
        Self {
            parts,
            base,
            noise,
            most_persistence: 1.0,
        }
    }

    /// The levels of maximum likelihood.
    pub fn estimate(&self) -> NoiseLevels {
        let mut start = self.encode(&self.base);
        if start.is_empty() {
            return self.base;
        }
        if self.noise.correlation == Correlation::Estimated && self.base.persistence == 0.0 {
            let middle = start.len() - 2;
            start[middle..].fill(0.0);
        }
        self.decode(&simplex::least(&start, 0.5, |p| self.deviance(p)))
    }

    /// The probability that noise with a correlation length of at most a tenth of its curve looks as persistent as
    /// this; `None` if the correlation is not estimated.
    ///
    /// Noise correlated over longer distances cannot be distinguished from a misfit of the model, which an
    /// autoregression absorbs as readily as noise. Twice the logarithm of the likelihood ratio between the best
    /// persistence and the best one below `e^(−10/n)` is zero or χ² with equal probability, since the limit is
    /// one-sided (H. Chernoff, Ann. Math. Stat. 25, 573 (1954)).
    pub fn persistence_p(&self) -> Option<f64> {
        if self.noise.correlation != Correlation::Estimated {
            return None;
        }
        let longest = self
            .parts
            .iter()
            .map(|part| part.problem.points_of_longest())
            .max()?;
        let limit = (-LEAST_CORRELATION_LENGTHS / longest as f64).exp();
        if self.base.persistence <= limit {
            return Some(1.0);
        }
        let limited = Self {
            parts: self.parts.clone(),
            base: NoiseLevels {
                persistence: limit,
                ..self.base
            },
            most_persistence: limit,
            ..*self
        };
        let best = limited.estimate();
        let excess =
            limited.deviance(&limited.encode(&best)) - self.deviance(&self.encode(&self.base));
        Some(0.5 * chi_squared_above(excess.max(0.0), 1.0))
    }

    /// Degrees of freedom of the variance `C_jj` of each free unknown.
    pub fn degrees_of_freedom(&self) -> Result<Vec<f64>, IdentifyError> {
        let best = self.encode(&self.base);
        let variance = self.variances(&best);
        let curvature = self.curvature(&best);
        let shifted = |axis: usize, step: f64| {
            let mut p = best.clone();
            p[axis] += step;
            self.variances(&p)
        };
        let gradients: Vec<Vec<f64>> = (0..best.len())
            .map(|axis| {
                let (up, down) = (shifted(axis, DIFFERENCE), shifted(axis, -DIFFERENCE));
                up.iter()
                    .zip(&down)
                    .map(|(u, d)| (u - d) / (2.0 * DIFFERENCE))
                    .collect()
            })
            .collect();
        let eigen = curvature
            .self_adjoint_eigen(Side::Lower)
            .map_err(|_| IdentifyError::Decomposition { size: best.len() })?;
        Ok((0..variance.len())
            .map(|j| {
                // Var(C) = gᵀ A g,  A = 2 H⁻¹ with H the curvature of −2 ℓ_R.
                let spread: f64 = (0..best.len())
                    .filter(|&k| eigen.S()[k] > FLAT)
                    .map(|k| {
                        let along: f64 = (0..best.len())
                            .map(|i| eigen.U()[(i, k)] * gradients[i][j])
                            .sum();
                        2.0 * along * along / eigen.S()[k]
                    })
                    .sum();
                if self.noise.correlation == Correlation::Estimated {
                    let found = lognormal_degrees(spread / (variance[j] * variance[j]));
                    return found.max(self.least_degrees());
                }
                satterthwaite(variance[j], spread)
            })
            .collect())
    }

    /// The fewest degrees of freedom that an estimated correlation leaves.
    fn least_degrees(&self) -> f64 {
        let points: usize = self.parts.iter().map(|part| part.problem.points()).sum();
        LEAST_DEGREES.min(points as f64 / POINTS_PER_DEGREE)
    }

    /// `−2 ℓ_R` without its constant.
    fn deviance(&self, parameters: &[f64]) -> f64 {
        let levels = self.decode(parameters);
        self.parts.iter().map(|part| part.deviance(&levels)).sum()
    }

    /// `C_jj` of each free unknown of the first problem.
    fn variances(&self, parameters: &[f64]) -> Vec<f64> {
        let levels = self.decode(parameters);
        self.parts
            .first()
            .map_or_else(Vec::new, |part| part.variances(&levels))
    }

    /// The curvature of the deviance, from second differences.
    fn curvature(&self, best: &[f64]) -> Mat<f64> {
        let size = best.len();
        let shifted = |i: usize, si: f64, k: usize, sk: f64| {
            let mut p = best.to_vec();
            p[i] += si * DIFFERENCE;
            p[k] += sk * DIFFERENCE;
            self.deviance(&p)
        };
        let mut curvature = Mat::zeros(size, size);
        for i in 0..size {
            for k in 0..=i {
                let mixed =
                    shifted(i, 1.0, k, 1.0) - shifted(i, 1.0, k, -1.0) - shifted(i, -1.0, k, 1.0)
                        + shifted(i, -1.0, k, -1.0);
                curvature[(i, k)] = mixed / (4.0 * DIFFERENCE * DIFFERENCE);
                curvature[(k, i)] = curvature[(i, k)];
            }
        }
        curvature
    }

    /// Logarithms of the estimated sizes, then logits of the estimated correlation.
    fn encode(&self, levels: &NoiseLevels) -> Vec<f64> {
        let noise = self.noise;
        let mut parameters: Vec<f64> = [
            (noise.observed, levels.observed),
            (noise.abscissa, levels.abscissa),
            (noise.relative, levels.relative),
        ]
        .iter()
        .filter(|(amount, _)| *amount == Amount::Estimated)
        .map(|(_, level)| level.ln())
        .collect();
        if noise.correlation == Correlation::Estimated {
            parameters.push(logit(levels.persistence));
            parameters.push(logit(levels.white_fraction));
        }
        parameters
    }

    fn decode(&self, parameters: &[f64]) -> NoiseLevels {
        let noise = self.noise;
        let mut rest = parameters.iter();
        let mut size = |amount, base: f64| match (amount, rest.as_slice().first()) {
            (Amount::Estimated, Some(logarithm)) => {
                rest.next();
                logarithm.exp().max(LEAST_SIZE * base)
            }
            _ => base,
        };
        let mut levels = NoiseLevels {
            observed: size(noise.observed, self.base.observed),
            abscissa: size(noise.abscissa, self.base.abscissa),
            relative: size(noise.relative, self.base.relative),
            ..self.base
        };
        if let [persistence, white] = rest.as_slice() {
            levels.persistence = logistic(*persistence).min(self.most_persistence);
            levels.white_fraction = logistic(*white);
        }
        levels
    }
}

impl<'a> Part<'a> {
    fn deviance(&self, levels: &NoiseLevels) -> f64 {
        let metric = self.metric(levels);
        let (mut residual, jacobian) = metric.rows(self.at);
        let mut columns = metric.nuisance_columns();
        columns.extend(self.free.iter().map(|&j| jacobian[j].clone()));
        columns.extend(
            self.departures
                .iter()
                .map(|column| metric.reduce(column.clone())),
        );
        let absorbed = OrthonormalBasis::of(columns);
        absorbed.remove_from(&mut residual);
        metric.log_determinant() + absorbed.log_determinant() + dot(&residual, &residual)
    }

    fn variances(&self, levels: &NoiseLevels) -> Vec<f64> {
        let system = self.metric(levels).system(self.at);
        let inverse = OrthonormalBasis::of(self.free.iter().map(|&j| system.jacobian[j].clone()))
            .inverse_gram();
        (0..self.free.len()).map(|j| inverse[j][j]).collect()
    }

    fn metric(&self, levels: &NoiseLevels) -> Metric<'a> {
        Metric::at(self.problem, levels, self.at)
    }
}

/// `ν = 2 C²/Var(C)`, at least one; infinite for a variance that does not depend on the estimated noise. The sum of no
/// terms is −0, which must not become a sign.
fn satterthwaite(variance: f64, spread: f64) -> f64 {
    if spread > 0.0 {
        (2.0 * variance * variance / spread).max(1.0)
    } else {
        f64::INFINITY
    }
}

fn logistic(x: f64) -> f64 {
    1.0 / (1.0 + (-x.clamp(-LOGIT_LIMIT, LOGIT_LIMIT)).exp())
}

fn logit(p: f64) -> f64 {
    (p / (1.0 - p)).ln().clamp(-LOGIT_LIMIT, LOGIT_LIMIT)
}
