//! Contact whose pressure is cut at a hardness: exchanges of elements around a solver without a limit.
//!
//! With the hardness `p_max`, the same energy is least among `0 ≤ p ≤ p_max` where
//!
//! ```text
//! p = 0: g ≥ 0        0 < p < p_max: g = 0        p = p_max: g ≤ 0
//! ```
//!
//! The elements of the third kind are held at the limit as a [part of the load](HeldPressure), and the others solve a
//! contact problem without a limit, by any method. Those above the limit then are held as well, until none is; then
//! those held that have a gap are let go. It is the semismooth Newton method around the whole solver instead of in its
//! loop: so springs, windows, quadrants, cells and every preconditioner are as they were. Each problem is solved only
//! as far as the exchange before was wrong.
//!
//! Until elements are first let go, those above the limit are held together with as many others as carry at the limit
//! what the former lose: those that press most, then those with the narrowest gap. Held ring by ring, random problems
//! without a start took 2.5 to 4 times the products.
//!
//! **Start.** Of a coarser grid's pressure the elements at the limit are held, of a guess those above it; if they carry
//! all of a prescribed force, only those that overlap most. From no element held, a fully plastic contact took five to
//! seven times the products, a ring of elements an exchange.
//!
//! **Why it ends.** Holding ends, since no element is let go meanwhile. If the number of elements with a gap at its end
//! has not fallen, fewer are let go at once, down to the one with the widest gap. That is no proof: the number of
//! products is bounded besides, and the certificate tells. Of 3000 random problems two are not certified after 2000
//! products, both on a coat four million times as stiff as what is under it (`tests/random_problems.rs`), and of 2000
//! rough ones perhaps one (`tests/random_rough.rs`).
//!
//! **Penetration under a force.** `D` is the multiplier of the elements between the limits, `Σ p v / Σ p` over
//! `0 < p < p_max`. Where there is none, because the elements held carry the force to the last digits, every `D` from
//! the largest `v` of those held to the least of the others solves the problem: the least is taken.

use super::{Iterate, Solver, SolverOptions, Watch};
use crate::{ContactError, DiscreteProblem, Load, problem::held_pressure::HeldPressure};

/// Largest residual to which a problem between exchanges is solved.
const COARSEST: f64 = 1e-2;
/// Residual of the next problem, as a part of what the last exchange was wrong by.
const REFINEMENT: f64 = 0.03;
/// Gap of a held element that does not count, as a part of the residual solved to.
const SLACK: f64 = 0.5;
/// Halvings after which single elements are let go, on any grid.
const MOST_CAUTION: u32 = 31;
/// Part of the limit from which on an element of a start is held.
const NEAR: f64 = 0.95;
/// Part of a force that the elements held at a start may carry.
const LARGEST_SHARE: f64 = 0.97;
/// Part of a force that is rounding of what the held elements carry.
const ROUNDING: f64 = 1e-13;

/// By how much, as a part of the limit, a pressure may exceed it that is then cut to it: rounding, by which an element
/// was held and let go by turns.
const ABOVE: f64 = 1e-13;

/// Part of the tolerance to which the problems are solved: should one of two elements that differ by twice a residual
/// come to the limit by a rounding, the other alone says how deep the indenter is.
const CLOSER: f64 = 0.5;

/// A solver of the problem without a limit.
pub trait ElasticSolver: Solver {
    /// How far it goes.
    fn options(&mut self) -> &mut SolverOptions;

    /// Solves as if nothing limited the pressure.
    fn solve_elastic(
        &mut self,
        problem: &mut DiscreteProblem,
        load: Load,
        start: &[f64],
        watch: &mut Watch<'_>,
    ) -> Result<Iterate, ContactError>;
}

/// Solves a problem with a hardness.
pub fn solve(
    solver: &mut impl ElasticSolver,
    problem: &mut DiscreteProblem,
    load: Load,
    start: &[f64],
    watch: &mut Watch<'_>,
) -> Result<Iterate, ContactError> {
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
    let mut exchange = Exchange::start(problem, load, start, tolerance);
    let iterate = loop {
        exchange.press(problem);
        *solver.options() = exchange.options(wanted);
        let found = exchange.solve(solver, problem, load, watch);
        *solver.options() = wanted;
        let reached_border = exchange.take(found?);
        let is_spent = exchange.total.operator_applications >= wanted.max_applications;
        if reached_border || is_spent || !exchange.advance(problem, load, tolerance) {
            break exchange.into_iterate(problem.hardness());
        }
    };
    Ok(iterate)
}

/// Which elements are held, and the pressure of the others.
struct Exchange {
    held: HeldPressure,
    /// Whether `held` is pressed as it stands.
    is_pressed: bool,
    /// Pressure of the elements that are not held, in Pa.
    free: Vec<f64>,
    /// Residual to solve to.
    accuracy: f64,
    /// The work of all problems together, and the last one's result.
    total: Iterate,
    /// The smallest number of elements with a gap where none was above the limit.
    fewest_open: usize,
    /// Halvings of the number of elements that are let go at once.
    caution: u32,
}

