//! A step to new common parameters, with each curve at parameters of its own.
//!
//! Curve `i` is linearised about `x + u_i`, its parameters in the mixed model: about the common `x` alone, the second
//! order of `u_i` would look like a departure that all curves share, since it has the same sign for curves above and
//! below (M. J. Lindstrom and D. M. Bates, Biometrics 46, 673 (1990)).

use super::{Common, CurveFit, LONGEST_STEP, Linearisation, MixedModel, Repeats, SETTLED, State};
use crate::{
    IdentifyError,
    predictor::{Evaluation, OneCurve, Predictor},
};

/// Parts of its way from the common parameters at which a curve is tried in turn, where the model has no prediction.
const RETREATS: [f64; 4] = [1.0, 0.5, 0.25, 0.0];

/// Where the mixed model leads: the corrections of the common parameters, and what each curve has beside them then.
pub(super) struct Target<'a> {
    pub common: &'a Common,
    /// One list of the determined unknowns for each curve of the problem.
    pub offsets: Vec<Vec<f64>>,
}

/// The curves evaluated, each at its own parameters.
struct Evaluated {
    at: Evaluation,
    offsets: Vec<Vec<f64>>,
}

impl<'a> Target<'a> {
    /// The target of the mixed model; curves left out keep what they have.
    pub fn new(
        state: &State,
        (curves, model): (&[CurveFit], &MixedModel),
        common: &'a Common,
    ) -> Result<Self, IdentifyError> {
        let mut offsets = state.offsets.clone();
        for (curve, own) in curves.iter().zip(model.own(common)?) {
            let offset = &mut offsets[curve.index];
            offset.fill(0.0);
            for (&column, u) in model.scattered.iter().zip(own) {
                offset[column] = u;
            }
        }
        Ok(Self { common, offsets })
    }
}

impl Repeats<'_> {
    /// Whether every correction is small compared with its standard error, or leads out of the range from a bound, and
    /// each curve so near its own parameters that the second order is small.
    pub(super) fn is_settled(&self, state: &State, curves: &[CurveFit], target: &Target) -> bool {
        let common = target.common;
        let is_common_settled = self.determined.iter().enumerate().all(|(k, &j)| {
            let (x, step) = (state.at.position[j], common.correction[k]);
            step.abs() <= SETTLED * common.covariance[(k, k)].sqrt() || self.leads_out(j, x, step)
        });
        // In the coordinates of the unknowns, first and second derivatives are alike.
        let is_curve_settled = |curve: &CurveFit| {
            let offsets = (state.offsets[curve.index].iter()).zip(&target.offsets[curve.index]);
            offsets.enumerate().all(|(k, (from, to))| {
                let j = self.determined[k];
                let (x, step) = (
                    state.at.position[j] + from,
                    to - from + common.correction[k],
                );
                let least = match state.linearisation {
                    Linearisation::OfCommon => common.covariance[(k, k)].sqrt(),
                    Linearisation::OfEach => SETTLED * curve.own_variance[k].sqrt(),
                };
                step * step <= least || self.leads_out(j, x, step)
            })
        };
        is_common_settled && curves.iter().all(is_curve_settled)
    }

    fn leads_out(&self, unknown: usize, x: f64, step: f64) -> bool {
        let [low, high] = self.problem.unknowns()[unknown].bounds();
        (x <= low && step < 0.0) || (x >= high && step > 0.0)
    }

    /// Moves to the target, or part of the way if the model has no prediction there.
    pub(super) fn advance(
        &self,
        predictor: &mut Predictor,
        state: &mut State,
        target: &Target,
    ) -> Result<bool, IdentifyError> {
        let steps = &target.common.correction[..self.determined.len()];
        let longest = steps.iter().fold(0.0, |most: f64, s| most.max(s.abs()));
        let mut part = (LONGEST_STEP / longest).min(1.0);
        while longest * part > SETTLED * f64::EPSILON.sqrt() || part >= 1.0 {
            let mut position = state.at.position.clone();
            for (&j, step) in self.determined.iter().zip(steps) {
                let [low, high] = self.problem.unknowns()[j].bounds();
                position[j] = (position[j] + part * step).clamp(low, high);
            }
            let offsets = self.offsets(state, &position, target);
            if position == state.at.position && offsets == state.offsets {
                return Ok(false);
            }
            if let Some(found) = self.evaluate(predictor, state, position, offsets)? {
                (state.at, state.offsets) = (found.at, found.offsets);
                for (c, step) in
                    (state.nuisances.iter_mut()).zip(&target.common.correction[steps.len()..])
                {
                    *c += part * step;
                }
                return Ok(true);
            }
            part *= 0.5;
        }
        Ok(false)
    }

    /// What each curve has beside a new common position, not farther than the longest step from its old parameters.
    fn offsets(&self, state: &State, position: &[f64], target: &Target) -> Vec<Vec<f64>> {
        let scattered = self.scattered();
        let of_curve = |(from, to): (&Vec<f64>, &Vec<f64>)| {
            let mut offset = vec![0.0; from.len()];
            for &k in &scattered {
                let j = self.determined[k];
                let old = state.at.position[j] + from[k];
                let aim = state.at.position[j] + target.common.correction[k] + to[k];
                let [low, high] = self.problem.unknowns()[j].bounds();
                let new = aim.clamp(old - LONGEST_STEP, old + LONGEST_STEP);
                // Zero where the curves do not scatter, with no rounding.
                let is_common = to[k] == 0.0 && from[k] == 0.0;
                offset[k] = if is_common {
                    0.0
                } else {
                    new.clamp(low, high) - position[j]
                };
            }
            offset
        };
        state
            .offsets
            .iter()
            .zip(&target.offsets)
            .map(of_curve)
            .collect()
    }

    /// All curves, each at its own parameters, and what they have beside the common ones.
    fn evaluate(
        &self,
        predictor: &mut Predictor,
        state: &State,
        position: Vec<f64>,
        mut offsets: Vec<Vec<f64>>,
    ) -> Result<Option<Evaluated>, IdentifyError> {
        if offsets.iter().flatten().all(|u| *u == 0.0) {
            let at = predictor.evaluate(&position)?;
            return Ok(at.map(|at| Evaluated {
                at: Evaluation::clone(&at),
                offsets,
            }));
        }
        let mut found: Vec<Option<Evaluation>> = vec![None; self.shares.len()];
        let wanted = offsets.clone();
        for part in RETREATS {
            let missing: Vec<usize> = (0..found.len()).filter(|&i| found[i].is_none()).collect();
            if missing.is_empty() {
                break;
            }
            let of_curve = |&curve: &usize| {
                let mut own = position.clone();
                for (&j, u) in self.determined.iter().zip(&wanted[curve]) {
                    own[j] += part * u;
                }
                OneCurve {
                    points: self.problem.spans()[curve].clone(),
                    problem: &self.shares[curve].problem,
                    position: own,
                }
            };
            let tried: Vec<OneCurve> = missing.iter().map(of_curve).collect();
            let evaluated = predictor.evaluate_apart(&tried, &state.at)?;
            for (curve, at) in missing.into_iter().zip(evaluated) {
                found[curve] = at;
                offsets[curve] = wanted[curve].iter().map(|u| part * u).collect();
            }
        }
        let curves: Option<Vec<Evaluation>> = found.into_iter().collect();
        let unknowns = self.problem.unknowns();
        Ok(curves.map(|curves| Evaluated {
            at: Evaluation::joined(unknowns, position, &curves),
            offsets,
        }))
    }
}
