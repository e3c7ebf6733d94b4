//! Preconditioned projected gradients: any grid, one product with `K` a step.
//!
//! With `v = (K + η) p + g0`, working set `I = {p > 0} ∪ {g < 0}` and preconditioner `M_I`, an approximate inverse of
//! the system on `I`:
//!
//! ```text
//! while the largest line of the certificate is above the tolerance:
//!   fast:     I changes:       p ← max(p + α z, 0),  z = M_I⁻¹ (λ − v), α spectral     (Barzilai and Borwein 1988)
//!             I stands still:  p ← p + α d,          d = z + β d, conjugate on I       (Polak and Ribière)
//!             a step that raises the energy is cut at its minimum on the segment       (Grippo, Lampariello and Lucidi 1986)
//!   Newton:   where the fast steps stall or are cut, and from the start under a stiff coating: solve on I by conjugate
//!             gradients until it is clear which elements are on the wrong side, exchange them all
//!                                                                                      (Hintermüller, Ito and Kunisch 2003)
//!   descent:  where Newton cycles: from face to face, the energy falls                 (Lawson and Hanson 1974)
//! then dQ/dD by one more system on {p > 0}
//! ```
//!
//! Polonsky and Keer (1999) is the projected form of the fast steps, with conjugate steps throughout and no
//! preconditioner; Vollebregt (2014) and Rey, Anciaux and Molinari (2017) precondition in Fourier space, Bugnicourt,
//! Sainsot and Lubrecht (2018) bring conjugate gradients to a contact whose set changes. Different here: spectral steps
//! until the set is found, because a conjugate direction is worth nothing on another set; the exact line search only
//! where the energy asks for it; starts that respect the outline of the relief; products on the smallest square that
//! holds the contact.
//!
//! **Sectors.** Where indenter and relief are symmetric in x and y, so is the one solution, and a path solves on the
//! quadrant x, y > 0 alone: `K` is the sum over an element's four images, applied by cosine transforms of half the
//! length. All sums are a quarter of those on the whole grid. Where they are symmetric in y alone, as under a pyramid
//! of three faces, it solves on the half y > 0. Only operators that reach across the axes depend on it: filter, band
//! and sparse factor see the images beyond, and an axis is no border of a window.
//!
//! **Both kinds of load.** Every step keeps the total of the pressure. Under a prescribed penetration the pressure is
//! then scaled until the mean of `v` over it is `D`, which takes no product, and the conjugate directions are conjugate
//! to the pressure, too. With the plain residual `D − v` a stiff coating under the paper's cylinders took eight times
//! the products, because preconditioners answer a uniform residual worst.
//!
//! **Preconditioners.** The reciprocal of the symbol of `K` on the periodic grid, aliases included, whose answer is
//! made to vanish in a narrow band around the set: without aliases or band it takes twice the products. Under a coating
//! more than some twenty times as stiff as its base, four times if the surface is rough, a factorised sparse
//! approximate inverse `Gᵀ G` of the restricted system (Kaporin 1994; Schäfer, Katzfuss and Owhadi 2021), or where the
//! set is small its own Cholesky factor.
//!
//! **Springs.** Where their law is not linear they are straightened at a pressure, and anew as soon as their law has
//! more to say than the linear problem: Newton's method around the loop above, at no product of its own.
//!
//! **Hardness.** Where the pressure is cut, the elements at the limit are held and the loop solves for the others; see
//! `solver/hardness.rs`.
//!
//! **Why it ends.** No accepted fast step raises the energy above the largest of the last few; a step that does not
//! start downhill is replaced by a projection of the plain gradient, which always does. After sixteen exchanges without
//! gain Newton gives way to the descent, which visits no face twice. The number of products is bounded besides, and the
//! best pressure met is returned.
//!
//! **Units.** Everything is computed in the powers of two that the problem's scale sets, so no threshold knows the
//! user's units. Elements beyond the indenter's end are none of the problem: no set takes them in, and no sum.

mod best_pressure;
mod context;
mod load_control;
mod ongoing_solution;
mod preconditioner;
mod springs;
mod state;
mod steps;
mod strategy;
mod working_set;

use self::{
    ongoing_solution::{Judgement, OngoingSolution, Workspace},
    strategy::{Phase, Strategy},
};
use super::{
    Iterate, Solver, SolverOptions, Watch,
    hardness::{self, ElasticSolver},
};
use crate::{ContactError, DiscreteProblem, Identity, Load, vector::sum};

/// The iteration stops at this part of the tolerance, so that rounding between its running residual and the
/// freshly computed certificate cannot decide.
const TOLERANCE_MARGIN: f64 = 0.8;

/// The gradient method; see the module's page.
#[derive(Default)]
pub struct GradientSolver {
    /// How far to go.
    pub options: SolverOptions,
    /// Fields of the last solution, if it ended.
    memory: Option<(Identity, Box<Workspace>)>,
}

