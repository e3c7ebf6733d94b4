//! The interface that the exchanges require of a solver without a limit.

use crate::{
    ContactError, DiscreteProblem, Iterate, Load, SolverOptions,
    solver::{Solver, Watch},
};

/// A solver of the problem without a limit.
pub trait ElasticSolver: Solver {
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
