//! The paper's active set on the dense system, completed so that it also takes elements back in.
//!
//! The paper solves the linear system of the elements in contact and drops those that pull, until none does. That
//! may drop an element that belongs to the contact, and end in a state with overlap. Here each iteration exchanges
//! both ways: drops `p < 0` and takes in `g < 0` (block principal pivoting; Kostreva 1978, Júdice and Pires 1994).
//!
//! **Why it ends.** A full exchange is kept while it lowers the number of infeasible elements below the lowest so
//! far, with a few attempts of grace. After that the method descends: from an admissible pressure it moves
//! towards the solution on the working set until an element would pull, drops that one, and takes in the element
//! with the largest overlap only at the minimum of a set. The energy falls strictly from minimum to minimum, so no
//! set occurs twice (Nocedal and Wright 2006, section 16.5).

mod dense_system;
mod exchange;

use self::{dense_system::DenseSystem, exchange::Exchange};
use super::{Iterate, Solver, SolverOptions, Watch};
use crate::{ContactError, DiscreteProblem, Load};

/// Most elements per side: the matrix of all 80⁴ pairs takes 0.33 GB.
pub const LARGEST_ACTIVE_SET_GRID: usize = 80;

/// Refuses a grid whose dense matrix would not fit.
pub(super) fn check_size(elements: usize) -> Result<(), ContactError> {
    let largest = LARGEST_ACTIVE_SET_GRID;
    if elements <= largest {
        Ok(())
    } else {
        Err(ContactError::TooLargeForActiveSet { elements, largest })
    }
}

/// The active-set method; see the module's page.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ActiveSetSolver {
    /// Its tolerance decides nothing here: the method ends with a set, solved to rounding.
    pub options: SolverOptions,
}

impl Solver for ActiveSetSolver {
    fn solve(
        &self,
        problem: &mut DiscreteProblem,
        load: Load,
        start: &[f64],
        watch: &mut Watch<'_>,
    ) -> Result<Iterate, ContactError> {
        let size = problem.size();
        check_size(size)?;
        let system = DenseSystem::new(problem, load);
        let mut exchange = Exchange::start(&system, start);
        let mut residuals = Vec::new();
        loop {
            let trial = system.solve_on(exchange.members())?;
            watch.tell(
                size,
                residuals.len(),
                trial.residual(),
                exchange.members().len(),
            )?;
            residuals.push(trial.residual());
            let given_up = residuals.len() > self.options.max_applications;
            if trial.infeasible.is_empty() || given_up {
                let iterations = residuals.len();
                let pressure = trial.into_admissible_pressure();
                return Ok(Iterate {
                    pressure,
                    iterations,
                    operator_applications: 1,
                    residuals,
                    contact_stiffness: None,
                    stiffness_applications: 0,
                    reached_border: false,
                });
            }
            exchange.advance(&system, &trial);
        }
    }
}
