//! The least misfit under one covariance of the noise, by the method of Levenberg and Marquardt between bounds.
//!
//! ```text
//! at x:  r, J                              nuisances eliminated, metric.rs
//! stop where a linear problem could fall by no more than the tolerance
//! (JᵀJ + λ D²) δ = Jᵀr, |δ| ≤ 0.7          over the unknowns that no bound holds;
//!                                          what a step leads beyond a bound stops at it, and δ is found again
//! ρ = fall of χ² / fall of the linear problem
//! ρ > 0: go there, λ ← λ max(⅓, 1 − (2ρ − 1)³);  else: λ ← λ ν, ν ← 2ν, and the next step a quarter as long
//! ```
//!
//! Rule for λ: H. B. Nielsen, Damping parameter in Marquardt's method, IMM-REP-1999-05, Technical University of Denmark
//! (1999). Bounds: an unknown at a bound towards which χ² falls is held there. If a step would carry an unknown beyond
//! a bound, it stops at the bound and the step of the others is computed again. Merely clipping that one unknown would
//! lose the gain of a step along a valley.

use std::rc::Rc;

use crate::{
    IdentifyError, Problem,
    metric::{Metric, System},
    normal_equations::NormalEquations,
    orthonormal_basis::dot,
    predictor::{Evaluation, Predictor},
};

/// Smallest damping, above the rounding of a matrix of unit diagonal, so that the matrix stays regular in directions
/// that the data do not determine.
const LEAST_DAMPING: f64 = 1e-11;
/// Longest step of a coordinate, a factor of two for a logarithm. Beyond it a linearisation is worthless.
const LONGEST_STEP: f64 = 0.7;
/// Initial damping. The problems are nearly linear in logarithms, and the longest step guards against the rest.
const FIRST_DAMPING: f64 = 1e-4;
/// A step shorter than this in every coordinate ends the search.
const SHORTEST_STEP: f64 = 1e-10;
/// After a step whose gain differs from the linear prediction, a search ends if the linear problem could gain no more
/// than this, in units of χ²: a hundredth of a standard error, where only the jitter of a prediction from a grid may be
/// left.
const WITHIN_JITTER: f64 = 1e-4;
/// Each further such step in a row multiplies the limit by this, up to one standard error.
const MORE_JITTER: f64 = 4.0;
/// A gain deviates from the linear prediction if it differs by more than this fraction of it.
const GAIN_DEVIATION: f64 = 0.5;
/// A longer step than this to the minimum of the linear problem runs along a direction that the data do not determine.
const FAR: f64 = 0.05;
/// Fraction of a step that is tried after it failed.
const RETREAT: f64 = 0.25;
/// Number of trials after which a search ends without convergence.
const MOST_TRIALS: usize = 60;

/// When a search ends.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stopping {
    /// Possible remaining gain in χ², in units of χ², or of χ² per degree of freedom where `degrees` is given.
    pub tolerance: f64,
    /// Degrees of freedom, if the size of the noise is unknown.
    pub degrees: Option<f64>,
}

impl Stopping {
    fn scale(&self, chi_squared: f64) -> f64 {
        self.degrees.map_or(1.0, |degrees| chi_squared / degrees)
    }
}

/// The end of a search.
#[derive(Debug, Clone)]
pub(crate) struct Minimum {
    pub at: Rc<Evaluation>,
    pub system: System,
    pub converged: bool,
    /// Whether it ended within the jitter of the predictions.
    pub within_jitter: bool,
    /// Gain in χ² that the linear problem still predicts.
    pub remaining: f64,
}

/// A search over some of the unknowns.
pub(crate) struct LeastSquares<'s, 'p> {
    pub problem: &'p Problem,
    pub metric: &'s Metric<'p>,
    /// The unknowns that move.
    pub free: &'s [usize],
    pub stopping: Stopping,
}

/// State of the damping.
struct Damping {
    value: f64,
    growth: f64,
    longest: f64,
}

impl Damping {
    const FIRST: Self = Self {
        value: FIRST_DAMPING,
        growth: 2.0,
        longest: LONGEST_STEP,
    };
}

impl LeastSquares<'_, '_> {
    /// Descends from an evaluation. `enough` ends the search early.
    pub fn descend(
        &self,
        predictor: &mut Predictor,
        start: Rc<Evaluation>,
        enough: impl Fn(&Evaluation) -> bool,
    ) -> Result<Minimum, IdentifyError> {
        let system = self.metric.system(&start);
        let mut now = Minimum {
            at: start,
            system,
            converged: false,
            within_jitter: false,
            remaining: f64::INFINITY,
        };
        let mut damping = Damping::FIRST;
        let mut jitter = 0.0;
        for _ in 0..MOST_TRIALS {
            let moving = self.moving(&now);
            let equations = NormalEquations::new(&now.system, &moving);
            now.remaining = equations.possible_decrease()?;
            let scale = self.stopping.scale(now.system.chi_squared);
            now.within_jitter = now.remaining <= f64::min(jitter, 1.0) * scale;
            let target = self.target(&now, moving, &damping)?;
            now.converged = now.within_jitter
                || now.remaining <= self.stopping.tolerance * scale
                || farthest(&now.at.position, &target) < SHORTEST_STEP;
            if now.converged || enough(&now.at) {
                break;
            }
            let trial = predictor.evaluate(&target)?;
            let step = difference(&target, &now.at.position);
            let gained = self.judge(&mut now, &mut damping, &step, trial);
            jitter = if (gained - 1.0_f64).abs() <= GAIN_DEVIATION {
                0.0
            } else {
                (MORE_JITTER * jitter).max(WITHIN_JITTER)
            };
        }
        Ok(now)
    }

