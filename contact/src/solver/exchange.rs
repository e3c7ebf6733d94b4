//! What all exchanges of elements share: solve on a set, exchange what is on the wrong side, descend when that cycles.
//!
//! The semismooth Newton method of the gradient solver, the held elements at a hardness and the dense active set all do
//! so, each on systems of its own. Exchanges of many elements at once find the set quickly, but may cycle; so they are
//! given up once the error has stopped falling ([`Milestone`]). Then an admissible pressure moves towards the solution
//! on the set, and stops where elements reach their bound ([`crossings`]): at the first of them, where the energy is
//! certainly lower, or beyond many of them if it is lower there as well ([`Caution`]).

/// The error that trials must reach, and the trials since the last one that did.
#[derive(Debug, Clone, PartialEq)]
pub struct Milestone {
    /// The next error, as a fraction of the one reached.
    fraction: f64,
    reached: f64,
    since: usize,
}

impl Milestone {
    /// Each error reached must be less than this fraction of the one before.
    pub fn new(fraction: f64) -> Self {
        Self {
            fraction,
            reached: f64::INFINITY,
            since: 0,
        }
    }

    /// Begins again: every error is a new one.
    pub fn restart(&mut self) {
        (self.reached, self.since) = (f64::INFINITY, 0);
    }

    /// After an error reached and some trials since, for tests.
    #[cfg(test)]
    pub fn after(fraction: f64, reached: f64, since: usize) -> Self {
        Self {
            fraction,
            reached,
            since,
        }
    }

    /// Counts a trial with this error; returns the trials since the last milestone.
    pub fn count(&mut self, error: f64) -> usize {
        self.count_if(true, error)
    }

    /// The same for a trial that need not gain unless `must_gain`.
    pub fn count_if(&mut self, must_gain: bool, error: f64) -> usize {
        if error < self.fraction * self.reached {
            (self.reached, self.since) = (error, 0);
        } else if must_gain {
            self.since += 1;
        }
        self.since
    }
}

/// A bound of the pressure.
#[derive(Debug, Clone, Copy)]
pub enum Bound {
    /// `p ≥ 0`.
    Zero,
    /// `p ≤ p_max`.
    Limit(f64),
}

impl Bound {
    fn value(self) -> f64 {
        match self {
            Self::Zero => 0.0,
            Self::Limit(limit) => limit,
        }
    }

    fn is_broken_by(self, pressure: f64) -> bool {
        match self {
            Self::Zero => pressure < 0.0,
            Self::Limit(limit) => pressure > limit,
        }
    }
}

/// The elements that break a bound at the end of a step between two pressures, and the fraction of the step at which
/// each reaches it.
pub fn crossings([from, to]: [&[f64]; 2], bound: Bound) -> impl Iterator<Item = (usize, f64)> {
    let both = from.iter().zip(to).enumerate();
    let broken = both.filter(move |(_, (_, to))| bound.is_broken_by(**to));
    broken.map(move |(element, (from, to))| (element, (from - bound.value()) / (from - to)))
}

/// The fractions of a step at which elements reach a bound that they break at its end, ascending.
pub fn ends(step: [&[f64]; 2], bound: Bound) -> Vec<f64> {
    let mut ends: Vec<f64> = crossings(step, bound).map(|(_, end)| end).collect();
    ends.sort_unstable_by(f64::total_cmp);
    ends
}

/// Halvings after which single elements reach their bound, on any grid.
const MOST_HALVINGS: u32 = 31;

/// How many elements may reach their bound in one step: all, halved by each failure.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Caution {
    halvings: u32,
}

impl Caution {
    /// After this many halvings, for tests.
    #[cfg(test)]
    pub fn after(halvings: u32) -> Self {
        Self { halvings }
    }

    /// Tries to go beyond the first of some `elements` that reach their bound, if at least `fewest` of them may do so
    /// at once: `lowers_energy` makes the step on which that many reach it. Returns whether it lowered the energy; else
    /// the step must end where the first element reaches its bound.
    pub fn leaps(
        &mut self,
        elements: usize,
        fewest: usize,
        lowers_energy: impl FnOnce(usize) -> bool,
    ) -> bool {
        let at_once = elements >> self.halvings.min(MOST_HALVINGS);
        let leaps = at_once >= fewest;
        let is_lower = leaps && lowers_energy(at_once);
        if leaps && !is_lower {
            self.halvings += 2;
        } else {
            self.halvings = self.halvings.saturating_sub(1);
        }
        is_lower
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trials_are_counted_until_one_reaches_the_next_milestone() {
        let mut milestone = Milestone::new(0.5);
        let found = [8.0, 4.0, 3.9, 3.0, 2.0, 1.9].map(|error| milestone.count(error));
        assert_eq!(found, [0, 1, 0, 1, 2, 0]);
        assert_eq!(
            [false, true].map(|must| milestone.count_if(must, 1.0)),
            [0, 1]
        );
        milestone.restart();
        assert_eq!(milestone.count(100.0), 0);
    }

    #[test]
    fn elements_reach_the_bound_that_they_break_in_order() {
        let (from, to) = ([1.0, 2.0, 3.0, 0.0], [-1.0, -6.0, 4.0, 0.0]);
        assert_eq!(ends([&from, &to], Bound::Zero), [0.25, 0.5]);
        let at_limit: Vec<_> = crossings([&from, &to], Bound::Limit(3.5)).collect();
        assert_eq!(at_limit, [(2, 0.5)]);
    }

    #[test]
    fn failures_halve_the_elements_at_once_and_successes_double_them() {
        let mut caution = Caution::default();
        let mut tried = Vec::new();
        for lowers in [true, false, false, true, true] {
            let leapt = caution.leaps(64, 2, |at_once| {
                tried.push(at_once);
                lowers
            });
            assert_eq!(leapt, lowers);
        }
        assert_eq!(tried, [64, 64, 16, 4, 8]);
        // Too few to leap: no step is made, and more may be tried next time.
        assert!(!caution.leaps(4, 2, |_| true));
        assert!(caution.leaps(4, 2, |at_once| at_once == 2));
    }
}
