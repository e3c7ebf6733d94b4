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
//! **Quadrants.** Where indenter and relief are their own mirror images in both axes, so is the one solution, and a path solves on the quadrant x, y > 0
//! alone: `K` is then the sum over an element's four images, which cosine transforms of half the length multiply by in a quarter of the time, and every field has a
//! quarter of the elements. The method is the same, since all sums are a quarter of those on the whole grid. Only what looks across the axes knows of it:
//! the filter transforms cosines, the band around the contact and the rows of the sparse factor near an axis see the images beyond, and an axis is no border of a window.
//!
//! **Both kinds of load.** Every step keeps the total of the pressure; under a prescribed penetration the pressure is then scaled until the mean of `v`
//! over it is `D`, which takes no product, and the conjugate directions are conjugate to the pressure besides. With the plain residual `D − v` a stiff
//! coat under the paper's cylinders took eight times the products, because preconditioners answer an even residual worst.
//!
//! **Preconditioners.** The reciprocal of the symbol of `K` on the periodic grid, by FFT in single precision. Two things make it nearly exact
//! on the working set, where the restricted reciprocal of `C(k) sinc sinc` takes twice the products: the symbol is that of the sampled displacement,
//! aliases included, two thirds of what the shortest waves have; and the answer is made to vanish in a narrow
//! band around the set, by a pressure in that band found with a few coefficients, as the inverse of a restricted system demands. Where a
//! coat is so stiff that the filter's near coefficients all but cancel, the band answers twice, which keeps the filter positive. A direction keeps the total along the
//! answer `M⁻¹ 1` to an even residual, which is found once and only cut to the sets that follow: exact projections took not one product fewer. Under a
//! coat more than some twenty times as stiff as its base a factorised sparse approximate inverse `Gᵀ G` of the restricted system itself (Kaporin 1994;
//! Schäfer, Katzfuss and Owhadi 2021): each element's row from the small dense system of its twenty nearest predecessors in an order from coarse to
//! fine. Equal neighbourhoods share a row, which makes building it cheaper than a product or two.
//!
//! **Newton.** Where the fast steps stall, or the energy cuts one, as on a thin stiff coat whose contact shrinks to rings and edges, a semismooth Newton method solves
//! the linear system on the set until it is clear which elements are on the wrong side, and exchanges them all at once (Hintermüller, Ito and Kunisch 2003). It begins with the load's
//! own preconditioner; should its systems not converge, the sparse factor takes over.
//!
//! **Why it ends.** A conjugate step never raises the energy, and a spectral step keeps it below the largest of the last
//! few. One that would not is cut back by an exact line search on the segment to it, which costs no
//! product because the energy is quadratic and both ends are known; a step that does not even start downhill is
//! replaced by a projection of the plain gradient onto the admissible pressures, which always does. Newton's method has no such
//! proof: after sixteen exchanges without gain it gives way to a descent from face to face (`face.rs`), whose energy falls from each to the next, so that none comes twice. The
//! number of products is bounded besides, and the best pressure met is returned.
//!
//! **Units.** All is computed in the units that the problem's scale (`scale.rs`) sets, powers of two, so that no threshold knows those of the user. Elements beyond the
//! indenter's end are none of the problem: no set takes them in, and no sum.

