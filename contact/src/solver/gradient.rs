//! Preconditioned projected gradients: for any grid, one product with `K` per step.
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
//! The method of Polonsky and Keer (1999) is the projected form of the fast steps, with conjugate steps throughout and
//! no preconditioner. Vollebregt (2014) and Rey, Anciaux and Molinari (2017) precondition in Fourier space; Bugnicourt,
//! Sainsot and Lubrecht (2018) apply conjugate gradients to a contact whose set changes. The differences here: spectral
//! steps until the set is found, because a conjugate direction is useless on another set; an exact line search only
//! where the energy would rise; starts that respect the outline of the relief; products on the smallest square that
//! holds the contact.
//!
//! **Sectors.** Where indenter and relief are symmetric in x and y, so is the unique solution, and a path solves only
//! on the quadrant x, y > 0: `K` is the sum over an element's four images, applied by cosine transforms of half the
//! length. All sums are a quarter of those on the whole grid. Where they are symmetric in y alone, as under a pyramid
//! of three faces, it solves on the half y > 0. Only operators that reach across the axes depend on the sector: filter,
//! band and sparse factor include the images beyond, and an axis is not a border of a region.
//!
//! **Both kinds of load.** Every step preserves the total pressure. Under a prescribed penetration the pressure is then
//! scaled until the mean of `v` weighted by it is `D`, which takes no product, and the conjugate directions are
//! conjugate to the pressure, too. With the plain residual `D − v` a stiff coating under the paper's cylinders took
//! eight times the products, because preconditioners are least accurate for a uniform residual.
//!
//! **Preconditioners.** The default is the reciprocal of the symbol of `K` on the periodic grid, aliases included,
//! whose result is forced to vanish in a narrow band around the set, and beyond a border that the contact reaches:
//! without aliases or band it takes twice the products. Under a coating more than about twenty times as stiff as its
//! base, or four times if the surface is rough, it is a factorised sparse approximate inverse `Gᵀ G` of the restricted
//! system (Kaporin 1994; Schäfer, Katzfuss and Owhadi 2021), or for a small set the Cholesky factor of that system.
//!
//! **Springs.** Nonlinear springs are linearised at a pressure, and again as soon as the residual by their law clearly
//! exceeds that of the linear problem: Newton's method around the loop above, without additional products.
//!
//! **Hardness.** Elements at the hardness are held there and the loop solves for the others; see `solver/hardness.rs`.
//!
//! **Why it ends.** No accepted fast step raises the energy above the largest of the last few. A step that does not
//! start downhill is replaced by a projection of the plain gradient, which always does. After sixteen exchanges without
//! progress Newton's method is replaced by the descent, which visits no face twice. The number of products is also
//! bounded, and the best pressure found is returned.
//!
//! **Units.** All quantities are scaled by powers of two from the problem's scale, so no threshold depends on the
//! user's units. Elements beyond the edge of the indenter are excluded from all sets and sums.

mod best_pressure;
mod conjugate_gradients;
mod iteration;
mod load_control;
mod preconditioner;
mod springs;
mod state;
mod steps;
mod strategy;
mod working_set;

use self::{
    iteration::{Fields, Iteration, Judgement},
    strategy::{Phase, Strategy},
};
use super::{ElasticSolver, Iterate, Shortcuts, Solver, SolverOptions, Watch, hardness};
use crate::{ContactError, DiscreteProblem, Identity, Load, vector::sum};

/// The iteration stops at this fraction of the tolerance, so that rounding differences between its running residual and
/// the newly computed certificate do not matter.
const TOLERANCE_MARGIN: f64 = 0.8;

