//! Descent of a contact whose pressure is cut at a hardness: the floor under its exchanges.
//!
//! From an admissible pressure, `0 ≤ p ≤ p_max`, with some elements held at the limit, the problem of the others
//! leads to a pressure `p*`; then
//!
//! - nothing is above the limit: that is the least energy with these elements held, and those with a gap are let go;
//! - something is above that was at the limit before: it is held again, and the problem solved once more;
//! - something else is above: the pressure goes towards `p*`, cut at the limit, as far as a part of these elements
//!   come to it, if the energy falls on the whole way there, else as far as the first; elements at the limit are held.
//!
//! The energy falls from one admissible pressure to the next, so no set is let go twice. It is convex, so it falls on
//! the whole way of a step `s` if it falls at the end, `s·∂E ≤ 0`, whatever the law of the springs.
//!
//! **How many are let go.** All with a gap, although those left free take up most of what is let go under a stiff
//! coating and come back: letting go a part of them, fewer the longer the last took to come back, took the two hardest
//! of 1000 random problems more than 2000 products instead of 1461 and 1421.

use crate::{
    DiscreteProblem, Load,
    vector::{add_scaled, each, sum},
};

/// Halvings after which single elements come to the limit, on any grid.
const MOST_CAUTION: u32 = 31;
/// Part of the limit by which a pressure that comes to it may be short of it, and of a force that is rounding.
const ROUNDING: f64 = 1e-14;

/// An admissible pressure, and how to go on from it.
pub struct Descent {
    load: Load,
    /// In Pa.
    pressure: Vec<f64>,
    /// `K p`, in m.
    displacement: Vec<f64>,
    /// Halvings of the number of elements that come to the limit at once.
    caution: u32,
    /// Residual to which problems are solved at most, until elements are let go again.
    pub accuracy: f64,
}

impl Descent {
    /// Begins from a pressure, cut at the limit: one product.
    pub fn begin(problem: &mut DiscreteProblem, load: Load, pressure: &[f64]) -> Self {
        let pressure = cut(problem, load, pressure);
        let mut displacement = vec![0.0; pressure.len()];
        problem.displace(&pressure, &mut displacement);
        Self {
            load,
            pressure,
            displacement,
            caution: 0,
            accuracy: f64::INFINITY,
        }
    }

    /// The admissible pressure, in Pa.
    pub fn pressure(&self) -> &[f64] {
        &self.pressure
    }

    /// Takes a pressure (Pa) that is nowhere above the limit, with its `K p` (m).
    pub fn settle(&mut self, pressure: &[f64], displacement: &[f64]) {
        self.pressure.copy_from_slice(pressure);
        self.displacement.copy_from_slice(displacement);
    }

    /// Goes towards a pressure (Pa) with its `K p` (m) that is above the limit in elements which are not at it yet,
    /// until a part of them have come to it, as large as has lately been downhill all the way, else the first; returns
    /// the products that it took.
    pub fn step(
        &mut self,
        problem: &mut DiscreteProblem,
        pressure: &[f64],
        displacement: &[f64],
    ) -> usize {
        let limit = problem.hardness();
        let both = self.pressure.iter().zip(pressure);
        let above = both.filter(|(_, to)| **to > limit);
        let mut ends: Vec<f64> = above
            .map(|(from, to)| (limit - from) / (to - from))
            .collect();
        ends.sort_unstable_by(f64::total_cmp);
        let at_once = ends.len() >> self.caution.min(MOST_CAUTION);
        if at_once > 1 {
            let part = if at_once == ends.len() {
                1.0
            } else {
                ends[at_once - 1]
            };
            let both = self.pressure.iter().zip(pressure);
            let ahead: Vec<f64> = both.map(|(from, to)| from + part * (to - from)).collect();
            let cut = Self::begin(problem, self.load, &ahead);
            if cut.slope_from(problem, &self.pressure) <= 0.0 {
                (self.pressure, self.displacement) = (cut.pressure, cut.displacement);
                self.caution = self.caution.saturating_sub(1);
                return 1;
            }
            self.caution += 2;
        } else {
            self.caution = self.caution.saturating_sub(1);
        }
        let part = ends.first().copied().unwrap_or(1.0);
        for (from, to) in [
            (&mut self.pressure, pressure),
            (&mut self.displacement, displacement),
        ] {
            each(from, |value| *value *= 1.0 - part);
            add_scaled(from, part, to);
        }
        // A pressure within rounding of the limit is set to it.
        each(&mut self.pressure, |p| {
            if *p >= limit * (1.0 - ROUNDING) {
                *p = limit;
            }
        });
        usize::from(at_once > 1)
    }

    /// `s·∂E` of the step from a pressure to its own: the slope of the energy at its end.
    fn slope_from(&self, problem: &DiscreteProblem, pressure: &[f64]) -> f64 {
        let mut v = self.displacement.clone();
        problem.shorten_into(&self.pressure, &mut v);
        let penetration = match self.load {
            // The step keeps the force.
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

/// A pressure cut at the limit; under a force, what it loses is added to the elements that press less, in proportion to
/// their pressures, and where those come to the limit too, to those that can touch.
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
            // The force itself is within what can touch, so these do not fill up.
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
