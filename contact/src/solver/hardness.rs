//! Contact with the pressure limited to a hardness: exchanges of elements around a solver without a limit.
//!
//! With the hardness `p_max`, the solution minimises the same energy over `0 ≤ p ≤ p_max`, where
//!
//! ```text
//! p = 0: g ≥ 0        0 < p < p_max: g = 0        p = p_max: g ≤ 0
//! ```
//!
//! Elements of the third kind are held at the limit as a part of the load (`HeldPressure`), and a contact problem
//! without a limit is solved for the others, by any method. Those that then exceed the limit are held as well, and held
//! elements with a gap are released. This is the semismooth Newton method around the whole solver rather than inside
//! its loop, so springs, all kinds of supports and all preconditioners stay unchanged. The accuracy of each problem is
//! set by the error of the previous exchange. An exchange takes two products in addition to those of the problem: `K p`
//! of the held elements, and of the others at the start.
//!
//! As many others are held with those above the limit as are needed to carry the excess at the limit: those with the
//! largest pressure, then those with the smallest gap. Held ring by ring, random problems take two to three times the
//! products. None are added in an exchange that releases elements, when the excess is no measure of what is missing,
//! and only once more after a release, or elements are held and released in turn. Under a force, few elements are
//! released where few others carry: the penetration rests on these.
//!
//! **Start.** From a coarser grid's pressure the elements at the limit are held, from a guess those above the limit; if
//! they carry all of a prescribed force, only those that overlap most. Starting with no element held, a fully plastic
//! contact took five to seven times the products, one ring of elements per exchange.
//!
//! **Where exchanges go wrong.** If an element exceeds the limit many times over when no others may be held, or after
//! four exchanges that release elements without halving the error, springs are added to all elements and harden in
//! stages; see [continuation]. If the exchanges stall again, the [descent] takes over.
//!
//! **Why it ends.** Exchanges that release no element end, since each holds more. Those that release some stall at most
//! twice, and each step of the descent lowers the energy. The number of products is also bounded, and the certificate
//! judges the result.
//!
//! **Cost.** Random problems without a start take about 30 products, of which about 14 are for the problem without a
//! limit.
//!
//! **Penetration under a force.** `D` is the multiplier of the elements between the limits, `Σ p v / Σ p` over
//! `0 < p < p_max`. If there are none, because the held elements carry the force to the last digits, every `D` from the
//! largest `v` of those held to the smallest `v` of the others solves the problem: the smallest is taken.

mod continuation;
mod descent;
mod limit_exchange;
mod wrong_side;

use self::limit_exchange::LimitExchange;
use super::{ElasticSolver, Iterate, SolverOptions, Watch};
use crate::{ContactError, DiscreteProblem, Load};

/// Fraction of the tolerance to which the problems are solved. If rounding brings one of two elements that differ by
/// twice a residual to the limit, the other alone determines the penetration.
const TOLERANCE_FRACTION: f64 = 0.5;

/// Solves a problem, by exchanges if it has a hardness.
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
        // A larger support may carry it.
        Err(_) if problem.support().may_grow() => {
            return Ok(Iterate {
                reached_border: true,
                ..Iterate::of(start.to_vec())
            });
        }
        carried => carried?,
    }
    let wanted = *solver.options();
    let tolerance = TOLERANCE_FRACTION * wanted.tolerance;
    let exchange = LimitExchange::start(problem, load, start, tolerance);
    let found = exchange_until_solved(solver, problem, exchange, wanted, watch);
    problem.soften(0.0);
    found
}

/// Exchanges until no element is on the wrong side or the products run out.
fn exchange_until_solved(
    solver: &mut impl ElasticSolver,
    problem: &mut DiscreteProblem,
    mut exchange: LimitExchange,
    wanted: SolverOptions,
    watch: &mut Watch<'_>,
) -> Result<Iterate, ContactError> {
    loop {
        exchange.press(problem);
        *solver.options() = exchange.options(wanted);
        let found = exchange.solve(solver, problem, watch);
        *solver.options() = wanted;
        let (iterate, displacement) = found?;
        let reached_border = exchange.take(iterate);
        let is_exhausted = exchange.total.operator_applications >= wanted.max_applications;
        if reached_border || is_exhausted {
            return Ok(exchange.into_iterate(problem.hardness()));
        }
        let displacement = exchange.displacement(problem, displacement);
        if !exchange.advance(problem, &displacement) {
            return Ok(exchange.into_iterate(problem.hardness()));
        }
    }
}

#[cfg(test)]
mod tests;
