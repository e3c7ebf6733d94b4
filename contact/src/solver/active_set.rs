//! The paper's active set on the dense system, extended so that elements can also return to the set.
//!
//! The paper solves the linear system of the elements in contact and drops those that pull, until none does. This may
//! drop an element that belongs to the contact and end with overlap. Here each iteration exchanges both ways: it drops
//! elements with `p < 0` and adds those with `g < 0` (block principal pivoting; Kostreva 1978, Júdice and Pires 1994).
//!
//! **Why it ends.** Full exchanges continue while they lower the number of infeasible elements below its smallest value
//! so far; a few failures are allowed. After that the method descends: from an admissible pressure it moves towards the
//! solution on the working set until an element would pull, and drops that element. Only at the minimum on a set does
//! it add the element with the largest overlap. The energy decreases strictly from minimum to minimum, so no set occurs
//! twice (Nocedal and Wright 2006, section 16.5).
//!
//! Nonlinear springs are linearised at each solution: an outer Newton iteration.

mod dense_system;
mod set_exchange;
mod springs;

use self::{
    dense_system::{DenseSystem, SetSolution},
    set_exchange::SetExchange,
    springs::DenseSprings,
};
use super::{ElasticSolver, Iterate, Method, Solver, SolverOptions, Watch, hardness};
use crate::{ContactError, DiscreteProblem, Load};

/// The active-set method; see the module documentation.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ActiveSetSolver {
    /// The tolerance has no effect here: the system on the final set is solved to rounding.
    pub options: SolverOptions,
}

impl Solver for ActiveSetSolver {
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

impl ElasticSolver for ActiveSetSolver {
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
        Method::ActiveSet.check_size(problem.region().grid_size())?;
        let mut system = DenseSystem::new(problem, load);
        let mut residuals = Vec::new();
        let mut solution = self.solve_linear(&system, start, &mut residuals, watch)?;
        let Some(mut springs) = DenseSprings::of(problem) else {
            return Ok((solution.into_iterate(residuals), None));
        };
        while springs.linearise(&mut system, &solution) {
            let start = springs.pressure().to_vec();
            solution = self.solve_linear(&system, &start, &mut residuals, watch)?;
            if residuals.len() > self.options.max_applications {
                break;
            }
        }
        Ok((solution.into_iterate(residuals), None))
    }
}

impl ActiveSetSolver {
    /// Exchanges elements until the set is right or the iteration limit is reached.
    fn solve_linear(
        &self,
        system: &DenseSystem,
        start: &[f64],
        residuals: &mut Vec<f64>,
        watch: &mut Watch<'_>,
    ) -> Result<SetSolution, ContactError> {
        let mut exchange = SetExchange::start(system, start);
        let mut before = Vec::new();
        loop {
            let members = exchange.members();
            let trial = system.solve_on(members)?;
            let working_set = [members.len(), moves(&before, members)];
            watch.tell(
                system.size(),
                residuals.len(),
                trial.residual(),
                working_set,
            )?;
            residuals.push(trial.residual());
            let given_up = residuals.len() > self.options.max_applications;
            if trial.infeasible.is_empty() || given_up {
                return Ok(trial);
            }
            before = members.to_vec();
            exchange.advance(system, &trial);
        }
    }
}

/// Number of elements that are in only one of two ascending sets.
fn moves(before: &[usize], after: &[usize]) -> usize {
    let stayed = after.iter().filter(|e| before.binary_search(e).is_ok());
    before.len() + after.len() - 2 * stayed.count()
}

#[cfg(test)]
mod tests {
    #[test]
    fn moves_count_the_elements_that_entered_and_those_that_left() {
        for (before, after, moves) in [
            (&[][..], &[3, 5][..], 2),
            (&[3, 5], &[], 2),
            (&[1, 2, 9], &[2, 3, 9, 11], 3),
            (&[1, 2], &[1, 2], 0),
        ] {
            assert_eq!(super::moves(before, after), moves);
        }
    }
}
