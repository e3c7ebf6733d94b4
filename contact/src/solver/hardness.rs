//! Contact whose pressure is cut at a hardness: exchanges of elements around a solver without a limit.
//!
//! With the hardness `p_max`, the same energy is least among `0 ≤ p ≤ p_max` where
//!
//! ```text
//! p = 0: g ≥ 0        0 < p < p_max: g = 0        p = p_max: g ≤ 0
//! ```
//!
//! The elements of the third kind are held at the limit as a [part of the load](HeldPressure), and the others solve a
//! contact problem without a limit, by any method. Those above the limit then are held as well, and those held that
//! have a gap are let go. It is the semismooth Newton method around the whole solver instead of in its loop: so
//! springs, windows, quadrants, cells and every preconditioner are as they were. Each problem is solved only as far as
//! the exchange before was wrong. An exchange takes two products beside those of the problem: `K p` of the elements
//! held, and of the others as they begin.
//!
//! Until elements are first let go, those above the limit are held together with as many others as carry at the limit
//! what the former lose: those that press most, then those with the narrowest gap. Held ring by ring, random problems
//! without a start took 2.5 to 4 times the products.
//!
//! **Start.** Of a coarser grid's pressure the elements at the limit are held, of a guess those above it; if they carry
//! all of a prescribed force, only those that overlap most. From no element held, a fully plastic contact took five to
//! seven times the products, a ring of elements an exchange.
//!
//! **Why it ends.** After four exchanges without gain they give way to a [descent](self::descent), whose energy falls
//! from one admissible pressure to the next. The number of products is bounded besides, and the certificate tells.
//!
//! **Cost.** Random problems without a start take some 30 products, of which some 14 are for the problem
//! without a limit.
//!
//! **Penetration under a force.** `D` is the multiplier of the elements between the limits, `Σ p v / Σ p` over
//! `0 < p < p_max`. Where there is none, because the elements held carry the force to the last digits, every `D` from
//! the largest `v` of those held to the least of the others solves the problem: the least is taken.

mod descent;
mod elastic_solver;
mod limit_exchange;

pub use self::elastic_solver::ElasticSolver;
use self::limit_exchange::LimitExchange;
use super::{Iterate, Watch};
use crate::{ContactError, DiscreteProblem, Load};

/// Part of the tolerance to which the problems are solved: should one of two elements that differ by twice a residual
/// come to the limit by a rounding, the other alone says how deep the indenter is.
const CLOSER: f64 = 0.5;

/// Solves a problem, by exchanges where it has a hardness.
pub fn solve(
    solver: &mut impl ElasticSolver,
    problem: &mut DiscreteProblem,
    load: Load,
    start: &[f64],
    watch: &mut Watch<'_>,
) -> Result<Iterate, ContactError> {
    if !problem.has_hardness() {
        return (solver.solve_elastic(problem, load, start, watch)).map(|(iterate, _)| iterate);
    }
    match problem.check_capacity(load) {
        // A larger window may carry it.
        Err(_) if problem.is_window() => {
            return Ok(Iterate {
                reached_border: true,
                ..Iterate::of(start.to_vec())
            });
        }
        carried => carried?,
    }
    let wanted = *solver.options();
    let tolerance = CLOSER * wanted.tolerance;
    let mut exchange = LimitExchange::start(problem, load, start, tolerance);
    let iterate = loop {
        exchange.press(problem);
        *solver.options() = exchange.options(wanted);
        let found = exchange.solve(solver, problem, watch);
        *solver.options() = wanted;
        let (iterate, displacement) = found?;
        let reached_border = exchange.take(iterate);
        let is_spent = exchange.total.operator_applications >= wanted.max_applications;
        if reached_border || is_spent {
            break exchange.into_iterate(problem.hardness());
        }
        let displacement = exchange.displacement(problem, displacement);
        if !exchange.advance(problem, &displacement) {
            break exchange.into_iterate(problem.hardness());
        }
    };
    Ok(iterate)
}

#[cfg(test)]
mod tests;
