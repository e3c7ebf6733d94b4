//! The semismooth Newton method: solve on a set, then exchange all elements that are on the wrong side.
//!
//! On the set `I` the linear system is solved by preconditioned conjugate gradients to a tenth of the smallest residual met so
//! far, whatever the signs of the pressures. Then those that pull leave the set, those that overlap enter it, and the pressures are
//! made admissible again; when the set stands still, the conjugate gradients go on (Hintermüller, Ito and Kunisch 2003). It finds the
//! set in few exchanges where the contact breaks up into rings and edges, and descending step by step does not; but nothing proves
//! that it ends, so its caller watches it.

use super::{
    conjugate::ConjugateDirections,
    iterate::State,
    preconditioner::{Preconditioner, residual_into},
    working_set::WorkingSet,
};
use crate::{
    DiscreteProblem,
    vector::{dot, sum},
};

/// The part of the smallest residual to which the first linear system is solved.
const FORCING: f64 = 0.1;
/// Steps of one linear system after which its preconditioner is held to have failed.
const MOST_STEPS: usize = 60;

/// The memory of Newton's method.
pub struct Newton {
    conjugate: ConjugateDirections,
    residual: Vec<f64>,
    forcing: f64,
    /// Smallest norm of the residual that a set began with.
    least: f64,
    /// Norm to which the present system is to be solved; none before its first step.
    target: Option<f64>,
    steps: usize,
}

/// What a step did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Turn {
    /// The linear system is not solved far enough, or the set stands still.
    Inner,
    /// Elements were exchanged.
    Exchanged,
    /// The linear system does not converge.
    Failed,
}

impl Newton {
    pub fn new(elements: usize) -> Self {
        Self {
            conjugate: ConjugateDirections::new(elements),
            residual: vec![0.0; elements],
            forcing: FORCING,
            least: f64::INFINITY,
            target: None,
            steps: 0,
        }
    }

    /// Begins anew, solving each system `digits` further than at first.
    pub fn restart(&mut self, digits: i32) {
        self.forcing = FORCING * 10_f64.powi(-digits);
        (self.least, self.target, self.steps) = (f64::INFINITY, None, 0);
    }

    /// One step of the present linear system, its image into `image`, and the exchange where it is solved: one product, two where elements pull.
    pub fn step(
        &mut self,
        problem: &mut DiscreteProblem,
        preconditioner: &mut Preconditioner,
        state: &mut State,
        set: &mut WorkingSet,
        image: &mut [f64],
    ) -> Turn {
        let target = if let Some(target) = self.target {
            target
        } else {
            // Many elements change at once: an even answer cut to what is left would cost every sixth product more.
            preconditioner.restart();
            self.begin(state, set)
        };
        self.steps += 1;
        let moved = self
            .conjugate
            .step_freely(problem, preconditioner, state, set, image);
        let norm = self.norm(state, set);
        if !moved || self.steps > MOST_STEPS {
            return Turn::Failed;
        }
        if norm > target {
            return Turn::Inner;
        }
        set.exchange(state);
        if set.stands_still() {
            (self.target, self.steps) = (Some(self.forcing * norm), 0);
            return Turn::Inner;
        }
        preconditioner.outdate();
        self.target = None;
        if state.pressure.iter().any(|p| *p < 0.0) {
            state.clip(problem);
        }
        Turn::Exchanged
    }

    /// Starts the linear system of a new set.
    fn begin(&mut self, state: &State, set: &WorkingSet) -> f64 {
        self.conjugate.restart();
        self.least = self.least.min(self.norm(state, set));
        let target = self.forcing * self.least;
        (self.target, self.steps) = (Some(target), 0);
        target
    }

    /// The norm of `D − v` over the set; where the total is kept, of its deviation from the mean.
    fn norm(&mut self, state: &State, set: &WorkingSet) -> f64 {
        residual_into(state, set, &mut self.residual);
        let square = dot(&self.residual, &self.residual);
        let mean = if state.keeps_total() {
            sum(&self.residual) / set.len() as f64
        } else {
            0.0
        };
        (square - mean * mean * set.len() as f64).max(0.0).sqrt()
    }
}