    /// Evaluates the minimum of the problem linearised at `now`, within the bounds. `None` if it is far away, along a
    /// direction that the data do not determine, or if the model has no prediction there.
    pub fn full_step(
        &self,
        predictor: &mut Predictor,
        now: &Minimum,
    ) -> Result<Option<Rc<Evaluation>>, IdentifyError> {
        let moving = self.moving(now);
        let step = NormalEquations::new(&now.system, &moving).full_step()?;
        if size(&step) > FAR {
            return Ok(None);
        }
        let mut target = now.at.position.clone();
        for (j, step) in step.iter().enumerate() {
            let [low, high] = self.problem.unknowns()[j].bounds();
            target[j] = (target[j] + step).clamp(low, high);
        }
        predictor.evaluate(&target)
    }

    /// The minimum of the problem linearised at an evaluation, with one unknown held at `x`, and that problem there.
    pub fn linear_minimum(
        &self,
        known: &Evaluation,
        held: usize,
        x: f64,
    ) -> Result<(Vec<f64>, System), IdentifyError> {
        let mut position = known.position.clone();
        position[held] = x;
        let there = difference(&position, &known.position);
        let now = Minimum {
            system: self.metric.system(known).shifted(&there),
            at: Rc::new(Evaluation {
                position,
                ..known.clone()
            }),
            converged: false,
            within_jitter: false,
            remaining: f64::INFINITY,
        };
        let anywhere = Damping {
            longest: f64::INFINITY,
            ..Damping::FIRST
        };
        let target = self.target(&now, self.moving(&now), &anywhere)?;
        let system = now.system.shifted(&difference(&target, &now.at.position));
        Ok((target, system))
    }

    /// Accepts the trial if χ² falls, and adapts the damping. Returns the ratio of the actual to the predicted gain.
    fn judge(
        &self,
        now: &mut Minimum,
        damping: &mut Damping,
        step: &[f64],
        trial: Option<Rc<Evaluation>>,
    ) -> f64 {
        let Some(trial) = trial else {
            damping.longest = RETREAT * size(step);
            // A missing prediction says nothing about jitter.
            return 1.0;
        };
        let predicted = now.system.decrease(step);
        let system = self.metric.system(&trial);
        let ratio = (now.system.chi_squared - system.chi_squared) / predicted;
        if !(predicted > 0.0 && ratio > 0.0) {
            damping.longest = RETREAT * size(step);
            damping.value *= damping.growth;
            damping.growth *= 2.0;
            return ratio.min(0.0);
        }
        let factor = (1.0 - (2.0 * ratio - 1.0).powi(3)).max(1.0 / 3.0);
        damping.value = (damping.value * factor).max(LEAST_DAMPING);
        damping.growth = 2.0;
        damping.longest = (damping.longest / RETREAT).min(LONGEST_STEP);
        now.at = trial;
        now.system = system;
        ratio
    }

    /// The free unknowns that are not held at a bound.
    pub fn moving(&self, now: &Minimum) -> Vec<usize> {
        let falls_up = |j: usize| dot(&now.system.jacobian[j], &now.system.residual) > 0.0;
        self.free
            .iter()
            .copied()
            .filter(|&j| {
                let [low, high] = self.problem.unknowns()[j].bounds();
                let x = now.at.position[j];
                !(x <= low && !falls_up(j) || x >= high && falls_up(j))
            })
            .collect()
    }

    /// The end of a damped step, limited in length and kept within the bounds.
    fn target(
        &self,
        now: &Minimum,
        mut moving: Vec<usize>,
        damping: &Damping,
    ) -> Result<Vec<f64>, IdentifyError> {
        let from = &now.at.position;
        let mut to_bounds = vec![0.0; from.len()];
        loop {
            let system = now.system.shifted(&to_bounds);
            let mut step = NormalEquations::new(&system, &moving).damped_step(damping.value)?;
            for (step, to_bound) in step.iter_mut().zip(&to_bounds) {
                *step += to_bound;
            }
            let part = (damping.longest / size(&step)).min(1.0);
            let mut target: Vec<f64> = from.iter().zip(&step).map(|(x, s)| x + part * s).collect();
            let beyond = |j: &usize| (self.within_bounds(*j, target[*j]) - target[*j]).abs() > 0.0;
            let Some(place) = moving.iter().position(beyond) else {
                for &j in self.free {
                    target[j] = self.within_bounds(j, target[j]);
                }
                return Ok(target);
            };
            let j = moving.remove(place);
            to_bounds[j] = self.within_bounds(j, target[j]) - from[j];
        }
    }

    fn within_bounds(&self, unknown: usize, x: f64) -> f64 {
        let [low, high] = self.problem.unknowns()[unknown].bounds();
        x.clamp(low, high)
    }
}

/// The largest absolute coordinate of a step.
fn size(step: &[f64]) -> f64 {
    step.iter().fold(0.0, |most, s| most.max(s.abs()))
}

/// The largest absolute difference between two lists.
pub(crate) fn farthest(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(x, y)| (x - y).abs())
        .fold(0.0, f64::max)
}

pub(crate) fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(x, y)| x - y).collect()
}
