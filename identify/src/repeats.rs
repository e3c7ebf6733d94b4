//! Repeats: curves whose parameters scatter about common values.
//!
//! ```text
//! at x, with curve i at x + u_i:
//!        noise of all curves, each with parameters of its own         restricted_likelihood.rs
//!        each curve fitted alone, linearised there                    curve_fit.rs
//!        common parameters, scatter, and each u_i                     mixed_model.rs
//! go there, until they stay                                           step.rs
//! leave out the roughest curve that is far rougher, and go on         discordant.rs
//! what do all residuals have in common?                               common_departure.rs
//! which curves lie far from the others?                               discordant.rs
//! ```
//!
//! An interval of a common value is `x ± √(t² C_c + z² C_p)`: `C_c` is the variance from the scatter and the noise of
//! the `k` curves, `t` Student's quantile with `k − 1` degrees of freedom, as for the mean of a sample (J. Hartung and
//! G. Knapp, Stat. Med. 20, 1771 (2001)), and `C_p` the variance added by the priors of common nuisances. No profile is
//! needed.

use crate::{
    Exclusion, Fit, FitOptions, IdentifyError, NoiseLevels, Problem, REFUSAL, Role, departure,
    noise::restricted_likelihood::{Part, RestrictedLikelihood},
    null_direction::NullSpace,
    predictor::{Evaluation, Predictor},
};

mod common_departure;
mod curve_fit;
mod discordant;
mod mixed_model;
mod odd;
mod result;
mod step;

use curve_fit::{CurveFit, Share};
use mixed_model::{Common, MixedModel};
pub use odd::{OddRepeat, OddRepeats, WithoutOdd};
use step::Target;

/// Corrections below this fraction of a standard error end the iteration.
const SETTLED: f64 = 0.02;
/// Maximum number of rounds; each takes one prediction.
const MOST_ROUNDS: usize = 25;
/// Largest correction of a coordinate in one round.
const LONGEST_STEP: f64 = 0.7;

/// A fit of repeats in progress.
pub(crate) struct Repeats<'p> {
    problem: &'p Problem,
    options: &'p FitOptions,
    null_space: NullSpace,
    /// Unknowns that the data determine together.
    determined: Vec<usize>,
    /// Indices of the linear nuisances that all curves share.
    shared: Vec<usize>,
    shares: Vec<Share>,
}

/// How well the points hold about which the curves are linearised.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Linearisation {
    /// For the common parameters: the second order of each curve is less than half of their standard error.
    OfCommon,
    /// For each curve: the second order is small beside its own noise, as a test of what curves share asks.
    OfEach,
}

/// The present state of the iteration.
struct State {
    /// The common parameters, and each curve at its own.
    at: Evaluation,
    /// For each curve, its own parameters less the common ones: the determined unknowns.
    offsets: Vec<Vec<f64>>,
    /// Values of the shared linear nuisances.
    nuisances: Vec<f64>,
    levels: NoiseLevels,
    linearisation: Linearisation,
    exclusions: Vec<Exclusion>,
}

impl<'p> Repeats<'p> {
    pub fn new(problem: &'p Problem, options: &'p FitOptions) -> Result<Self, IdentifyError> {
        let null_space = problem.null_directions().among(problem.unknowns())?;
        let held = null_space.hold()?;
        let determined = (0..problem.unknowns().len())
            .filter(|j| !held.contains(j))
            .collect();
        let columns = problem.columns();
        let shared: Vec<usize> = (0..columns.len())
            .filter(|&k| columns[k].curve.is_none())
            .collect();
        let range = departure::range(problem.abscissa().into_iter());
        let shares = (0..problem.curves().len())
            .map(|index| Share {
                index,
                problem: problem.of_curve(index),
                range,
                common: shared
                    .iter()
                    .map(|&k| columns[k].part(&problem.spans()[index]).values)
                    .collect(),
            })
            .collect();
        Ok(Self {
            problem,
            options,
            null_space,
            determined,
            shared,
            shares,
        })
    }

