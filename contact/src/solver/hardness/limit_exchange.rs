//! Successive exchanges of elements: which are held at the limit, and how accurately the problem of the others is
//! solved.

mod search;

use super::{continuation::Continuation, descent::Descent, wrong_side::WrongSide};
use crate::{
    ContactError, DiscreteProblem, Iterate, Load, SolverOptions,
    problem::held_pressure::HeldPressure,
    solver::{ElasticSolver, Watch, exchange::Milestone},
    vector::add_scaled,
};

/// Largest residual to which a problem between exchanges is solved, over the stiffness contrast up to [`STIFFEST`]:
/// under a stiff coating small gaps hide large pressures. With 1e-2 there too, rough surfaces on coatings 10 to 100
/// times as stiff took up to five times the products.
const COARSEST: f64 = 1e-2;
/// Contrast beyond which the residual is no smaller: without this bound one of 2135 random problems was not solved.
const STIFFEST: f64 = 10.0;
/// Residual of the next problem, as a fraction of the last exchange's error.
const REFINEMENT: f64 = 0.03;
/// The next residual, as a fraction of the last, if a problem of the descent leaves no element on the wrong side.
const ACCURACY_IN_DESCENT: f64 = 0.1;
/// Largest residual after a problem that left no element on the wrong side, as a fraction of that before. Without this,
/// elements move back and forth between a coarse and a fine solution, and such contacts take a third more products.
const TIGHTENING: f64 = 0.1;
/// The largest residual on added springs, as a fraction of that without. At 1 and at 5 a solution on softer springs
/// could pass for one on stiffer springs: rough contacts under a coating 3000 times as stiff took up to five times the
/// products.
const FINER_ON_SPRINGS: f64 = 0.5;
/// The next milestone of the error, as a fraction of the last.
const HALVED: f64 = 0.5;
/// Exchanges without halving the error after which springs are added, or after that the descent begins.
const PATIENCE: usize = 4;
/// Exchanges of a stage that hold others with those above the limit after elements have been released. With none, rough
/// cells take a quarter more products in the mean; without a bound, one of 1000 random problems is not solved.
const MOST_REFILLS: usize = 1;
/// Fraction of the limit above which an element of a start is held.
const LEAST_HELD_AT_START: f64 = 0.95;
/// Largest fraction of a force carried by the elements held at a start.
const LARGEST_SHARE: f64 = 0.97;
/// Fraction of a force that is rounding error of the held elements' force.
const ROUNDING: f64 = 1e-13;

/// The elements held at the limit, and the pressure of the others.
pub struct LimitExchange {
    load: Load,
    /// Required residual of the solution.
    tolerance: f64,
    held: HeldPressure,
    /// Whether the present `held` is already part of the load.
    is_pressed: bool,
    /// Pressure of the elements that are not held, in Pa.
    free: Vec<f64>,
    /// Residual to which the next problem is solved, and its largest value.
    accuracy: f64,
    coarsest: f64,
    /// The total work of all problems, and the result of the last one.
    pub total: Iterate,
    milestone: Milestone,
    /// Whether the present stage has released elements, and how often it has held others with those above the limit
    /// since.
    has_released: bool,
    refills: usize,
    continuation: Continuation,
    descent: Option<Descent>,
}

