//! The choice of the next kind of step: fast steps while they make progress, Newton's method where they do not or under
//! a stiff coating, descent from face to face where Newton's method fails.

use crate::solver::gradient::steps::newton::Turn;
use crate::solver::gradient::steps::segment::Part;

/// Steps without halving the residual after which a phase counts as stalled.
const FAST_PATIENCE: usize = 10;
/// Exchanges without halving the residual after which Newton's method counts as cycling.
const NEWTON_PATIENCE: usize = 16;
/// The current kind of step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Spectral and conjugate steps, which never leave the admissible pressures.
    Fast,
    /// Newton's method, with the number of its earlier failures.
    Newton(usize),
    /// Descent from face to face: slow, but the energy always falls. Fast steps again if the operator is unknown.
    Descent,
}

/// The phase and its progress.
pub struct Strategy {
    phase: Phase,
    /// The residual to be halved next.
    milestone: f64,
    since: usize,
}

impl Strategy {
    /// Begins with Newton's method or with the fast steps.
    pub fn new(begins_with_newton: bool) -> Self {
        Self {
            phase: if begins_with_newton {
                Phase::Newton(0)
            } else {
                Phase::Fast
            },
            milestone: f64::INFINITY,
            since: 0,
        }
    }

    pub fn phase(&self) -> Phase {
        self.phase
    }

    /// Records the residual after a fast step, and whether the step was cut at a minimum of the energy, as happens
    /// where steps creep along an edge of the contact. Returns true if the phase changes.
    pub fn after_fast(&mut self, residual: f64, part: Part) -> bool {
        let stalled = self.has_stalled(residual, FAST_PATIENCE) || part == Part::Cut;
        self.phase == Phase::Fast && stalled && self.enter(Phase::Newton(0))
    }

    /// Records the result of a step of Newton's method; returns true if the phase changes.
    pub fn after_newton(&mut self, residual: f64, turn: Turn) -> bool {
        match (turn, self.phase) {
            (Turn::Inner, _) => false,
            (Turn::Exchanged, _) if !self.has_stalled(residual, NEWTON_PATIENCE) => false,
            // The preconditioner failed, not the method.
            (Turn::Failed, Phase::Newton(0)) => self.enter(Phase::Newton(1)),
            _ => self.enter(Phase::Descent),
        }
    }

    /// Continues in the same phase with another problem.
    pub fn restart(&mut self) {
        self.enter(self.phase);
    }

    /// Switches to the descent permanently.
    pub fn descend(&mut self) {
        self.enter(Phase::Descent);
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
    fn fast_steps_continue_while_they_gain_and_give_way_when_cut() {
        let mut strategy = Strategy::new(false);
        for step in 0..100 {
            assert!(!strategy.after_fast(0.5_f64.powi(step), Part::Whole));
        }
        assert!(strategy.after_fast(1e-40, Part::Cut));
        assert_eq!(strategy.phase(), Phase::Newton(0));
    }

    fn at_newton() -> Strategy {
        let mut strategy = Strategy::new(false);
        while strategy.phase() == Phase::Fast {
            strategy.after_fast(1.0, Part::Whole);
        }
        strategy
    }

    #[test]
    fn under_a_stiff_coating_newton_comes_first() {
        assert_eq!(Strategy::new(true).phase(), Phase::Newton(0));
        assert_eq!(Strategy::new(false).phase(), Phase::Fast);
    }

    #[test]
    fn newtons_method_gives_way_to_descent_for_good_when_it_cycles() {
        let mut strategy = at_newton();
        while !strategy.after_newton(1.0, Turn::Exchanged) {}
        assert_eq!(strategy.phase(), Phase::Descent);
        assert!((0..100).all(|_| !strategy.after_fast(1.0, Part::Cut)));
    }

    #[test]
    fn newtons_method_tries_another_preconditioner_once_if_its_systems_are_not_solved() {
        let mut strategy = at_newton();
        for phase in [Phase::Newton(1), Phase::Descent] {
            assert!(strategy.after_newton(1.0, Turn::Failed));
            assert_eq!(strategy.phase(), phase);
        }
    }
}