    /// Fits from an evaluation.
    pub fn run(&self, predictor: &mut Predictor, start: &Evaluation) -> Result<Fit, IdentifyError> {
        let prior = |&k: &usize| {
            self.problem.columns()[k]
                .prior
                .map_or(0.0, |[mean, _]| mean)
        };
        let mut state = State {
            at: start.clone(),
            offsets: vec![vec![0.0; self.determined.len()]; self.shares.len()],
            nuisances: self.shared.iter().map(prior).collect(),
            levels: self.problem.first_levels(),
            linearisation: Linearisation::OfCommon,
            exclusions: Vec::new(),
        };
        for _ in 0..MOST_ROUNDS {
            state.levels = self.noise(&state);
            let curves = self.curves(&state);
            let model = self.mixed_model(&curves, &state);
            let common = model.solve(&self.guess(&curves))?;
            let target = Target::new(&state, (&curves, &model), &common)?;
            if self.is_settled(&state, &curves, &target) {
                let roughest = discordant::roughest(&curves);
                let is_refused = || self.goodness(&state, &curves).misfit_p < REFUSAL;
                if state.linearisation == Linearisation::OfCommon
                    && (roughest.is_some() || is_refused())
                {
                    state.linearisation = Linearisation::OfEach;
                } else if let Some(exclusion) = roughest {
                    state.exclusions.push(exclusion);
                } else {
                    return self.result(predictor, &state, &curves, &common, true);
                }
            } else if !self.advance(predictor, &mut state, &target)? {
                break;
            }
        }
        let curves = self.curves(&state);
        let common = self
            .mixed_model(&curves, &state)
            .solve(&self.guess(&curves))?;
        self.result(predictor, &state, &curves, &common, false)
    }

    /// The noise of the included curves, each with its own parameters.
    fn noise(&self, state: &State) -> NoiseLevels {
        let parts = self.parts(state);
        self.likelihood(&parts, state).estimate()
    }

    /// The [`RestrictedLikelihood::persistence_p`] of the median curve. A persistent deviation that differs from repeat
    /// to repeat is part of the scatter between them; a misfit persists in every repeat.
    fn persistence_p(&self, state: &State) -> Option<f64> {
        let parts = self.parts(state);
        let of_curve = |part: &(&Share, Evaluation)| {
            let part = std::slice::from_ref(part);
            self.likelihood(part, state).persistence_p()
        };
        let mut all: Vec<f64> = parts.iter().filter_map(of_curve).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 2).copied()
    }

    /// The included curves, each with its part of the present evaluation.
    fn parts(&self, state: &State) -> Vec<(&Share, Evaluation)> {
        self.included(state)
            .map(|share| (share, state.at.part(&self.problem.spans()[share.index])))
            .collect()
    }

    fn likelihood<'a>(
        &'a self,
        parts: &'a [(&'a Share, Evaluation)],
        state: &State,
    ) -> RestrictedLikelihood<'a> {
        let parts = parts
            .iter()
            .map(|(share, at)| Part {
                problem: &share.problem,
                at,
                free: &self.determined,
                departures: &[],
            })
            .collect();
        RestrictedLikelihood::new(parts, *self.problem.noise(), state.levels)
    }

    fn curves(&self, state: &State) -> Vec<CurveFit> {
        self.included(state)
            .map(|share| {
                let at = state.at.part(&self.problem.spans()[share.index]);
                let offset = &state.offsets[share.index];
                let at = (&at, &offset[..]);
                share.fit(at, &self.determined, &state.nuisances, &state.levels)
            })
            .collect()
    }

    fn included(&self, state: &State) -> impl Iterator<Item = &Share> {
        self.shares
            .iter()
            .filter(|share| state.exclusions.iter().all(|out| out.curve != share.index))
    }

    fn mixed_model(&self, curves: &[CurveFit], state: &State) -> MixedModel {
        let unknowns = self.problem.unknowns();
        let of_unknown = |&j: &usize| {
            let Some(prior) = unknowns[j].prior() else {
                return [0.0; 2];
            };
            let value = state.at.parameters[j];
            let slope = prior.deviation_slope(value) * unknowns[j].value_slope(value);
            [slope * slope, -slope * prior.deviation(value)]
        };
        let of_nuisance = |(&k, c): (&usize, &f64)| {
            let prior = self.problem.columns()[k].prior;
            prior.map_or([0.0; 2], |[mean, sd]| {
                [1.0 / (sd * sd), (mean - c) / (sd * sd)]
            })
        };
        MixedModel {
            curves: curves.iter().map(|curve| curve.equations.clone()).collect(),
            prior: self
                .determined
                .iter()
                .map(of_unknown)
                .chain(self.shared.iter().zip(&state.nuisances).map(of_nuisance))
                .collect(),
            scattered: self.scattered(),
        }
    }

    /// The indices, among the determined unknowns, of those that are answers: they may differ from curve to curve.
    fn scattered(&self) -> Vec<usize> {
        let unknowns = self.problem.unknowns();
        (0..self.determined.len())
            .filter(|&k| unknowns[self.determined[k]].role() == Role::Sought)
            .collect()
    }

    /// The standard deviation of the curves' own parameters.
    fn guess(&self, curves: &[CurveFit]) -> Vec<f64> {
        let n = curves.len() as f64;
        self.scattered()
            .iter()
            .map(|&k| {
                let mean = curves.iter().map(|curve| curve.own[k]).sum::<f64>() / n;
                let squares: f64 = curves
                    .iter()
                    .map(|curve| (curve.own[k] - mean).powi(2))
                    .sum();
                (squares / (n - 1.0)).sqrt().min(1.0)
            })
            .collect()
    }
}