/// The elements on the wrong side.
#[derive(Default)]
struct Wrong {
    /// Free elements above the limit.
    above: Vec<usize>,
    /// Held elements with a gap, largest first.
    open: Vec<usize>,
    /// By how much, relative to limit and penetration.
    by: f64,
}

impl Exchange {
    /// Starts from the elements near the limit of a pressure, of a prescribed force those that overlap most: one
    /// product where there are any.
    fn start(problem: &mut DiscreteProblem, load: Load, start: &[f64], tolerance: f64) -> Self {
        let limit = problem.hardness();
        let mut total = Iterate::of(Vec::new());
        let mut held = HeldPressure::none(problem);
        let gaps = problem.initial_gap().iter();
        held.mask = (start.iter().zip(gaps))
            .map(|(p, g0)| *p >= NEAR * limit && g0.is_finite())
            .collect();
        let most = match load {
            Load::Force(force) => LARGEST_SHARE * force / (problem.loaded_area() * limit),
            Load::Penetration(_) => f64::INFINITY,
        };
        if held.count() as f64 > most {
            let pressure: Vec<f64> = start.iter().map(|p| p.min(limit)).collect();
            let mut v = vec![0.0; pressure.len()];
            problem.deform_into(&pressure, &mut v);
            total.operator_applications += 1;
            let gaps = v.iter_mut().zip(problem.initial_gap());
            gaps.for_each(|(v, g0)| *v += g0);
            let mut near: Vec<usize> = (0..v.len()).filter(|e| held.mask[*e]).collect();
            near.sort_by(|e, f| v[*e].total_cmp(&v[*f]));
            let beyond = near.iter().enumerate().filter(|(i, _)| *i as f64 >= most);
            beyond.for_each(|(_, e)| held.mask[*e] = false);
        }
        let mut free = start.to_vec();
        held.take_from(&mut free);
        Self {
            held,
            is_pressed: false,
            free,
            accuracy: tolerance.max(COARSEST),
            total,
            fewest_open: usize::MAX,
            caution: 0,
        }
    }

    /// Makes the held elements a part of the load: one product where they are others than before.
    fn press(&mut self, problem: &mut DiscreteProblem) {
        if !self.is_pressed {
            self.total.operator_applications += self.held.press(problem);
            self.is_pressed = true;
        }
    }

    /// How far to solve the problem of the free elements.
    fn options(&self, wanted: SolverOptions) -> SolverOptions {
        let spent = self.total.operator_applications;
        SolverOptions {
            tolerance: self.accuracy,
            max_applications: wanted.max_applications.saturating_sub(spent),
            contact_stiffness: wanted.contact_stiffness && self.accuracy <= wanted.tolerance,
            ..wanted
        }
    }

    /// Solves the problem of the free elements; nothing where those held carry the whole force.
    fn solve(
        &mut self,
        solver: &mut impl ElasticSolver,
        problem: &mut DiscreteProblem,
        load: Load,
        watch: &mut Watch<'_>,
    ) -> Result<Iterate, ContactError> {
        let (rest, free) = (
            self.held.rest_of(load, problem.loaded_area()),
            std::mem::take(&mut self.free),
        );
        match (rest, load) {
            (Load::Force(rest), Load::Force(force)) if rest <= ROUNDING * force => {
                Ok(Iterate::of(vec![0.0; free.len()]))
            }
            _ => problem.under(&mut self.held, |problem| {
                solver.solve_elastic(problem, rest, &free, watch)
            }),
        }
    }

    /// Adds up the work and takes the result; returns whether the contact reached the border of a window.
    fn take(&mut self, found: Iterate) -> bool {
        let total = &mut self.total;
        total.iterations += found.iterations;
        total.operator_applications += found.operator_applications;
        total.stiffness_applications += found.stiffness_applications;
        total.residuals.extend(found.residuals);
        total.contact_stiffness = found.contact_stiffness;
        total.penetration = found.penetration;
        total.reached_border = found.reached_border;
        self.free = found.pressure;
        found.reached_border
    }

    /// Exchanges elements or asks for a closer solution; false where neither is needed.
    fn advance(&mut self, problem: &mut DiscreteProblem, load: Load, tolerance: f64) -> bool {
        let wrong = self.wrong(problem, load);
        if wrong.above.is_empty() && wrong.open.is_empty() {
            let is_done = self.accuracy <= tolerance;
            self.accuracy = tolerance;
            return !is_done;
        }
        self.accuracy = (REFINEMENT * wrong.by).clamp(tolerance, COARSEST.max(tolerance));
        if wrong.above.is_empty() {
            self.let_go(problem.hardness(), &wrong.open);
        } else {
            let next = self.next(problem, &wrong.above);
            self.hold(&wrong.above);
            self.hold(&next);
        }
        self.is_pressed = false;
        true
    }

