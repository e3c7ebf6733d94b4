//! Descent for contact with a hardness: the fallback for the exchanges of elements.
//!
//! From an admissible pressure, `0 ≤ p ≤ p_max`, with some elements held at the limit, the problem of the others gives
//! a pressure `p*`. Then there are three cases:
//!
//! - no element exceeds the limit: this is the minimum of the energy with these elements held, and those with a gap are
//!   released;
//! - an element that was at the limit before exceeds it: it is held again, and the problem solved once more;
//! - other elements exceed the limit: the pressure moves towards `p*`, cut at the limit, until some of these elements
//!   reach the limit if the energy falls throughout that step, else until the first does; elements at the limit are
//!   held.
//!
//! The energy decreases from one admissible pressure to the next, so no set is released twice. It is convex, so it
//! falls throughout a step `s` if it falls at the end, `s·∂E ≤ 0`, for any spring law.
//!
//! **How many are released.** All with a gap, although under a stiff coating those that stay free take up most of the
//! released load and return to the limit. Releasing only some, fewer the longer the last took to return, left the two
//! hardest of 1000 random problems unsolved in 2000 products.

use crate::{
    DiscreteProblem, Load,
    solver::exchange::{Bound, Caution, ends},
    vector::{add_scaled, each, sum},
};

/// Rounding error, relative to the limit, of a pressure that reaches it, and relative to a force.
const ROUNDING: f64 = 1e-14;

/// An admissible pressure and the state of the descent.
pub struct Descent {
    load: Load,
    /// In Pa.
    pressure: Vec<f64>,
    /// `K p`, in m.
    displacement: Vec<f64>,
    /// Of elements that reach the limit at once.
    caution: Caution,
    /// Largest residual to which problems are solved until elements are released again.
    pub accuracy: f64,
}

impl Descent {
    /// Begins from a pressure cut at the limit: one product.
    pub fn begin(problem: &mut DiscreteProblem, load: Load, pressure: &[f64]) -> Self {
        let pressure = cut(problem, load, pressure);
        let mut displacement = vec![0.0; pressure.len()];
        problem.displace(&pressure, &mut displacement);
        Self {
            load,
            pressure,
            displacement,
            caution: Caution::default(),
            accuracy: f64::INFINITY,
        }
    }

    /// The admissible pressure, in Pa.
    pub fn pressure(&self) -> &[f64] {
        &self.pressure
    }

    /// Sets a pressure (Pa) that nowhere exceeds the limit, with its `K p` (m).
    pub fn settle(&mut self, pressure: &[f64], displacement: &[f64]) {
        self.pressure.copy_from_slice(pressure);
        self.displacement.copy_from_slice(displacement);
    }

    /// Moves towards a pressure (Pa), given with its `K p` (m), that exceeds the limit in elements not yet at it. Stops
    /// when some of them have reached the limit, as many as recently kept the step downhill throughout, else at the
    /// first. Returns the products taken.
    pub fn step(
        &mut self,
        problem: &mut DiscreteProblem,
        pressure: &[f64],
        displacement: &[f64],
    ) -> usize {
        let limit = problem.hardness();
        let ends = ends([&self.pressure, pressure], Bound::Limit(limit));
        let (mut products, mut caution) = (0, self.caution);
        let leaps = caution.leaps(ends.len(), 2, |at_once| {
            let part = if at_once == ends.len() {
                1.0
            } else {
                ends[at_once - 1]
            };
            let both = self.pressure.iter().zip(pressure);
            let ahead: Vec<f64> = both.map(|(from, to)| from + part * (to - from)).collect();
            products += 1;
            let cut = Self::begin(problem, self.load, &ahead);
            let is_lower = cut.slope_from(problem, &self.pressure) <= 0.0;
            if is_lower {
                (self.pressure, self.displacement) = (cut.pressure, cut.displacement);
            }
            is_lower
        });
        self.caution = caution;
        if leaps {
            return products;
        }
        let part = ends.first().copied().unwrap_or(1.0);
        for (from, to) in [
            (&mut self.pressure, pressure),
            (&mut self.displacement, displacement),
        ] {
            each(from, |value| *value *= 1.0 - part);
            add_scaled(from, part, to);
        }
        // A pressure equal to the limit up to rounding is set to it.
        each(&mut self.pressure, |p| {
            if *p >= limit * (1.0 - ROUNDING) {
                *p = limit;
            }
        });
        products
    }

    /// `s·∂E` of the step from a pressure to its own: the slope of the energy at its end.
    fn slope_from(&self, problem: &DiscreteProblem, pressure: &[f64]) -> f64 {
        let mut v = self.displacement.clone();
        problem.springs().shorten_into(&self.pressure, &mut v);
        let penetration = match self.load {
            // The step preserves the force.
            Load::Force(_) => 0.0,
            Load::Penetration(penetration) => penetration,
        };
        let fields = self.pressure.iter().zip(pressure);
        let fields = fields.zip(v.iter().zip(problem.initial_gap()));
        let touchable = fields.filter(|(_, (_, g0))| g0.is_finite());
        touchable
            .map(|((to, from), (v, g0))| (to - from) * (v + g0 - penetration))
            .sum()
    }
}

/// Cuts a pressure at the limit. Under a force, the excess is added to the elements below the limit, in proportion to
/// their pressures, and once these reach the limit too, to all that can touch.
fn cut(problem: &DiscreteProblem, load: Load, pressure: &[f64]) -> Vec<f64> {
    let limit = problem.hardness();
    let mut cut: Vec<f64> = pressure.iter().map(|p| p.min(limit)).collect();
    let Load::Force(force) = load else {
        return cut;
    };
    let total = force / problem.loaded_area();
    loop {
        let missing = total - sum(&cut);
        let below: f64 = cut.iter().filter(|p| **p < limit).sum();
        if missing <= ROUNDING * total {
            return cut;
        }
        if below <= ROUNDING * total {
            // The elements that can touch can carry the force, so they do not all reach the limit.
            let touchable = problem.initial_gap().iter().map(|g0| g0.is_finite());
            let free = cut.iter_mut().zip(touchable);
            let free = free.filter(|(p, can_touch)| *can_touch && **p < limit);
            let free: Vec<&mut f64> = free.map(|(p, _)| p).collect();
            let share = missing / free.len() as f64;
            free.into_iter().for_each(|p| *p = (*p + share).min(limit));
            return cut;
        }
        let growth = 1.0 + missing / below;
        let free = cut.iter_mut().filter(|p| **p < limit);
        free.for_each(|p| *p = (*p * growth).min(limit));
    }
}

#[cfg(test)]
mod tests;
