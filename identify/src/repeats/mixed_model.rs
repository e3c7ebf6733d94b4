//! Common parameters of repeated curves, and the scatter of the individual curves about them.
//!
//! Linearised about its own point, curve `i` determines the common corrections β and its own `u_i ~ N(0, T)`, `T`
//! diagonal, through `A_i = J_iᵀJ_i` and `b_i = J_iᵀ r_i` alone. With the `u_i` integrated out,
//! `A_i ← A_i − A_i Z (T⁻¹ + ZᵀA_iZ)⁻¹ Zᵀ A_i`, and likewise `b_i`; `Z` selects the columns that scatter. The
//! deviations in `T` maximise the restricted likelihood: N. M. Laird and J. H. Ware, Biometrics 38, 963 (1982). If
//! every curve alone determines the parameter, this is the random-effects mean of repeats.

use faer::{
    Mat, Side,
    linalg::solvers::{Llt, Solve as _},
};

use crate::{IdentifyError, noise::simplex};

/// Scatter below this, in a logarithm, counts as zero; above [`MOST_SCATTER`] a linearisation cannot describe it.
const LEAST_SCATTER: f64 = 1e-6;
const MOST_SCATTER: f64 = 3.0;
/// First guess of the scatter if the curves alone do not show it.
const FIRST_SCATTER: f64 = 0.05;

/// One curve's normal equations for the common columns.
#[derive(Debug, Clone)]
pub(super) struct CurveEquations {
    /// `A = JᵀJ`.
    pub gram: Mat<f64>,
    /// `b = Jᵀ r`.
    pub pull: Mat<f64>,
}

/// The curves and the priors.
pub(super) struct MixedModel {
    pub curves: Vec<CurveEquations>,
    /// Prior precision of each column, and that precision times the distance of the prior's centre above the point.
    pub prior: Vec<[f64; 2]>,
    /// The columns that scatter.
    pub scattered: Vec<usize>,
}

/// Corrections of the common columns.
pub(super) struct Common {
    pub correction: Vec<f64>,
    /// Their covariance.
    pub covariance: Mat<f64>,
    /// Standard deviation between curves of each scattered column.
    pub scatter: Vec<f64>,
}

impl MixedModel {
    /// The common corrections at the most likely scatter.
    pub fn solve(&self, guess: &[f64]) -> Result<Common, IdentifyError> {
        let start: Vec<f64> = guess
            .iter()
            .map(|g| {
                if g.is_finite() && *g > LEAST_SCATTER {
                    *g
                } else {
                    FIRST_SCATTER
                }
            })
            .map(f64::ln)
            .collect();
        let best = simplex::least(&start, 1.0, |logarithms| {
            self.deviance(&deviations(logarithms))
                .unwrap_or(f64::INFINITY)
        });
        let scatter = deviations(&best);
        let (precision, pull, _) = self.marginal(&scatter)?;
        let factor = precision
            .llt(Side::Lower)
            .map_err(|_| self.undecomposed())?;
        let correction = factor.solve(&pull);
        Ok(Common {
            correction: (0..self.prior.len()).map(|k| correction[(k, 0)]).collect(),
            covariance: factor.solve(Mat::<f64>::identity(self.prior.len(), self.prior.len())),
            scatter: scatter
                .into_iter()
                .map(|s| if s > 2.0 * LEAST_SCATTER { s } else { 0.0 })
                .collect(),
        })
    }

    /// What each curve has beside the corrected common values, most likely: `u_i = T Zᵀ(b_i − A_i β − A_i Z u_i)`.
    pub fn own(&self, common: &Common) -> Result<Vec<Vec<f64>>, IdentifyError> {
        let (z, scatter) = (&self.scattered, &common.scatter);
        let correction = Mat::from_fn(self.prior.len(), 1, |k, _| common.correction[k]);
        let of_curve = |curve: &CurveEquations| {
            let rest = &curve.pull - &curve.gram * &correction;
            let along = Mat::from_fn(z.len(), 1, |i, _| scatter[i] * rest[(z[i], 0)]);
            let solved = self.inner(curve, scatter)?.solve(&along);
            Ok((0..z.len()).map(|i| scatter[i] * solved[(i, 0)]).collect())
        };
        self.curves.iter().map(of_curve).collect()
    }

    /// `1 + S ZᵀAZ S`, with `S = √T`.
    fn inner(&self, curve: &CurveEquations, scatter: &[f64]) -> Result<Llt<f64>, IdentifyError> {
        let z = &self.scattered;
        let inner = Mat::from_fn(z.len(), z.len(), |i, k| {
            let one = if i == k { 1.0 } else { 0.0 };
            one + scatter[i] * curve.gram[(z[i], z[k])] * scatter[k]
        });
        inner.llt(Side::Lower).map_err(|_| self.undecomposed())
    }

