//! Samples of the posterior of the unknowns.
//!
//! The density uses the fit's own noise, with the linear nuisances integrated out. It is a density over the coordinates
//! of the unknowns; without a prior an unknown has a flat one in its coordinate. An ensemble of walkers samples it
//! (J. Goodman and J. Weare, Comm. App. Math. Comp. Sci. 5, 65 (2010)) on a [`Surrogate`]. Convergence is judged from
//! four independent ensembles. Each walker has its own random numbers, so no sample depends on the number of threads.

mod convergence;
mod density;

use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

pub use convergence::Convergence;
use density::Density;

use crate::{Fit, IdentifyError, Problem, Surrogate};

/// Number of ensembles, each with its own seed.
const ENSEMBLES: usize = 4;

/// Walkers per ensemble: at least twice the number of unknowns, which is at most four.
const WALKERS: usize = 16;

/// Steps discarded at the start, ten autocorrelation times.
const BURN_IN: usize = 400;

/// One step in this many is kept, or in more if few samples are wanted.
const THINNING: usize = 16;

/// Minimum number of steps after the burn-in, about 25 autocorrelation times, so that convergence can be judged.
const FEWEST_STEPS: usize = 1000;

/// A sample this close to a face of the surrogate's box, in half sides, counts as being at the face.
const AT_FACE: f64 = 0.02;

/// Options for sampling a posterior.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PosteriorOptions {
    /// Samples wanted, 4000 by default. The number is rounded up to whole steps of all walkers.
    pub samples: usize,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Default for PosteriorOptions {
    fn default() -> Self {
        Self {
            samples: 4000,
            seed: 1,
        }
    }
}

/// Samples of a posterior.
#[derive(Debug, Clone, PartialEq)]
pub struct Posterior {
    /// One list of values of the unknowns, in their units, for each sample.
    pub samples: Vec<Vec<f64>>,
    /// The convergence of the walkers.
    pub convergence: Convergence,
    /// Fraction of the samples at a face of the surrogate's box that is not a bound of the unknown: the tail beyond it
    /// is missing.
    pub cut_off: f64,
}

impl Posterior {
    /// The value below which an unknown, by its index, lies with this probability.
    ///
    /// # Panics
    ///
    /// If there is no such unknown.
    #[must_use]
    pub fn quantile(&self, unknown: usize, probability: f64) -> f64 {
        let mut values: Vec<f64> = self.samples.iter().map(|one| one[unknown]).collect();
        values.sort_by(f64::total_cmp);
        let intervals = (values.len() - 1) as f64;
        // The first index k with k/(n − 1) not below the probability, and the one before.
        let below = |k: usize| (k as f64) < probability * intervals;
        let above = (0..values.len() - 1).take_while(|k| below(*k)).count();
        let before = above.saturating_sub(1);
        let part = (probability * intervals - before as f64).clamp(0.0, 1.0);
        values[before] + part * (values[above] - values[before])
    }
}

/// Samples the posterior of a problem around its best fit, using only a surrogate of the model.
///
/// # Errors
///
/// [`IdentifyError::Number`] for zero samples, [`IdentifyError::Length`] for a surrogate of another problem.
pub fn posterior(
    surrogate: &Surrogate,
    problem: &Problem,
    fit: &Fit,
    options: PosteriorOptions,
) -> Result<Posterior, IdentifyError> {
    if options.samples == 0 {
        return Err(IdentifyError::Number {
            quantity: "number of samples",
            found: 0.0,
            wanted: "at least one",
        });
    }
    let density = Density::new(surrogate, problem, fit)?;
    let kept = options.samples.div_ceil(ENSEMBLES * WALKERS);
    let thinning = THINNING.max(FEWEST_STEPS.div_ceil(kept));
    let seeds = (0..ENSEMBLES).into_par_iter();
    let ensembles: Vec<Ensemble> = seeds
        .map(|index| Ensemble::run(&density, fit, options.seed, index, kept * thinning))
        .collect();
    let convergence = Convergence::of(&ensembles);
    let positions = ensembles.iter().flat_map(|one| one.chain.chunks(WALKERS));
    // The last of each thinned run of steps.
    let positions = positions.skip(thinning - 1).step_by(thinning).flatten();
    let positions: Vec<&Vec<f64>> = positions.collect();
    Ok(Posterior {
        samples: positions.iter().map(|x| density.values(x)).collect(),
        convergence,
        cut_off: cut_off(surrogate, problem, &positions),
    })
}

/// The steps of one ensemble after its burn-in.
struct Ensemble {
    /// Positions: all walkers of one step, then of the next.
    chain: Vec<Vec<f64>>,
    acceptance: f64,
}

impl Ensemble {
    fn run(density: &Density, fit: &Fit, seed: u64, index: usize, steps: usize) -> Self {
        let steps = BURN_IN + steps;
        let walkers = (0..WALKERS).map(|walker| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            random.set_stream((index * WALKERS + walker) as u64);
            (start(density, fit, &mut random), random)
        });
        let (mut chain, accepted) = hammer_and_sample::sample(
            density,
            &hammer_and_sample::Stretch::default(),
            walkers,
            hammer_and_sample::MinChainLen(steps * WALKERS),
            hammer_and_sample::Serial,
        );
        chain.drain(..BURN_IN * WALKERS);
        Self {
            chain,
            acceptance: accepted as f64 / (steps * WALKERS) as f64,
        }
    }
}

/// A point of the box drawn uniformly within a standard error of the best fit.
fn start(density: &Density, fit: &Fit, random: &mut ChaCha8Rng) -> Vec<f64> {
    let sides = density.sides().iter().zip(&density.best).enumerate();
    sides
        .map(|(j, (&[low, high], best))| {
            let error = fit.covariance[j][j].sqrt().min(0.25 * (high - low));
            let shift: f64 = random.random_range(-1.0..1.0);
            (best + shift * error).clamp(low, high)
        })
        .collect()
}

/// Fraction of the samples at a face of the box that is not a bound.
fn cut_off(surrogate: &Surrogate, problem: &Problem, positions: &[&Vec<f64>]) -> f64 {
    let sides = surrogate.region().coordinates();
    let bounds: Vec<[f64; 2]> = problem
        .unknowns()
        .iter()
        .map(crate::Unknown::bounds)
        .collect();
    let at_face = |x: &&&Vec<f64>| {
        let places = surrogate.region().cube(x);
        places
            .iter()
            .zip(sides)
            .zip(&bounds)
            .any(|((t, side), bound)| {
                let inner = |k: usize| (side[k] - bound[k]).abs() > 1e-9 * (bound[1] - bound[0]);
                (*t < AT_FACE - 1.0 && inner(0)) || (*t > 1.0 - AT_FACE && inner(1))
            })
    };
    positions.iter().filter(at_face).count() as f64 / positions.len() as f64
}