mod best;
mod conjugate;
mod control;
mod edge_band;
mod face;
mod iterate;
mod newton;
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
    face::FaceDescent,
    iterate::State,
    newton::{Newton, Turn},
    preconditioner::Preconditioner,
    segment::{Part, Segment},
    spectral::SpectralSteps,
    strategy::{Phase, Strategy},
    working_set::WorkingSet,
};
use super::{Iterate, Solver, SolverOptions, Watch};
use crate::{ContactError, DiscreteProblem, Load, vector::each};

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
        let control = Control::of(problem, load);
        let mut iteration = Iteration::start(problem, control, start, self.options.tolerance);
        let mut residuals = Vec::new();
        let (ending, residual) = loop {
            let Workspace {
                state, set, best, ..
            } = &mut *iteration.workspace;
            let (residual, is_admissible) = state.residual();
            let images = problem.sector().images();
            let working_set = [set.len(), set.take_moves()].map(|elements| elements * images);
            watch.tell(problem.grid_size(), residuals.len(), residual, working_set)?;
            residuals.push(residual);
            if is_admissible {
                best.offer(state, residual);
            }
            match self.ending(problem, state, set, residual, is_admissible) {
                Some(ending) => break (ending, residual),
                // A descent that ends in no number would only begin again.
                None if residual.is_infinite() && iteration.strategy.phase() == Phase::Descent => {
                    break (Ending::GivenUp, residual);
                }
                None => iteration.step(problem, residual),
            }
        };
        let (contact_stiffness, stiffness_applications) =
            if ending == Ending::Solved && self.options.contact_stiffness {
                iteration.contact_stiffness(problem)
            } else {
                (None, 0)
            };
        let Workspace { state, best, .. } = &*iteration.workspace;
        let scale = problem.scale();
        let mut pressure = best.or(state, residual).to_vec();
        each(&mut pressure, |p| *p *= scale.pressure());
        let iterate = Iterate {
            iterations: residuals.len() - 1,
            operator_applications: state.applications(),
            pressure,
            penetration: scale.length * state.penetration,
            residuals,
            contact_stiffness,
            stiffness_applications,
            reached_border: ending == Ending::ReachedBorder,
        };
        problem.keep_workspace(iteration.workspace);
        Ok(iterate)
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
        state: &State,
        set: &WorkingSet,
        residual: f64,
        is_admissible: bool,
    ) -> Option<Ending> {
        if problem.is_window() && set.touches_border(&problem.everywhere()) {
            Some(Ending::ReachedBorder)
        } else if is_admissible && residual <= TOLERANCE_MARGIN * self.options.tolerance {
            Some(Ending::Solved)
        } else {
            (state.applications() >= self.options.max_applications).then_some(Ending::GivenUp)
        }
    }
}

/// All fields of a solution, allocated once for all loads on one problem.
pub struct Workspace {
    state: State,
    set: WorkingSet,
    best: Best,
    preconditioner: Preconditioner,
    /// The step that is being taken, of whatever kind.
    segment: Segment,
    spectral: SpectralSteps,
    conjugate: ConjugateDirections,
    newton: Option<Newton>,
    faces: Option<FaceDescent>,
}

impl Workspace {
    fn new(problem: &DiscreteProblem) -> Self {
        Self {
            state: State::new(problem),
            set: WorkingSet::new(problem.elements()),
            best: Best::new(),
            preconditioner: Preconditioner::new(problem),
            segment: Segment::new(problem.elements()),
            spectral: SpectralSteps::new(problem.elements()),
            conjugate: ConjugateDirections::new(problem.elements()),
            newton: None,
            faces: None,
        }
    }

    /// Begins another load, of which nothing depends on the one before.
    fn begin(&mut self, problem: &mut DiscreteProblem, control: Control, start: &[f64]) {
        self.preconditioner.begin();
        self.restart();
        self.best.restart();
        self.state.start(problem, control, start);
        self.set.start(&self.state);
    }

    /// Forgets the steps so far.
    fn restart(&mut self) {
        self.preconditioner.restart();
        self.spectral.restart();
        self.conjugate.restart();
        if let Some(newton) = &mut self.newton {
            newton.restart();
        }
    }
}

/// Everything that one solution carries from step to step.
struct Iteration {
    strategy: Strategy,
    course: Course,
    tolerance: f64,
    workspace: Box<Workspace>,
}

impl Iteration {
    fn start(
        problem: &mut DiscreteProblem,
        control: Control,
        start: &[f64],
        tolerance: f64,
    ) -> Self {
        let mut workspace = problem
            .take_workspace()
            .unwrap_or_else(|| Box::new(Workspace::new(problem)));
        workspace.begin(problem, control, start);
        Self {
            strategy: Strategy::new(),
            course: Course::Left(Part::Whole),
            tolerance,
            workspace,
        }
    }

