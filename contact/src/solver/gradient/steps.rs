//! The kinds of steps that the loop chooses from, one file each, their common parts, and the context that each works
//! on.

pub mod conjugate;
pub mod face;
pub mod newton;
pub mod outcome;
pub mod projection;
pub mod segment;
pub mod spectral;
pub mod stiffness;

use self::{outcome::StepOutcome, segment::Segment};
use crate::{
    DiscreteProblem,
    solver::gradient::{
        preconditioner::{Preconditioner, UniformAccuracy},
        state::State,
        working_set::WorkingSet,
    },
    vector::stretches::SparseField,
};

/// The problem, a pressure, the elements whose pressures are free, and the approximate inverse of the system on them.
pub struct Context<'a> {
    pub problem: &'a mut DiscreteProblem,
    pub state: &'a mut State,
    pub set: &'a mut WorkingSet,
    pub preconditioner: &'a mut Preconditioner,
    /// The current step, of any kind.
    pub segment: &'a mut Segment,
}

impl Context<'_> {
    /// Writes into `z` the [preconditioned residual](Preconditioner::direction_into); returns its `λ`.
    pub fn direction_into(&mut self, accuracy: UniformAccuracy, z: &mut SparseField) -> f64 {
        self.preconditioner
            .direction_into(self.problem, self.state, self.set, accuracy, z)
    }

    /// Takes the [segment](Segment::take), or cuts it if the energy would rise above `ceiling`: one product.
    pub fn take_segment(&mut self, ceiling: f64) -> StepOutcome {
        self.segment.take(self.problem, self.state, ceiling)
    }
}
