//! The interface of a solver without a limit, as the exchanges use it.

use crate::{
    ContactError, DiscreteProblem, Iterate, Load, SolverOptions,
    solver::{Solver, Watch},
};

/// A solver of the problem without a limit.
pub trait ElasticSolver: Solver {
    /// How far it goes.
    fn options(&mut self) -> &mut SolverOptions;

    /// Solves as if nothing limited the pressure; `K p` (m) of it too, where it is known without a product.
    fn solve_elastic(
        &mut self,
        problem: &mut DiscreteProblem,
        load: Load,
        start: &[f64],
        watch: &mut Watch<'_>,
    ) -> Result<(Iterate, Option<Vec<f64>>), ContactError>;
}