impl Solver for GradientSolver {
    fn solve(
        &mut self,
        problem: &mut DiscreteProblem,
        load: Load,
        start: &[f64],
        watch: &mut Watch<'_>,
    ) -> Result<Iterate, ContactError> {
        hardness::solve(self, problem, load, start, watch)
    }
}

impl ElasticSolver for GradientSolver {
    fn options(&mut self) -> &mut SolverOptions {
        &mut self.options
    }

    fn solve_elastic(
        &mut self,
        problem: &mut DiscreteProblem,
        load: Load,
        start: &[f64],
        watch: &mut Watch<'_>,
    ) -> Result<(Iterate, Option<Vec<f64>>), ContactError> {
        let workspace = self.workspace_for(problem);
        let mut solution = OngoingSolution::begin(problem, workspace, load, start);
        let mut strategy = Strategy::new(solution.begins_with_newton());
        let mut residuals = Vec::new();
        let ending = loop {
            let judgement = solution.judge();
            solution.tell(watch, residuals.len(), judgement.residual)?;
            residuals.push(judgement.residual);
            if let Some(ending) = self.ending(&solution, &strategy, judgement) {
                break ending;
            }
            if solution.straighten(&judgement, strategy.phase()) {
                strategy.begin_anew();
            }
            let residual = judgement.linear;
            if !residual.is_finite() {
                // Nothing was left of the pressure, or rounding is all there is: back to the best.
                strategy.descend();
                solution.begin_descent();
                continue;
            }
            let begins_phase = match strategy.phase() {
                Phase::Newton(_) => {
                    strategy.after_newton(residual, solution.newton_step(self.options.tolerance))
                }
                Phase::Descent if solution.knows_operator() => {
                    solution.face_step();
                    false
                }
                Phase::Fast | Phase::Descent => strategy.after_fast(residual, solution.fast_step()),
            };
            if begins_phase {
                solution.begin_phase(&mut strategy);
            }
        };
        let displacement = solution.displacement();
        let stiffness = (ending == Ending::Solved && self.options.contact_stiffness)
            .then(|| solution.contact_stiffness());
        let (contact_stiffness, stiffness_applications) = stiffness.unwrap_or((None, 0));
        let iterate = Iterate {
            iterations: residuals.len() - 1,
            operator_applications: solution.applications(),
            penetration: solution.penetration(),
            residuals,
            contact_stiffness,
            stiffness_applications,
            reached_border: ending == Ending::ReachedBorder,
            ..Iterate::of(solution.best_pressure())
        };
        let workspace = solution.into_workspace();
        self.memory = Some((problem.identity().clone(), workspace));
        Ok((iterate, displacement))
    }
}

/// `dp/dD` (Pa/m) under a solved pressure (Pa) and its force, on the elements that press: the solution of
/// `(K + η) q = 1` there; none where nothing presses or the system does not converge.
pub(crate) fn pressure_per_penetration(
    problem: &mut DiscreteProblem,
    pressure: &[f64],
) -> Option<Vec<f64>> {
    let force = Load::Force(problem.loaded_area() * sum(pressure));
    let workspace = Box::new(Workspace::new(problem));
    OngoingSolution::begin(problem, workspace, force, pressure).pressure_per_penetration()
}

/// Why an iteration stops.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ending {
    Solved,
    GivenUp,
    ReachedBorder,
}

impl GradientSolver {
    /// A solver without memory of any problem.
    #[must_use]
    pub fn new(options: SolverOptions) -> Self {
        Self {
            options,
            memory: None,
        }
    }

    /// Gives back the memory that only another load on the same problem would need.
    pub fn release(&mut self) {
        self.memory = None;
    }

    /// The fields of the previous load on the same problem, or new ones.
    fn workspace_for(&mut self, problem: &DiscreteProblem) -> Box<Workspace> {
        match self.memory.take() {
            Some((of, workspace)) if of == *problem.identity() => workspace,
            _ => Box::new(Workspace::new(problem)),
        }
    }

    fn ending(
        &self,
        solution: &OngoingSolution<'_>,
        strategy: &Strategy,
        judgement: Judgement,
    ) -> Option<Ending> {
        let Judgement {
            residual,
            is_admissible,
            ..
        } = judgement;
        let options = &self.options;
        // A descent that ends in no number would only begin again.
        let is_lost = residual.is_infinite() && strategy.phase() == Phase::Descent;
        if solution.reaches_border() {
            Some(Ending::ReachedBorder)
        } else if is_admissible && residual <= TOLERANCE_MARGIN * options.tolerance {
            Some(Ending::Solved)
        } else {
            (is_lost || solution.applications() >= options.max_applications)
                .then_some(Ending::GivenUp)
        }
    }
}

#[cfg(test)]
mod tests;
