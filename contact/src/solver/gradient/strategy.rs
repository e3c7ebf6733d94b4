//! The choice of the next kind of step: fast steps while they make progress, Newton's method where they do not or under
//! a stiff coating, descent from face to face where Newton's method fails.

use crate::solver::exchange::Milestone;
use crate::solver::gradient::steps::outcome::StepOutcome;

/// The next milestone of the residual, as a fraction of the last.
const HALVED: f64 = 0.5;
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
    milestone: Milestone,
    /// Fast steps cut in succession, and how many of them end the phase.
    cuts: usize,
    most_cuts: usize,
}

impl Strategy {
    /// Begins with Newton's method or with the fast steps, which end with so many cuts in succession.
    pub fn new(begins_with_newton: bool, most_cuts: usize) -> Self {
        Self {
            phase: if begins_with_newton {
                Phase::Newton(0)
            } else {
                Phase::Fast
            },
            milestone: Milestone::new(HALVED),
            cuts: 0,
            most_cuts,
        }
    }

    pub fn phase(&self) -> Phase {
        self.phase
    }

    /// Records the residual before a step and what the step came to; returns true if the phase changes.
    pub fn changes_phase(&mut self, residual: f64, outcome: StepOutcome) -> bool {
        match self.phase {
            Phase::Descent => false,
            Phase::Fast => {
                let has_stalled = self.milestone.count(residual) >= FAST_PATIENCE;
                let is_cut = outcome == StepOutcome::Cut;
                self.cuts = if is_cut { self.cuts + 1 } else { 0 };
                (has_stalled || self.cuts >= self.most_cuts) && self.enter(Phase::Newton(0))
            }
            Phase::Newton(failures) => match outcome {
                StepOutcome::Exchanged => {
                    let cycles = self.milestone.count(residual) >= NEWTON_PATIENCE;
                    cycles && self.enter(Phase::Descent)
                }
                // The preconditioner failed, not the method.
                StepOutcome::Failed if failures == 0 => self.enter(Phase::Newton(1)),
                StepOutcome::Failed => self.enter(Phase::Descent),
                StepOutcome::Free | StepOutcome::Clipped | StepOutcome::Cut => false,
            },
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

    fn enter(&mut self, phase: Phase) -> bool {
        self.phase = phase;
        self.milestone.restart();
        self.cuts = 0;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::{Phase, StepOutcome, Strategy};

    #[test]
    fn fast_steps_continue_while_they_gain_and_give_way_when_cut_twice() {
        let mut strategy = Strategy::new(false, 2);
        for step in 0..100 {
            assert!(!strategy.changes_phase(0.5_f64.powi(step), StepOutcome::Clipped));
        }
        for outcome in [StepOutcome::Cut, StepOutcome::Clipped, StepOutcome::Cut] {
            assert!(!strategy.changes_phase(1e-40, outcome));
        }
        assert!(strategy.changes_phase(1e-41, StepOutcome::Cut));
        assert_eq!(strategy.phase(), Phase::Newton(0));
    }

    fn at_newton() -> Strategy {
        let mut strategy = Strategy::new(false, 2);
        while strategy.phase() == Phase::Fast {
            strategy.changes_phase(1.0, StepOutcome::Clipped);
        }
        strategy
    }

    #[test]
    fn under_a_stiff_coating_newton_comes_first() {
        assert_eq!(Strategy::new(true, 2).phase(), Phase::Newton(0));
        assert_eq!(Strategy::new(false, 2).phase(), Phase::Fast);
    }

    #[test]
    fn newtons_method_gives_way_to_descent_for_good_when_it_cycles() {
        let mut strategy = at_newton();
        while !strategy.changes_phase(1.0, StepOutcome::Exchanged) {}
        assert_eq!(strategy.phase(), Phase::Descent);
        assert!((0..100).all(|_| !strategy.changes_phase(1.0, StepOutcome::Cut)));
    }

    #[test]
    fn newtons_method_tries_another_preconditioner_once_if_its_systems_are_not_solved() {
        let mut strategy = at_newton();
        for phase in [Phase::Newton(1), Phase::Descent] {
            assert!(strategy.changes_phase(1.0, StepOutcome::Failed));
            assert_eq!(strategy.phase(), phase);
        }
    }
}
