//! Preconditioned projected gradients: any grid, one product with `K` a step.
//!
//! **Fast steps.** While the working set `I = {p > 0} ∪ {g < 0}` changes, each iteration is one spectral step
//! (Barzilai and Borwein 1988) along the preconditioned residual; once `I` stands still, preconditioned
//! conjugate gradients finish the linear system on it. Polonsky and Keer (1999) is the projected form of these, with conjugate steps
//! throughout, a product a step and no preconditioner; Vollebregt (2014) and Rey, Anciaux and Molinari (2017) precondition in Fourier
//! space, Bugnicourt, Sainsot and Lubrecht (2018) bring conjugate gradients to a contact whose set changes. Different here: spectral steps until the set
//! is found, because a conjugate direction is worth nothing on another set; the exact line search only where the energy asks
//! for it; starts that respect the outline of the relief; and products on the smallest square that holds the contact.
//!
//! **Preconditioners.** The reciprocal of the symbol of `K` on the periodic grid, by FFT in single precision. Two things make it nearly exact
//! on the working set, where the restricted reciprocal of `C(k) sinc sinc` takes twice the products: the symbol is that of the sampled displacement,
//! aliases included, two thirds of what the shortest waves have; and the answer is made to vanish in a narrow
//! band around the set, by a pressure in that band found with a few coefficients, as the inverse of a restricted system demands. Under a
//! coat more than some twenty times as stiff as its base a factorised sparse approximate inverse `Gᵀ G` of the restricted system itself (Kaporin 1994;
//! Schäfer, Katzfuss and Owhadi 2021): each element's row from the small dense system of its twenty nearest predecessors in an order from coarse to
//! fine. Equal neighbourhoods share a row, which makes building it cheaper than a product or two.
//!
//! **Newton.** Where the fast steps stall, as on a thin stiff coat whose contact shrinks to rings and edges, a semismooth Newton method solves
//! the linear system on the set to a tenth and exchanges all elements on the wrong side at once (Hintermüller, Ito and Kunisch 2003).
//!
//! **Why it ends.** A conjugate step never raises the energy, and a spectral step keeps it below the largest of the last
//! few. One that would not is cut back by an exact line search on the segment to it, which costs no
//! product because the energy is quadratic and both ends are known; a step that does not even start downhill is
//! replaced by a projection of the plain gradient onto the admissible pressures, which always does. Newton's method has no such
//! proof: after sixteen exchanges without gain it gives way to a stretch of these descents, each twice as long as the
//! one before, so that whatever Newton does, the descents prevail; the strictly convex problem has one minimum, and they reach it. The
//! number of products is bounded besides, and the best pressure met is returned.

mod best;
mod conjugate;
mod control;
mod edge_band;
mod iterate;
mod newton;
mod periodic_filter;
mod preconditioner;
mod projection;
mod restricted_filter;
mod segment;
mod sparse_factor;
mod spectral;
mod stiffness;
mod strategy;
mod working_set;

use self::{
    best::Best,
    conjugate::{ConjugateDirections, Course},
    control::Control,
    iterate::State,
    newton::{Newton, Turn},
    preconditioner::Preconditioner,
    segment::Part,
    spectral::SpectralSteps,
    strategy::{Phase, Strategy},
    working_set::WorkingSet,
};
use super::{Iterate, Solver, SolverOptions, Watch};
use crate::{ContactError, DiscreteProblem, Load};

/// The iteration stops at this part of the tolerance, so that rounding between its running residual and the
/// freshly computed certificate cannot decide.
const TOLERANCE_MARGIN: f64 = 0.8;

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
        let mut iteration = Iteration::start(problem, control, start);
        let mut best = Best::new();
        let mut residuals = Vec::new();
        let (ending, residual) = loop {
            let (residual, is_admissible) = iteration.state.residual();
            let contact = iteration.working_set.len();
            watch.tell(problem.grid_size(), residuals.len(), residual, contact)?;
            residuals.push(residual);
            if is_admissible {
                best.offer(&iteration.state, residual);
            }
            match self.ending(problem, &iteration, residual, is_admissible) {
                Some(ending) => break (ending, residual),
                None => iteration.step(problem, residual),
            }
        };
        let (contact_stiffness, stiffness_applications) =
            if ending == Ending::Solved && self.options.contact_stiffness {
                iteration.contact_stiffness(problem)
            } else {
                (None, 0)
            };
        let Iteration {
            state, workspace, ..
        } = iteration;
        problem.keep_workspace(workspace);
        Ok(Iterate {
            iterations: residuals.len() - 1,
            operator_applications: state.applications(),
            pressure: best.or(state, residual),
            residuals,
            contact_stiffness,
            stiffness_applications,
            reached_border: ending == Ending::ReachedBorder,
        })
    }
}

/// Why an iteration stops.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ending {
    Solved,
    GivenUp,
    ReachedBorder,
}

