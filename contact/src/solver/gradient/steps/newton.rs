//! The semismooth Newton method: solve on a set, then exchange all elements that are on the wrong side.
//!
//! On the set `I` the linear system is solved by preconditioned conjugate gradients, whatever the signs of the
//! pressures, until it is clear which elements are on the wrong side. Then those that pull leave the set, those that
//! overlap enter it, and the pressures are made admissible again (Hintermüller, Ito and Kunisch 2003). It finds the set
//! in few exchanges where the contact breaks up into rings and edges, where stepwise descent is slow. Its termination
//! is not guaranteed, so the caller monitors it.
//!
//! **When it is clear.** Under a stiff coating `K` falls off so steeply with the wavenumber that the residual hides the
//! short waves of the pressure: a system solved to a tenth of the initial residual exchanges noise. The
//! preconditioner's estimate of the remaining error of the pressure does show them. So the elements on the wrong side
//! are predicted one step ahead, and the system is solved until two successive predictions agree except for a third of
//! the elements. If only a few remain, the estimated error must also be small, since single elements would keep
//! switching. If many keep changing, they are noise however small the error: with exchanges at a hundredth of the
//! initial error, rough surfaces took 130 products instead of 25.

use crate::solver::gradient::steps::conjugate::ConjugateSteps;
use crate::solver::gradient::steps::{Context, outcome::StepOutcome};

/// Fraction of the elements on the wrong side that may still change from step to step when they are exchanged.
const MOST_STILL_CHANGING: f64 = 0.3;
/// Elements on the wrong side, as a fraction of the set, up to which they count as few.
const MOST_CALLED_FEW: f64 = 1e-3;
/// Largest error at which few elements are exchanged, relative to the initial one, in the metric of the preconditioner.
const LARGEST_ERROR_FOR_FEW: f64 = 0.01;
/// The same at which the system counts as solved and all elements on the wrong side are exchanged.
const LARGEST_ERROR_IF_SOLVED: f64 = 1e-10;
/// Overlap that is ignored, as a fraction of the tolerance.
const IGNORED_OVERLAP: f64 = 0.5;
/// Steps of one linear system after which its preconditioner counts as failed.
const MOST_STEPS: usize = 60;

/// The state of Newton's method.
pub struct Newton {
    conjugate: ConjugateSteps,
    /// `r·z` at the first step on the current set; none before it.
    first: Option<f64>,
    steps: usize,
}

impl Newton {
    pub fn new(elements: usize) -> Self {
        Self {
            conjugate: ConjugateSteps::new(elements),
            first: None,
            steps: 0,
        }
    }

    /// Starts again.
    pub fn restart(&mut self) {
        (self.first, self.steps) = (None, 0);
    }

    /// Takes one step of the current linear system (one product), whose solution leaves the set as it is; or exchanges
    /// elements if it is solved accurately enough for `tolerance` (one product if elements pull).
    pub fn step(&mut self, context: &mut Context<'_>, tolerance: f64) -> StepOutcome {
        if self.first.is_none() {
            self.conjugate.restart();
            self.steps = 0;
        }
        let missing = self.conjugate.aim(context);
        let first = *self.first.get_or_insert(missing);
        let Context { state, set, .. } = context;
        let predicted =
            set.predict_wrong_side(state, self.conjugate.missing(), IGNORED_OVERLAP * tolerance);
        let are_many = predicted.wrong as f64 > (MOST_CALLED_FEW * set.len() as f64).max(2.0);
        let are_steady = predicted.changed as f64 <= MOST_STILL_CHANGING * predicted.wrong as f64;
        let are_clear = are_steady && (are_many || missing <= LARGEST_ERROR_FOR_FEW * first);
        let is_solved = missing <= LARGEST_ERROR_IF_SOLVED * first;
        if predicted.wrong > 0 && (are_clear || is_solved) {
            return self.exchange(context);
        }
        self.steps += 1;
        let moved = self.conjugate.step_freely(context);
        if moved && self.steps <= MOST_STEPS {
            StepOutcome::Free
        } else {
            StepOutcome::Failed
        }
    }

    fn exchange(&mut self, context: &mut Context<'_>) -> StepOutcome {
        let Context {
            problem,
            state,
            set,
            ..
        } = context;
        set.exchange(state);
        self.first = None;
        let mut members = state.pressure.iter().zip(set.mask());
        if members.any(|(p, member)| *p < 0.0 || (*p > 0.0 && !member)) {
            set.clear_outside(&mut state.pressure);
            // All elements that pressed may have been on the wrong side.
            state.press_somewhere(set.mask());
            state.clip(problem);
        }
        StepOutcome::Exchanged
    }
}
