//! Convergence diagnostics of the samples.

use hammer_and_sample::auto_corr_time;

use super::{Ensemble, WALKERS};

/// Ensembles agree if `R̂` of every unknown is below this. (A. Vehtari et al., Bayesian Anal. 16, 667 (2021), require
/// 1.01 for single chains; the mean of few ensembles of few walkers adds a scatter of the same order.)
const AGREEMENT: f64 = 1.03;

/// Convergence diagnostics of the walkers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Convergence {
    /// Fraction of the steps that were accepted.
    pub acceptance: f64,
    /// Integrated autocorrelation time of the mean of an ensemble, in steps, for the slowest unknown; `None` if the run
    /// is shorter than twenty of them, too short for an estimate.
    pub autocorrelation_time: Option<f64>,
    /// Split `R̂` of the unknown that agrees worst: the spread between all halves of all ensembles, relative to that
    /// within them.
    pub r_hat: f64,
}

impl Convergence {
    /// Whether the samples can be used.
    #[must_use]
    pub fn is_converged(&self) -> bool {
        self.autocorrelation_time.is_some() && self.r_hat < AGREEMENT
    }

    pub(super) fn of(ensembles: &[Ensemble]) -> Self {
        let unknowns = ensembles[0].chain[0].len();
        let times = ensembles
            .iter()
            .flat_map(|one| (0..unknowns).map(|j| time(one, j)));
        let times: Option<Vec<f64>> = times.collect();
        let acceptance = ensembles.iter().map(|one| one.acceptance).sum::<f64>();
        Self {
            acceptance: acceptance / ensembles.len() as f64,
            autocorrelation_time: times.map(|all| all.into_iter().fold(0.0, f64::max)),
            r_hat: (0..unknowns)
                .map(|j| r_hat(ensembles, j))
                .fold(0.0, f64::max),
        }
    }
}

/// The autocorrelation time of the mean of all walkers.
fn time(ensemble: &Ensemble, unknown: usize) -> Option<f64> {
    let steps = ensemble.chain.chunks(WALKERS);
    let mean = |step: &[Vec<f64>]| step.iter().map(|x| x[unknown]).sum::<f64>() / WALKERS as f64;
    let means: Vec<f64> = steps.map(mean).collect();
    auto_corr_time(means.iter().copied(), None, Some(20))
}

/// `R̂ = √(1 + B/W)`, `B` the variance of the means of all half chains, `W` the mean of their variances.
fn r_hat(ensembles: &[Ensemble], unknown: usize) -> f64 {
    let halves = ensembles.iter().flat_map(|one| {
        let steps = one.chain.len() / WALKERS;
        one.chain.chunks((steps / 2) * WALKERS).take(2)
    });
    let pairs = halves.map(|half| {
        let values: Vec<f64> = half.iter().map(|x| x[unknown]).collect();
        moments(&values)
    });
    let (means, variances): (Vec<f64>, Vec<f64>) = pairs.unzip();
    let within = variances.iter().sum::<f64>() / variances.len() as f64;
    (1.0 + moments(&means).1 / within).sqrt()
}

/// Mean and variance.
fn moments(values: &[f64]) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
    (mean, squares / (count - 1.0))
}
