//! Which kind of step comes next: fast ones while they gain, Newton's where they do not, descent where Newton's fail.

use super::{newton::Turn, segment::Part};

/// Steps without the residual's being halved after which a phase is held to have stalled.
const FAST_PATIENCE: usize = 10;
/// Exchanges without the residual's being halved after which Newton's method is held to cycle.
const NEWTON_PATIENCE: usize = 16;
/// Steps of the first descent that stands in for a failed Newton; each later one is twice as long.
const DESCENT: usize = 40;

/// The kind of steps being taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Spectral and conjugate steps, which never leave the admissible pressures.
    Fast,
    /// Newton's method; the number of times that it failed before.
    Newton(usize),
    /// The fast steps again, for as many as are left, however slowly they gain: the energy falls.
    Descent(usize),
}

/// The phase and what it has gained.
pub struct Strategy {
    phase: Phase,
    failures: usize,
    /// The residual that is to be halved next.
    milestone: f64,
    since: usize,
}

impl Strategy {
    pub fn new() -> Self {
        Self {
            phase: Phase::Fast,
            failures: 0,
            milestone: f64::INFINITY,
            since: 0,
        }
    }

    pub fn phase(&self) -> Phase {
        self.phase
    }

    /// Notes the residual after a fast step, and whether the energy cut the step short, as it does where steps creep along an edge of the contact; true if the
    /// phase changes.
    pub fn after_fast(&mut self, residual: f64, part: Part) -> bool {
        let stalled = self.has_stalled(residual, FAST_PATIENCE) || part == Part::Cut;
        self.phase = match self.phase {
            Phase::Descent(left) if left > 1 => Phase::Descent(left - 1),
            Phase::Fast if !stalled => Phase::Fast,
            _ => return self.enter(Phase::Newton(self.failures)),
        };
        false
    }

    /// Notes what a step of Newton's method did; true if the phase changes.
    pub fn after_newton(&mut self, residual: f64, turn: Turn) -> bool {
        let failed = match turn {
            Turn::Inner => false,
            Turn::Exchanged => self.has_stalled(residual, NEWTON_PATIENCE),
            Turn::Failed => true,
        };
        if failed {
            self.failures += 1;
            return self.enter(Phase::Descent(DESCENT << self.failures.min(16)));
        }
        false
    }

    /// Stays with the fast steps for good: there is nothing else to turn to.
    pub fn only_fast(&mut self) {
        self.enter(Phase::Descent(usize::MAX));
    }

    fn has_stalled(&mut self, residual: f64, patience: usize) -> bool {
        if residual < self.milestone / 2.0 {
            (self.milestone, self.since) = (residual, 0);
        } else {
            self.since += 1;
        }
        self.since >= patience
    }

    fn enter(&mut self, phase: Phase) -> bool {
        self.phase = phase;
        (self.milestone, self.since) = (f64::INFINITY, 0);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::{Part, Phase, Strategy, Turn};

    #[test]
    fn fast_steps_that_gain_go_on_and_those_that_are_cut_give_way() {
        let mut strategy = Strategy::new();
        for step in 0..100 {
            assert!(!strategy.after_fast(0.5_f64.powi(step), Part::Whole));
        }
        assert!(strategy.after_fast(1e-40, Part::Cut));
        assert_eq!(strategy.phase(), Phase::Newton(0));
    }

    #[test]
    fn a_newton_that_cycles_gives_way_to_ever_longer_descents() {
        let mut strategy = Strategy::new();
        let mut lengths = Vec::new();
        for _ in 0..3 {
            while !matches!(strategy.phase(), Phase::Newton(_)) {
                strategy.after_fast(1.0, Part::Whole);
            }
            while !strategy.after_newton(1.0, Turn::Exchanged) {}
            lengths.push(strategy.phase());
        }
        assert_eq!(lengths, [80, 160, 320].map(Phase::Descent));
    }
}
