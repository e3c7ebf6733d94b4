//! Preconditioned projected gradients: any grid, one product with `K` a step.
//!
//! While the working set `I = {p > 0} ∪ {g < 0}` changes, each iteration is one spectral step
//! (Barzilai and Borwein 1988) along the preconditioned residual; once `I` stands still, preconditioned
//! conjugate gradients finish the linear system on it (Polonsky and Keer 1999 for the projected form, Rey, Anciaux
//! and Molinari 2017 and Bugnicourt, Sainsot and Lubrecht 2018 for Fourier-space preconditioning).
//!
//! **Why it ends.** A conjugate step never raises the energy, and a spectral step keeps it below the largest of the last
//! few. One that would not is cut back by an exact line search on the segment to it, which costs no
//! product because the energy is quadratic and both ends are known; a step that does not even start downhill is
//! replaced by a projection of the plain gradient onto the admissible pressures, which always does.

mod conjugate;
mod control;
mod iterate;
mod periodic_filter;
mod preconditioner;
mod projection;
mod segment;
mod spectral;
mod vector;
mod working_set;

use self::{
    conjugate::{ConjugateDirections, Course},
    control::Control,
    iterate::State,
    preconditioner::Preconditioner,
    spectral::SpectralSteps,
    working_set::WorkingSet,
};
use super::{Iterate, Solver, SolverOptions, Watch};
use crate::{ContactError, DiscreteProblem, Load};

/// The iteration stops at this part of the tolerance, so that rounding between its running residual and the
/// freshly computed certificate cannot decide.
const TOLERANCE_MARGIN: f64 = 0.5;

/// The gradient method; see the module's page.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct GradientSolver {
    /// How far to go.
    pub options: SolverOptions,
}

impl Solver for GradientSolver {
    fn solve(
        &self,
        problem: &mut DiscreteProblem,
        load: Load,
        start: &[f64],
        watch: &mut Watch<'_>,
    ) -> Result<Iterate, ContactError> {
        let control = Control::new(load, problem.element_area());
        let mut preconditioner = Preconditioner::new(problem);
        let mut state = State::start(problem, control, start);
        let mut working_set = WorkingSet::of(&state);
        let mut spectral = SpectralSteps::new(state.elements());
        let mut conjugate = ConjugateDirections::new(state.elements());
        let mut course = Course::Kept;
        let mut residuals = Vec::new();
        let goal = TOLERANCE_MARGIN * self.options.tolerance;
        loop {
            let residual = state.residual();
            watch.tell(problem.size(), residuals.len(), residual, working_set.len())?;
            residuals.push(residual);
            if residual <= goal || state.applications() >= self.options.max_applications {
                return Ok(state.into_iterate(residuals));
            }
            course = if working_set.stands_still() && course == Course::Kept {
                conjugate.step(problem, &mut preconditioner, &mut state, &working_set)
            } else {
                conjugate.restart();
                spectral.step(problem, &mut preconditioner, &mut state, &working_set);
                Course::Kept
            };
            working_set.update(&state);
        }
    }
}
