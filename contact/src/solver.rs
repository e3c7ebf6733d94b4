//! Solvers for the complementarity problem on one grid, behind one interface.

pub mod active_set;
mod exchange;
pub mod gradient;
mod hardness;
pub mod observer;
mod shortcuts;

pub use self::shortcuts::Shortcuts;

use crate::{ContactError, DiscreteProblem, Load, Observer, Progress, Signal};

/// The algorithm that solves the problem on a grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Preconditioned projected gradients with FFT products, for any grid.
    #[default]
    Gradient,
    /// The paper's active set on the dense system, completed; for small grids, accurate to rounding.
    ActiveSet,
}

/// Most elements per side for the active set: the matrix of all 80⁴ pairs takes 0.33 GB.
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

/// The solver's options. The defaults certify to 1e-8.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolverOptions {
    /// Bound on every line of the certificate.
    pub tolerance: f64,
    /// The algorithm.
    pub method: Method,
    /// Products with `K` on one grid level after which a solver gives up and returns its best iterate.
    pub max_applications: usize,
    /// Whether to compute the contact stiffness `dQ/dD` of each solution, by one more linear system.
    pub contact_stiffness: bool,
    /// Whether a path solves on a quadrant or a half of problems that are symmetric in x and y, or in y alone, with an
    /// even number of elements per side. For the gradient method only. The solution is the same to rounding, in a third
    /// to two thirds of the time.
    pub mirror_symmetry: bool,
    /// Whether the steps of a path keep the pressures of its coarser grids, from which
    /// [`stress_extremes`](crate::stress_extremes) estimates the accuracy of its results.
    pub coarse_pressures: bool,
    /// Hardness of the surface, in Pa, at which a path limits the pressure; infinite for no limit. A solver of one
    /// grid's problem uses the [problem's](DiscreteProblem::hardness) instead.
    pub hardness: f64,
    /// Diameter, in m, of the disc over which a path averages the pressure for the
    /// [largest averaged one](crate::Summary::max_averaged_pressure); none for no average.
    pub averaging_length: Option<f64>,
    /// What spares work without changing the solution.
    pub shortcuts: Shortcuts,
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
            averaging_length: None,
            shortcuts: Shortcuts::ALL,
        }
    }
}

impl SolverOptions {
    /// Checks the tolerance, the hardness, and that the method can solve a grid of `elements` per side.
    ///
    /// # Errors
    /// [`ContactError::Tolerance`] unless the tolerance lies in (0, 0.1]; [`ContactError::Hardness`] unless the
    /// hardness is positive; [`ContactError::TooLargeForActiveSet`].
    pub fn checked_for(self, elements: usize) -> Result<Self, ContactError> {
        let tolerance = self.tolerance;
        if !(tolerance > 0.0 && tolerance <= 0.1) {
            return Err(ContactError::Tolerance { tolerance });
        }
        let hardness = self.hardness;
        // False for NaN.
        let is_positive = hardness > 0.0;
        if !is_positive {
            return Err(ContactError::Hardness { hardness });
        }
        self.method.check_size(elements)?;
        Ok(self)
    }
}

/// The final pressure of a solver, and the work it took. Only a [`Certificate`](crate::Certificate) shows whether it
/// solves the problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Iterate {
    /// Pressure, in Pa; N² values, all ≥ 0.
    pub pressure: Vec<f64>,
    /// Iterations.
    pub iterations: usize,
    /// Products with `K`.
    pub operator_applications: usize,
    /// Largest line of the certificate at each iteration, according to the iteration's own residual.
    pub residuals: Vec<f64>,
    /// Contact stiffness `dQ/dD`, in N/m, if requested and found.
    pub contact_stiffness: Option<f64>,
    /// Additional products with `K` for the contact stiffness.
    pub stiffness_applications: usize,
    /// The penetration according to the solver, in m; infinite if the solver gives none. It decides how far around the
    /// contact the certificate checks first.
    pub penetration: f64,
    /// Whether the solver stopped because the contact reached the border of a region.
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

/// An algorithm for the problem on one grid.
///
/// A solver may keep the storage of the previous load if the [identity](DiscreteProblem::identity) shows that the
/// problem is the same; the solution must not depend on it. A [`Certificate`](crate::Certificate) judges every result.
pub trait Solver {
    /// Solves from the pressure `start` (N² values, in Pa; all zero for a cold start).
    ///
    /// # Errors
    /// [`ContactError::Cancelled`] if the observer cancels; an error if a matrix is not positive definite. Missing the
    /// tolerance is not an error here: the iterate is returned and judged by its certificate.
    fn solve(
        &mut self,
        problem: &mut DiscreteProblem,
        load: Load,
        start: &[f64],
        watch: &mut Watch<'_>,
    ) -> Result<Iterate, ContactError>;
}

/// A solver that can also leave out the limit on the pressure, for the exchanges at a hardness.
pub(crate) trait ElasticSolver: Solver {
    /// The solver's options.
    fn options(&mut self) -> &mut SolverOptions;

    /// Solves without a limit on the pressure; also returns its `K p` (m) if that is known without a product.
    fn solve_elastic(
        &mut self,
        problem: &mut DiscreteProblem,
        load: Load,
        start: &[f64],
        watch: &mut Watch<'_>,
    ) -> Result<(Iterate, Option<Vec<f64>>), ContactError>;
}

/// The observer of a whole loading path, with the position of the current solution in it.
pub struct Watch<'a> {
    /// The observer.
    pub observer: &'a mut dyn Observer,
    /// Loading step under way, counted from 0.
    pub step: usize,
    /// Loading steps finished.
    pub finished: usize,
    /// Number of loading steps.
    pub steps: usize,
}

impl<'a> Watch<'a> {
    /// Watches a single solution outside any path.
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
    /// Reports progress on a grid of `elements` per side to the observer. The last argument holds the size of the
    /// working set and the number of elements that entered or left it.
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