    fn step(&mut self, problem: &mut DiscreteProblem, residual: f64) {
        if !residual.is_finite() {
            // Nothing was left of the pressure, or rounding is all there is: back to the best.
            self.strategy.descend();
            return self.begin_descent(problem);
        }
        let changes = match self.strategy.phase() {
            Phase::Newton(_) => {
                let turn = self.newton_step(problem);
                self.strategy.after_newton(residual, turn)
            }
            Phase::Descent if self.workspace.preconditioner.knows_operator() => {
                self.face_step(problem);
                false
            }
            Phase::Fast | Phase::Descent => {
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
        let Workspace {
            state,
            set,
            preconditioner,
            segment,
            spectral,
            conjugate,
            ..
        } = &mut *self.workspace;
        let part = if set.stands_still() && self.course == Course::Kept {
            spectral.forget_direction();
            self.course = conjugate.step_within(problem, preconditioner, state, set, segment);
            match self.course {
                Course::Kept => Part::Whole,
                Course::Left(part) => part,
            }
        } else {
            conjugate.restart();
            self.course = Course::Kept;
            spectral.step(problem, preconditioner, state, set, segment)
        };
        set.update(state);
        if !set.stands_still() {
            preconditioner.outdate();
        }
        part
    }

    fn newton_step(&mut self, problem: &mut DiscreteProblem) -> Turn {
        let Workspace {
            state,
            set,
            preconditioner,
            segment,
            newton,
            ..
        } = &mut *self.workspace;
        let newton = newton.get_or_insert_with(|| Newton::new(state.elements()));
        let (image, tolerance) = (&mut segment.image, self.tolerance);
        newton.step(problem, preconditioner, state, set, image, tolerance)
    }

    fn face_step(&mut self, problem: &mut DiscreteProblem) {
        let Workspace {
            state,
            set,
            preconditioner,
            segment,
            faces: Some(faces),
            ..
        } = &mut *self.workspace
        else {
            return;
        };
        faces.step(problem, preconditioner, state, set, segment);
    }

    /// Prepares the phase that has just begun.
    fn change_phase(&mut self, problem: &mut DiscreteProblem) {
        let failures = match self.strategy.phase() {
            Phase::Fast | Phase::Newton(0) => 0,
            Phase::Newton(_) | Phase::Descent => 1,
        };
        let Workspace {
            preconditioner,
            newton,
            ..
        } = &mut *self.workspace;
        let is_known = preconditioner.prepare_for_newton(problem, failures);
        if !is_known {
            self.strategy.descend();
        }
        if self.strategy.phase() == Phase::Descent {
            self.begin_descent(problem);
        } else if let Some(newton) = newton {
            newton.restart();
        }
    }

    /// Back to the best admissible pressure, and steps without memory: one product.
    fn begin_descent(&mut self, problem: &mut DiscreteProblem) {
        self.course = Course::Left(Part::Whole);
        self.workspace.restart();
        let Workspace {
            state,
            set,
            best,
            faces,
            ..
        } = &mut *self.workspace;
        let (residual, _) = state.residual();
        let pressure = best.or(state, residual).to_vec();
        state.pressure.copy_from_slice(&pressure);
        state.clip(problem);
        set.update(state);
        let faces = faces.get_or_insert_with(|| FaceDescent::new(state.elements()));
        faces.begin(state);
    }

    /// `dQ/dD` (N/m) on the elements that press, and the products that it takes; none where nothing presses.
    fn contact_stiffness(&mut self, problem: &mut DiscreteProblem) -> (Option<f64>, usize) {
        let Workspace {
            state,
            set,
            preconditioner,
            segment,
            conjugate,
            ..
        } = &mut *self.workspace;
        set.keep_pressing(state);
        if set.len() == 0 {
            return (None, 0);
        }
        if !set.stands_still() {
            preconditioner.outdate();
        }
        let buffers = conjugate.lend(segment);
        let (sum, applications) =
            stiffness::pressure_sum_per_penetration(problem, preconditioner, state, set, buffers);
        let per_sum = problem.element_area() / problem.scale().compliance;
        (sum.map(|sum| sum * per_sum), applications)
    }
}

#[cfg(test)]
mod tests;