impl LimitExchange {
    /// Starts by holding the elements whose pressure is near the limit; only those that overlap most if all would carry
    /// too much of a prescribed force, which takes one product.
    pub fn start(problem: &mut DiscreteProblem, load: Load, start: &[f64], tolerance: f64) -> Self {
        let limit = problem.hardness();
        let mut total = Iterate::of(Vec::new());
        let mut held = problem.none_held();
        let gaps = problem.initial_gap().iter();
        held.mask = (start.iter().zip(gaps))
            .map(|(p, g0)| *p >= LEAST_HELD_AT_START * limit && g0.is_finite())
            .collect();
        let most = match load {
            Load::Force(force) => {
                let all = force / (problem.loaded_area() * limit);
                (LARGEST_SHARE * all).ceil().min(all.floor())
            }
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
        let coarsest = tolerance.max(COARSEST / problem.stiffness_contrast().clamp(1.0, STIFFEST));
        Self {
            load,
            tolerance,
            held,
            is_pressed: false,
            free,
            accuracy: coarsest,
            coarsest,
            total,
            milestone: Milestone::new(HALVED),
            has_released: false,
            refills: 0,
            descent: None,
            continuation: Continuation::new(problem.shortest_compliance()),
        }
    }

    /// Makes the held elements part of the load: one product if they have changed.
    pub fn press(&mut self, problem: &mut DiscreteProblem) {
        if !self.is_pressed {
            self.total.operator_applications += problem.press_held(&mut self.held);
            self.is_pressed = true;
        }
    }

    /// The options for the problem of the free elements.
    pub fn options(&self, wanted: SolverOptions) -> SolverOptions {
        let used = self.total.operator_applications;
        SolverOptions {
            tolerance: self.accuracy,
            max_applications: wanted.max_applications.saturating_sub(used),
            contact_stiffness: wanted.contact_stiffness && self.accuracy <= wanted.tolerance,
            ..wanted
        }
    }

    /// Solves the problem of the free elements; their pressure is zero if the held elements carry the whole force.
    pub fn solve(
        &mut self,
        solver: &mut impl ElasticSolver,
        problem: &mut DiscreteProblem,
        watch: &mut Watch<'_>,
    ) -> Result<(Iterate, Option<Vec<f64>>), ContactError> {
        let (rest, free) = (
            self.held.rest_of(self.load, problem.loaded_area()),
            std::mem::take(&mut self.free),
        );
        match (rest, self.load) {
            (Load::Force(rest), Load::Force(force)) if rest <= ROUNDING * force => {
                let nothing = vec![0.0; free.len()];
                Ok((Iterate::of(nothing.clone()), Some(nothing)))
            }
            _ => problem.under(&mut self.held, |problem| {
                solver.solve_elastic(problem, rest, &free, watch)
            }),
        }
    }

    /// Adds the work to the total and takes the result; returns whether the contact reached the border of a region.
    pub fn take(&mut self, found: Iterate) -> bool {
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

    /// Computes `K p` (m) of the whole pressure: one product if that of the free elements is unknown.
    pub fn displacement(
        &mut self,
        problem: &mut DiscreteProblem,
        of_free: Option<Vec<f64>>,
    ) -> Vec<f64> {
        let mut displacement = of_free.unwrap_or_else(|| {
            let mut displacement = vec![0.0; self.free.len()];
            problem.displace(&self.free, &mut displacement);
            self.total.operator_applications += 1;
            displacement
        });
        add_scaled(&mut displacement, 1.0, &self.held.displacement);
        displacement
    }

    /// Exchanges elements or tightens the accuracy of the solution; returns false if neither is needed.
    pub fn advance(&mut self, problem: &mut DiscreteProblem, displacement: &[f64]) -> bool {
        let (limit, tolerance) = (problem.hardness(), self.tolerance);
        let pressure = self.pressure(limit);
        // v = K p + w* + g0
        let mut v = displacement.to_vec();
        problem.springs().shorten_into(&pressure, &mut v);
        add_scaled(&mut v, 1.0, problem.initial_gap());
        let wrong = self.wrong(problem, &v);
        let has_stalled = self.has_stalled(&wrong);
        if self.enter_next_stage(problem, &wrong, has_stalled) {
            self.exchange(limit, &wrong, &v);
            return true;
        }
        if wrong.above.is_empty() && wrong.open.is_empty() {
            if self.accuracy <= tolerance {
                return false;
            }
            self.coarsest = tolerance.max(TIGHTENING * self.coarsest);
            self.accuracy = if self.descent.is_some() {
                tolerance.max(ACCURACY_IN_DESCENT * self.accuracy)
            } else {
                tolerance
            };
            return true;
        }
        let accuracy = (REFINEMENT * wrong.by).clamp(tolerance, self.coarsest);
        self.is_pressed = false;
        if self.descent.is_some() {
            self.descend(problem, &wrong, [&pressure, displacement], accuracy);
            return true;
        }
        if has_stalled {
            problem.soften(0.0);
            self.descent = Some(Descent::begin(problem, self.load, &pressure));
            self.total.operator_applications += 1;
            self.hold_descended(limit);
        } else {
            self.exchange(limit, &wrong, &v);
        }
        self.accuracy = accuracy;
        true
    }

    /// Enters the next stage of the continuation if the present one has ended; never in a descent.
    fn enter_next_stage(
        &mut self,
        problem: &mut DiscreteProblem,
        wrong: &WrongSide,
        has_stalled: bool,
    ) -> bool {
        let fills = self.fills(wrong);
        let next_stage = if self.descent.is_some() {
            None
        } else {
            (self.continuation).next_stage(wrong, self.held.count(), has_stalled, fills)
        };
        let Some(compliance) = next_stage else {
            return false;
        };
        problem.soften(compliance);
        self.accuracy = if compliance > 0.0 {
            FINER_ON_SPRINGS * self.coarsest
        } else {
            self.coarsest
        };
        self.milestone.restart();
        (self.has_released, self.refills) = (false, 0);
        true
    }

    /// Whether the error of the exchanges has not been halved for too long. Exchanges that release no element always
    /// end.
    fn has_stalled(&mut self, wrong: &WrongSide) -> bool {
        let releases = !wrong.open.is_empty();
        self.milestone.count_if(releases, wrong.by) >= PATIENCE
    }

    /// Holds the elements at the limit of the descent's pressure, and continues from that pressure.
    fn hold_descended(&mut self, limit: f64) {
        let Some(descent) = &self.descent else {
            return;
        };
        self.free.copy_from_slice(descent.pressure());
        for (held, p) in self.held.mask.iter_mut().zip(descent.pressure()) {
            *held = *p >= limit;
        }
        self.held.take_from(&mut self.free);
    }

    /// Holds the elements above the limit and releases those with a gap.
    fn exchange(&mut self, limit: f64, wrong: &WrongSide, v: &[f64]) {
        self.is_pressed = false;
        let next = self.next(limit, wrong, v);
        self.refills += usize::from(self.has_released && !next.is_empty());
        self.release(limit, &wrong.open);
        self.hold(&next);
        self.hold(&wrong.above);
    }

    /// Takes one step of the descent from the solution with the held elements, given by its pressure (Pa) and `K p`
    /// (m).
    fn descend(
        &mut self,
        problem: &mut DiscreteProblem,
        wrong: &WrongSide,
        [pressure, displacement]: [&[f64]; 2],
        accuracy: f64,
    ) {
        let limit = problem.hardness();
        let Some(descent) = &mut self.descent else {
            return;
        };
        self.accuracy = accuracy.min(descent.accuracy);
        let was_at_limit = |element: &&usize| descent.pressure()[**element] >= limit;
        let returned: Vec<usize> = wrong.above.iter().filter(was_at_limit).copied().collect();
        if wrong.above.is_empty() {
            descent.settle(pressure, displacement);
            (descent.accuracy, self.accuracy) = (accuracy, accuracy);
            self.release(limit, &wrong.open);
        } else if returned.is_empty() {
            let products = descent.step(problem, pressure, displacement);
            self.total.operator_applications += products;
            self.hold_descended(limit);
        } else {
            self.hold(&returned);
        }
    }

    /// Whether others are held with those above the limit.
    fn fills(&self, wrong: &WrongSide) -> bool {
        wrong.open.is_empty() && (!self.has_released || self.refills < MOST_REFILLS)
    }

    /// As many elements as can carry at the limit the excess of those above it: those with the largest pressure, then
    /// those with the smallest gap.
    fn next(&self, limit: f64, wrong: &WrongSide, v: &[f64]) -> Vec<usize> {
        let above = wrong.above.iter().map(|element| self.free[*element]);
        let beyond: f64 = above.map(|p| p / limit - 1.0).sum();
        if !self.fills(wrong) || beyond < 1.0 {
            return Vec::new();
        }
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

    /// Holds elements that are above the limit.
    fn hold(&mut self, above: &[usize]) {
        for element in above {
            self.held.mask[*element] = true;
        }
        self.held.take_from(&mut self.free);
    }

    /// Releases elements that have a gap.
    fn release(&mut self, limit: f64, open: &[usize]) {
        self.has_released |= !open.is_empty();
        for element in open {
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

    /// Returns the result of the exchanges, with no pressure above the limit.
    pub fn into_iterate(self, limit: f64) -> Iterate {
        let mut pressure = self.pressure(limit);
        pressure.iter_mut().for_each(|p| *p = p.min(limit));
        Iterate {
            pressure,
            ..self.total
        }
    }
}

#[cfg(test)]
mod tests;
