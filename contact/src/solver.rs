//! Solvers of one grid's complementarity problem, behind one interface.

pub mod active_set;
pub mod gradient;
mod hardness;
pub mod observer;

use crate::{ContactError, DiscreteProblem, Load, Observer, Progress, Signal};

/// The algorithm for a grid's problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Preconditioned projected gradients with FFT products: any grid.
    #[default]
    Gradient,
    /// The paper's active set on the dense system, completed: small grids, to rounding.
    ActiveSet,
}

/// Most elements per side of the active set: the matrix of all 80⁴ pairs takes 0.33 GB.
const LARGEST_ACTIVE_SET_GRID: usize = 80;

impl Method {
    /// Refuses a grid of `elements` per side whose dense matrix would not fit.
    fn check_size(self, elements: usize) -> Result<(), ContactError> {
        let largest = LARGEST_ACTIVE_SET_GRID;
        if self == Self::Gradient || elements <= largest {
            Ok(())
        } else {
            Err(ContactError::TooLargeForActiveSet { elements, largest })
        }
    }
}

/// How to solve. The defaults certify to 1e-8.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolverOptions {
    /// Bound on every line of the certificate.
    pub tolerance: f64,
    /// The algorithm.
    pub method: Method,
    /// Products with `K` on one grid level after which a solver gives up and returns its best iterate.
    pub max_applications: usize,
    /// Whether to find the contact stiffness `dQ/dD` of each solution, by one more linear system.
    pub contact_stiffness: bool,
    /// Whether a path solves on a quadrant or a half of problems that are symmetric in x and y, or in y alone, with an
    /// even number of elements per side. The gradient method only; the solution is the same to rounding, in a third to
    /// two thirds of the time.
    pub mirror_symmetry: bool,
    /// Whether the steps of a path keep the pressures of its coarser grids, from which
    /// [`stress_extremes`](crate::stress_extremes) tells how far its numbers can be trusted.
    pub coarse_pressures: bool,
    /// Hardness of the surface, in Pa, at which a path cuts the pressure; infinite if nothing does. A solver of one
    /// grid's problem reads that of the [problem](DiscreteProblem::hardness).
    pub hardness: f64,
}

impl Default for SolverOptions {
    fn default() -> Self {
        Self {
            tolerance: 1e-8,
            method: Method::Gradient,
            max_applications: 2000,
            contact_stiffness: true,
            mirror_symmetry: true,
            coarse_pressures: false,
            hardness: f64::INFINITY,
        }
    }
}

impl SolverOptions {
    /// Checks the tolerance and the hardness, and that the method can solve a grid of `elements` per side.
    ///
    /// # Errors
    /// [`ContactError::Tolerance`] unless it lies in (0, 0.1]; [`ContactError::Hardness`] unless it is positive;
    /// [`ContactError::TooLargeForActiveSet`].
    pub fn checked_for(self, elements: usize) -> Result<Self, ContactError> {
        let tolerance = self.tolerance;
        if !(tolerance > 0.0 && tolerance <= 0.1) {
            return Err(ContactError::Tolerance { tolerance });
        }
        let hardness = self.hardness;
        // False where it is NaN.
        let is_positive = hardness > 0.0;
        if !is_positive {
            return Err(ContactError::Hardness { hardness });
        }
        self.method.check_size(elements)?;
        Ok(self)
    }
}

/// A pressure that a solver ended with, and the work it took. Whether it solves the problem, only a
/// [`Certificate`](crate::Certificate) says.
#[derive(Debug, Clone, PartialEq)]
pub struct Iterate {
    /// Pressure, in Pa; N² values, all ≥ 0.
    pub pressure: Vec<f64>,
    /// Iterations.
    pub iterations: usize,
    /// Products with `K`.
    pub operator_applications: usize,
    /// Largest line of the certificate at each iteration, by the iteration's own residual.
    pub residuals: Vec<f64>,
    /// Contact stiffness `dQ/dD`, in N/m, where it was asked for and found.
    pub contact_stiffness: Option<f64>,
    /// Products with `K` for the contact stiffness, beside the others.
    pub stiffness_applications: usize,
    /// The penetration by the solver's own account, in m; infinite where it gives none. It decides how far around the
    /// contact the certificate looks first.
    pub penetration: f64,
    /// Whether the solver stopped because the contact reached the border of a window of a larger grid.
    pub reached_border: bool,
}

impl Iterate {
    /// A pressure (Pa; N² values, all ≥ 0) without any work or residual.
    #[must_use]
    pub fn of(pressure: Vec<f64>) -> Self {
        Self {
            pressure,
            iterations: 0,
            operator_applications: 0,
            residuals: Vec::new(),
            contact_stiffness: None,
            stiffness_applications: 0,
            penetration: f64::INFINITY,
            reached_border: false,
        }
    }
}

/// One algorithm for one grid's problem.
///
/// A solver may keep what it allocated for the load before, if the [identity](DiscreteProblem::identity) says that the
/// problem is the same; the solution must not depend on it. Whatever it returns is judged by a
/// [`Certificate`](crate::Certificate).
pub trait Solver {
    /// Solves from the pressure `start` (N² values, in Pa; all zero for a cold start).
    ///
    /// # Errors
    /// [`ContactError::Cancelled`] by the observer; a matrix that is not positive definite. A tolerance not met is
    /// no error here: the iterate is returned and judged by its certificate.
    fn solve(
        &mut self,
        problem: &mut DiscreteProblem,
        load: Load,
        start: &[f64],
        watch: &mut Watch<'_>,
    ) -> Result<Iterate, ContactError>;
}

/// The observer of a whole loading path, with the place of the present solution in it.
pub struct Watch<'a> {
    /// Who watches.
    pub observer: &'a mut dyn Observer,
    /// Loading step under way, counted from 0.
    pub step: usize,
    /// Loading steps finished.
    pub finished: usize,
    /// Number of loading steps.
    pub steps: usize,
}

impl<'a> Watch<'a> {
    /// Watches a single solution that belongs to no path.
    pub fn alone(observer: &'a mut dyn Observer) -> Self {
        Self {
            observer,
            step: 0,
            finished: 0,
            steps: 1,
        }
    }
}

impl Watch<'_> {
    /// Tells the observer where the solution on a grid of `elements` per side stands; of the working set, its elements
    /// and how many of them are new or gone.
    ///
    /// # Errors
    /// [`ContactError::Cancelled`] if the observer cancels.
    pub fn tell(
        &mut self,
        elements: usize,
        iteration: usize,
        residual: f64,
        [working_set, working_set_change]: [usize; 2],
    ) -> Result<(), ContactError> {
        let Self {
            step,
            finished,
            steps,
            ..
        } = *self;
        match self.observer.progress(&Progress {
            step,
            finished,
            steps,
            elements,
            iteration,
            residual,
            working_set,
            working_set_change,
        }) {
            Signal::Continue => Ok(()),
            Signal::Cancel => Err(ContactError::Cancelled { step }),
        }
    }
}

#[cfg(test)]
mod tests;