/// The gradient method; see the module documentation.
#[derive(Default)]
pub struct GradientSolver {
    /// The solver's options.
    pub options: SolverOptions,
    /// Fields of the last completed solution.
    memory: Option<(Identity, Box<Fields>)>,
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
        let fields = self.fields_for(problem);
        let mut iteration = Iteration::begin(problem, fields, load, start);
        let mut strategy = Strategy::new(iteration.begins_with_newton(), iteration.most_cuts());
        let mut residuals = Vec::new();
        let ending = loop {
            let judgement = iteration.judge();
            iteration.report(watch, residuals.len(), judgement.residual)?;
            residuals.push(judgement.residual);
            if let Some(ending) = self.ending(&iteration, &strategy, judgement) {
                break ending;
            }
            if iteration.linearise(&judgement, strategy.phase()) {
                strategy.restart();
            }
            let residual = judgement.linear;
            if !residual.is_finite() {
                // No pressure is left, or only rounding: return to the best pressure.
                strategy.descend();
                iteration.begin_descent();
                continue;
            }
            let outcome = match strategy.phase() {
                Phase::Newton(_) => iteration.newton_step(self.options.tolerance),
                Phase::Descent if iteration.knows_operator() => iteration.face_step(),
                Phase::Fast | Phase::Descent => iteration.fast_step(),
            };
            if strategy.changes_phase(residual, outcome) {
                iteration.begin_phase(&mut strategy);
            }
        };
        let displacement = iteration.displacement();
        let stiffness = (ending == Ending::Solved && self.options.contact_stiffness)
            .then(|| iteration.contact_stiffness());
        let (contact_stiffness, stiffness_applications) = stiffness.unwrap_or((None, 0));
        let iterate = Iterate {
            iterations: residuals.len() - 1,
            operator_applications: iteration.applications(),
            penetration: iteration.penetration(),
            residuals,
            contact_stiffness,
            stiffness_applications,
            reached_border: ending == Ending::ReachedBorder,
            ..Iterate::of(iteration.best_pressure())
        };
        let fields = iteration.into_fields();
        self.memory = Some((problem.identity().clone(), fields));
        Ok((iterate, displacement))
    }
}

/// Computes `dp/dD` (Pa/m) at a solved pressure (Pa) and its force, on the elements that press: the solution of
/// `(K + η) q = 1` there. Returns none if no element presses or the system does not converge.
pub(crate) fn pressure_per_penetration(
    problem: &mut DiscreteProblem,
    pressure: &[f64],
) -> Option<Vec<f64>> {
    let force = Load::Force(problem.loaded_area() * sum(pressure));
    let fields = Box::new(Fields::new(problem, Shortcuts::ALL));
    Iteration::begin(problem, fields, force, pressure).pressure_per_penetration()
}

/// Why an iteration stops.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ending {
    Solved,
    GivenUp,
    ReachedBorder,
}

impl GradientSolver {
    /// Creates a solver without stored fields.
    #[must_use]
    pub fn new(options: SolverOptions) -> Self {
        Self {
            options,
            memory: None,
        }
    }

    /// Frees the fields kept for the next load on the same problem.
    pub fn release(&mut self) {
        self.memory = None;
    }

    /// The fields of the previous load on the same problem, or new ones.
    fn fields_for(&mut self, problem: &DiscreteProblem) -> Box<Fields> {
        match self.memory.take() {
            Some((of, fields)) if of == *problem.identity() && self.options.shortcuts.memory => {
                fields
            }
            _ => Box::new(Fields::new(problem, self.options.shortcuts)),
        }
    }

    fn ending(
        &self,
        iteration: &Iteration<'_>,
        strategy: &Strategy,
        judgement: Judgement,
    ) -> Option<Ending> {
        let Judgement {
            residual,
            is_admissible,
            ..
        } = judgement;
        let options = &self.options;
        // A descent with a non-finite residual would only start again.
        let cannot_descend = residual.is_infinite() && strategy.phase() == Phase::Descent;
        if iteration.reaches_border() {
            Some(Ending::ReachedBorder)
        } else if is_admissible && residual <= TOLERANCE_MARGIN * options.tolerance {
            Some(Ending::Solved)
        } else {
            (cannot_descend || iteration.applications() >= options.max_applications)
                .then_some(Ending::GivenUp)
        }
    }
}

#[cfg(test)]
mod tests;