    /// The variance of a column with all other columns with a prior held: the part that is limited by the number of
    /// curves.
    pub fn variance_from_curves(
        &self,
        column: usize,
        scatter: &[f64],
    ) -> Result<f64, IdentifyError> {
        let (precision, _, _) = self.marginal(scatter)?;
        let free: Vec<usize> = (0..self.prior.len())
            .filter(|&k| k == column || self.prior[k][0] == 0.0)
            .collect();
        let part = Mat::from_fn(free.len(), free.len(), |i, k| precision[(free[i], free[k])]);
        let factor = part.llt(Side::Lower).map_err(|_| self.undecomposed())?;
        let inverse = factor.solve(Mat::<f64>::identity(free.len(), free.len()));
        let place = free.iter().position(|&k| k == column).unwrap_or(0);
        Ok(inverse[(place, place)])
    }

    /// `−2 ℓ_R` without its constant.
    fn deviance(&self, scatter: &[f64]) -> Result<f64, IdentifyError> {
        let (precision, pull, rest) = self.marginal(scatter)?;
        let factor = precision
            .llt(Side::Lower)
            .map_err(|_| self.undecomposed())?;
        let correction = factor.solve(&pull);
        let gain: f64 = (0..pull.nrows())
            .map(|k| correction[(k, 0)] * pull[(k, 0)])
            .sum();
        let lower = factor.L();
        let determinant: f64 = (0..pull.nrows()).map(|k| 2.0 * lower[(k, k)].ln()).sum();
        Ok(rest + determinant - gain)
    }

    /// Precision and right-hand side of the common columns with the curves' own parts integrated out, and the part of
    /// `−2 ℓ_R` that does not depend on the corrections.
    fn marginal(&self, scatter: &[f64]) -> Result<(Mat<f64>, Mat<f64>, f64), IdentifyError> {
        let (size, own) = (self.prior.len(), scatter.len());
        let mut precision = Mat::from_fn(
            size,
            size,
            |i, k| if i == k { self.prior[i][0] } else { 0.0 },
        );
        let mut pull = Mat::from_fn(size, 1, |i, _| self.prior[i][1]);
        let mut rest = 0.0;
        for curve in &self.curves {
            // (T⁻¹ + ZᵀAZ)⁻¹ = S (1 + S ZᵀAZ S)⁻¹ S, which needs no T⁻¹.
            let z = &self.scattered;
            let factor = self.inner(curve, scatter)?;
            let across = Mat::from_fn(own, size, |i, k| scatter[i] * curve.gram[(z[i], k)]);
            let along = Mat::from_fn(own, 1, |i, _| scatter[i] * curve.pull[(z[i], 0)]);
            let (solved, solved_along) = (factor.solve(&across), factor.solve(&along));
            precision += &curve.gram - across.transpose() * &solved;
            pull += &curve.pull - across.transpose() * &solved_along;
            rest -= (along.transpose() * &solved_along)[(0, 0)];
            rest += (0..own).map(|k| 2.0 * factor.L()[(k, k)].ln()).sum::<f64>();
        }
        Ok((precision, pull, rest))
    }

    fn undecomposed(&self) -> IdentifyError {
        IdentifyError::Decomposition {
            size: self.prior.len(),
        }
    }
}

fn deviations(logarithms: &[f64]) -> Vec<f64> {
    logarithms
        .iter()
        .map(|l| l.exp().clamp(LEAST_SCATTER, MOST_SCATTER))
        .collect()
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// A model of one column, with each curve an estimate of this variance.
    fn estimates(values: &[f64], variance: f64) -> MixedModel {
        MixedModel {
            curves: values
                .iter()
                .map(|value| CurveEquations {
                    gram: Mat::from_fn(1, 1, |_, _| 1.0 / variance),
                    pull: Mat::from_fn(1, 1, |_, _| value / variance),
                })
                .collect(),
            prior: vec![[0.0, 0.0]],
            scattered: vec![0],
        }
    }

    #[test]
    fn estimates_of_equal_variance_give_the_sample_mean_and_variance() {
        let values = [0.31, -0.12, 0.05, 0.22, -0.27];
        let (n, v) = (5.0, 1e-4);
        let mean = values.iter().sum::<f64>() / n;
        let sample = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0);
        let common = estimates(&values, v).solve(&[0.1]).unwrap();
        assert_relative_eq!(common.correction[0], mean, max_relative = 1e-9);
        // The simplex search ends within 1e-4 of the logarithm of the scatter.
        assert_relative_eq!(common.scatter[0], (sample - v).sqrt(), max_relative = 2e-4);
        assert_relative_eq!(common.covariance[(0, 0)], sample / n, max_relative = 5e-4);
    }

    #[test]
    fn estimates_that_agree_better_than_their_variance_have_no_scatter() {
        let common = estimates(&[0.01, -0.01, 0.005, -0.004], 1.0)
            .solve(&[f64::NAN])
            .unwrap();
        assert_eq!(common.scatter[0], 0.0);
        // Four estimates of variance one.
        assert_relative_eq!(common.covariance[(0, 0)], 0.25, max_relative = 1e-6);
    }

    #[test]
    fn a_prior_is_one_more_observation_of_the_mean() {
        let mut model = estimates(&[1.0, 1.0, 1.0, 1.0], 1.0);
        model.prior = vec![[4.0, 4.0 * 2.0]];
        let common = model.solve(&[0.1]).unwrap();
        // Four observations of 1, and a prior at 2 of the same precision.
        assert_relative_eq!(common.correction[0], 1.5, max_relative = 1e-6);
    }
}