impl GradientSolver {
    fn ending(
        &self,
        problem: &DiscreteProblem,
        iteration: &Iteration,
        residual: f64,
        is_admissible: bool,
    ) -> Option<Ending> {
        let set = &iteration.working_set;
        if problem.is_window() && set.touches_border(problem.size()) {
            Some(Ending::ReachedBorder)
        } else if is_admissible && residual <= TOLERANCE_MARGIN * self.options.tolerance {
            Some(Ending::Solved)
        } else {
            let applications = iteration.state.applications();
            (applications >= self.options.max_applications).then_some(Ending::GivenUp)
        }
    }
}

/// What a solution needs beside its state: allocated once for all loads on one problem.
pub struct Workspace {
    preconditioner: Preconditioner,
    spectral: SpectralSteps,
    conjugate: ConjugateDirections,
    newton: Option<Newton>,
}

impl Workspace {
    fn new(problem: &DiscreteProblem) -> Self {
        Self {
            preconditioner: Preconditioner::new(problem),
            spectral: SpectralSteps::new(problem.elements()),
            conjugate: ConjugateDirections::new(problem.elements()),
            newton: None,
        }
    }

    /// Begins another load, of which nothing depends on the one before.
    fn begin(&mut self) {
        self.preconditioner.begin();
        self.restart();
    }

    /// Forgets the steps so far.
    fn restart(&mut self) {
        self.preconditioner.restart();
        self.spectral.restart();
        self.conjugate.restart();
        if let Some(newton) = &mut self.newton {
            newton.restart(0);
        }
    }
}

/// Everything that one solution carries from step to step.
struct Iteration {
    state: State,
    working_set: WorkingSet,
    strategy: Strategy,
    course: Course,
    workspace: Box<Workspace>,
}

impl Iteration {
    fn start(problem: &mut DiscreteProblem, control: Control, start: &[f64]) -> Self {
        let mut workspace = problem
            .take_workspace()
            .unwrap_or_else(|| Box::new(Workspace::new(problem)));
        workspace.begin();
        let state = State::start(problem, control, start);
        Self {
            working_set: WorkingSet::of(&state),
            strategy: Strategy::new(),
            course: Course::Left(Part::Whole),
            workspace,
            state,
        }
    }

    fn step(&mut self, problem: &mut DiscreteProblem, residual: f64) {
        let changes = match self.strategy.phase() {
            Phase::Newton(_) => {
                let turn = self.newton_step(problem);
                self.strategy.after_newton(residual, turn)
            }
            Phase::Fast | Phase::Descent(_) => {
                let part = self.fast_step(problem);
                self.strategy.after_fast(residual, part)
            }
        };
        if changes {
            self.change_phase(problem);
        }
    }

    /// A conjugate step on a set that stands still, else a spectral one.
    fn fast_step(&mut self, problem: &mut DiscreteProblem) -> Part {
        let (state, set) = (&mut self.state, &mut self.working_set);
        let Workspace {
            preconditioner,
            spectral,
            conjugate,
            ..
        } = &mut *self.workspace;
        let part = if set.stands_still() && self.course == Course::Kept {
            spectral.forget_direction();
            self.course = conjugate.step_within(problem, preconditioner, state, set);
            match self.course {
                Course::Kept => Part::Whole,
                Course::Left(part) => part,
            }
        } else {
            conjugate.restart();
            self.course = Course::Kept;
            spectral.step(problem, preconditioner, state, set)
        };
        set.update(state);
        if !set.stands_still() {
            preconditioner.outdate();
        }
        part
    }

    fn newton_step(&mut self, problem: &mut DiscreteProblem) -> Turn {
        let elements = self.state.elements();
        let Workspace {
            preconditioner,
            newton,
            ..
        } = &mut *self.workspace;
        newton.get_or_insert_with(|| Newton::new(elements)).step(
            problem,
            preconditioner,
            &mut self.state,
            &mut self.working_set,
        )
    }

    /// Prepares the phase that has just begun.
    fn change_phase(&mut self, problem: &mut DiscreteProblem) {
        if let Phase::Newton(failures) = self.strategy.phase() {
            let Workspace {
                preconditioner,
                newton,
                ..
            } = &mut *self.workspace;
            if preconditioner.turn_to_factor(problem, 1 + failures) {
                if let Some(newton) = newton {
                    newton.restart(i32::try_from(failures).unwrap_or(i32::MAX));
                }
                return;
            }
            self.strategy.only_fast();
        }
        self.begin_descent(problem);
    }

    /// Back to an admissible pressure and steps without memory.
    fn begin_descent(&mut self, problem: &mut DiscreteProblem) {
        if self.state.pressure.iter().any(|p| *p < 0.0) {
            self.state.clip(problem);
        }
        self.workspace.restart();
        self.course = Course::Left(Part::Whole);
        self.working_set.update(&self.state);
    }

    /// `dQ/dD` (N/m) on the elements that press, and the products that it takes; none where nothing presses.
    fn contact_stiffness(&mut self, problem: &mut DiscreteProblem) -> (Option<f64>, usize) {
        self.working_set.keep_pressing(&self.state);
        if self.working_set.len() == 0 {
            return (None, 0);
        }
        let (sum, applications) = stiffness::pressure_sum_per_penetration(
            problem,
            &mut self.workspace.preconditioner,
            &self.working_set,
        );
        (sum.map(|sum| sum * problem.element_area()), applications)
    }
}

#[cfg(test)]
mod tests;