    /// The elements on the wrong side of the solution beside the held ones: those above the limit, or if there are
    /// none, those with a gap, for which it takes a product where any is held.
    fn wrong(&mut self, problem: &mut DiscreteProblem, load: Load) -> Wrong {
        let limit = problem.hardness();
        let highest = limit * (1.0 + ABOVE);
        let mut wrong = Wrong::default();
        for (element, p) in self.free.iter().enumerate().filter(|(_, p)| **p > highest) {
            wrong.above.push(element);
            wrong.by = wrong.by.max(p / limit - 1.0);
        }
        if self.held.count() == 0 || !wrong.above.is_empty() {
            return wrong;
        }
        let pressure = self.pressure(limit);
        let v = self.deformed(problem, &pressure);
        let penetration = self.penetration(load, &v);
        self.total.penetration = penetration;
        let reference = problem.reference_length(penetration, pressure.iter().sum());
        let gap = |element: usize| v[element] - penetration;
        let lowest = SLACK * self.accuracy * reference;
        let held = self.held.mask.iter().enumerate();
        wrong.open = held
            .filter(|(element, held)| **held && gap(*element) > lowest)
            .map(|(element, _)| element)
            .collect();
        wrong.open.sort_by(|e, f| gap(*f).total_cmp(&gap(*e)));
        if let Some(widest) = wrong.open.first() {
            wrong.by = wrong.by.max(gap(*widest) / reference);
        }
        wrong
    }

    /// As many elements as carry at the limit what those above it carry beyond it: those that press most, then those
    /// with the narrowest gap, for which it takes a product.
    fn next(&mut self, problem: &mut DiscreteProblem, above: &[usize]) -> Vec<usize> {
        let limit = problem.hardness();
        let above = above.iter().map(|element| self.free[*element]);
        let beyond: f64 = above.map(|p| p / limit - 1.0).sum();
        // Elements that have been let go in vain must not all come back.
        if beyond < 1.0 || self.fewest_open < usize::MAX {
            return Vec::new();
        }
        let v = self.deformed(problem, &self.pressure(limit));
        let is_below = |e: &usize| self.free[*e] <= limit && !self.held.mask[*e];
        let touchable = (0..v.len()).filter(|e| is_below(e) && v[*e].is_finite());
        let mut next: Vec<usize> = touchable.collect();
        next.sort_by(|e, f| {
            let by_pressure = self.free[*f].total_cmp(&self.free[*e]);
            by_pressure.then(v[*e].total_cmp(&v[*f]))
        });
        let counted = next.into_iter().zip(1_u32..);
        let next = counted.take_while(|(_, count)| f64::from(*count) <= beyond);
        next.map(|(element, _)| element).collect()
    }

    /// `v = K p + w* + g0` (m): one product.
    fn deformed(&mut self, problem: &mut DiscreteProblem, pressure: &[f64]) -> Vec<f64> {
        let mut v = vec![0.0; pressure.len()];
        problem.deform_into(pressure, &mut v);
        self.total.operator_applications += 1;
        let gaps = v.iter_mut().zip(problem.initial_gap());
        gaps.for_each(|(v, g0)| *v += g0);
        v
    }

    /// `D` for `v = K p + w* + g0` (m).
    fn penetration(&self, load: Load, v: &[f64]) -> f64 {
        if let Load::Penetration(penetration) = load {
            return penetration;
        }
        let (mut total, mut weighted) = (0.0, 0.0);
        let (mut highest, mut lowest) = (f64::NEG_INFINITY, f64::INFINITY);
        for ((p, v), held) in self.free.iter().zip(v).zip(&self.held.mask) {
            if *held {
                highest = highest.max(*v);
            } else if *p > 0.0 {
                (total, weighted) = (total + p, weighted + p * v);
            } else {
                lowest = lowest.min(*v);
            }
        }
        if total > 0.0 {
            weighted / total
        } else {
            highest.min(lowest)
        }
    }

    /// Holds elements that are above the limit.
    fn hold(&mut self, above: &[usize]) {
        for element in above {
            self.held.mask[*element] = true;
        }
        self.held.take_from(&mut self.free);
    }

    /// Lets go elements that have a gap, those with the widest first: all of them, or a part as small as it takes for
    /// their number to fall.
    fn let_go(&mut self, limit: f64, open: &[usize]) {
        if open.len() < self.fewest_open {
            (self.fewest_open, self.caution) = (open.len(), self.caution.saturating_sub(1));
        } else {
            self.caution += 1;
        }
        let at_once = (open.len() >> self.caution.min(MOST_CAUTION)).max(1);
        for element in &open[..at_once] {
            self.held.mask[*element] = false;
            self.free[*element] = limit;
        }
    }

    /// The whole pressure, in Pa.
    fn pressure(&self, limit: f64) -> Vec<f64> {
        let mut pressure = self.free.clone();
        self.held.add_to(&mut pressure, limit);
        pressure
    }

    /// What the exchanges end with: nowhere above the limit.
    fn into_iterate(self, limit: f64) -> Iterate {
        let mut pressure = self.pressure(limit);
        pressure.iter_mut().for_each(|p| *p = p.min(limit));
        Iterate {
            pressure,
            ..self.total
        }
    }
}
