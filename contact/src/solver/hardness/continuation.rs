//! Continuation in the compliance of added springs, where exchanges of elements go wrong.
//!
//! Under a stiff coating at its hardness almost all of the contact is at the limit: the pressure jumps from 0 to
//! `p_max`, and the force that the held elements leave is carried by the few others at many times the limit. So the
//! contact is found ring by ring, or filled and released in turn. Springs of equal compliance `c` under all elements
//! spread that force. They are added, and the problem is solved in stages as they harden:
//!
//! ```text
//! c₀ = 2 e κ,    cₙ₊₁ = cₙ/r,    c = 0 once c < κ
//! ```
//!
//! where `e` is the largest excess over the limit, in units of the limit, and `κ` the foundation's compliance for
//! opposite pressures on neighbouring elements, below which springs no longer matter. Between stages few elements
//! change sides. If the exchanges stall again, the [descent](super::descent) takes over.
//!
//! A contact found ring by ring in 2200 products takes 220.

use super::wrong_side::WrongSide;

/// Largest excess over the limit, in units of the limit, beyond which springs are added at once if no others may be
/// held with those above it. At 5 as many products; at 20 rough cells take up to twice as many.
const LARGEST_EXCESS_WITHOUT_SPRINGS: f64 = 10.0;
/// `c₀` over `e κ`. At 1 as many products; at 4 the hardest random problem takes twice as many.
const COMPLIANCE_PER_EXCESS: f64 = 2.0;
/// `r`. At 2 and at 8 as many products.
const HARDENING: f64 = 4.0;
/// Largest excess, in units of the limit, at which a stage ends. At 1 the hardest random problem takes twice the
/// products; at 4 one of 1000 is not solved.
const LARGEST_EXCESS_AT_STAGE_END: f64 = 2.0;
/// Elements to be released, as a fraction of those held, up to which a stage may end. Without this rule stages ended
/// on sets that were filled and released in turn: some random problems took four times the products.
const MOST_OPEN_AT_STAGE_END: f64 = 0.1;

/// The springs added to all elements.
pub struct Continuation {
    /// `κ`, in m/Pa.
    shortest_compliance: f64,
    /// `c`, in m/Pa; 0 without springs.
    compliance: f64,
    has_begun: bool,
}

impl Continuation {
    /// Without springs, for a foundation with this `κ` (m/Pa).
    pub fn new(shortest_compliance: f64) -> Self {
        Self {
            shortest_compliance,
            compliance: 0.0,
            has_begun: false,
        }
    }

    fn is_soft(&self) -> bool {
        self.compliance > 0.0
    }

    /// Without springs, and without more to come.
    #[cfg(test)]
    pub fn ended() -> Self {
        Self {
            has_begun: true,
            ..Self::new(1.0)
        }
    }

    /// The compliance (m/Pa) of the next stage's springs; none if the present stage goes on. Depends on the elements on
    /// the wrong side of the present one, the number of those held, whether the exchanges stall, and whether others are
    /// held with those above the limit.
    pub fn next_stage(
        &mut self,
        wrong: &WrongSide,
        held: usize,
        has_stalled: bool,
        fills: bool,
    ) -> Option<f64> {
        let is_open = wrong.open.len() as f64 > MOST_OPEN_AT_STAGE_END * held as f64;
        if self.is_soft() && wrong.excess < LARGEST_EXCESS_AT_STAGE_END && !is_open {
            self.compliance /= HARDENING;
            if self.compliance < self.shortest_compliance {
                self.compliance = 0.0;
            }
        } else if !self.has_begun
            && (has_stalled || wrong.excess > LARGEST_EXCESS_WITHOUT_SPRINGS && !fills)
        {
            self.compliance =
                COMPLIANCE_PER_EXCESS * wrong.excess.max(1.0) * self.shortest_compliance;
            self.has_begun = true;
        } else {
            return None;
        }
        Some(self.compliance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KAPPA: f64 = 0.5;

    fn wrong(excess: f64, open: usize) -> WrongSide {
        WrongSide {
            open: vec![0; open],
            by: excess,
            excess,
            ..WrongSide::default()
        }
    }

    #[test]
    fn springs_are_added_to_elements_far_above_the_limit_and_harden_until_they_are_gone() {
        let mut continuation = Continuation::new(KAPPA);
        assert_eq!(
            continuation.next_stage(&wrong(9.9, 50), 100, false, false),
            None
        );
        assert_eq!(
            continuation.next_stage(&wrong(36.0, 0), 100, false, true),
            None
        );
        let compliances = [72.0, 18.0, 4.5, 1.125].map(|over_kappa| Some(over_kappa * KAPPA));
        let found = [36.0, 1.9, 0.0, 0.3]
            .map(|e| continuation.next_stage(&wrong(e, 10), 100, false, false));
        assert_eq!(found, compliances);
        // They are added once.
        assert_eq!(
            continuation.next_stage(&wrong(36.0, 0), 100, false, false),
            None
        );
    }

    #[test]
    fn a_stage_goes_on_while_elements_are_far_above_the_limit_or_many_have_a_gap() {
        let mut continuation = Continuation::new(KAPPA);
        continuation.next_stage(&wrong(36.0, 1), 100, false, false);
        for wrong in [wrong(2.1, 0), wrong(0.0, 11)] {
            assert_eq!(continuation.next_stage(&wrong, 100, false, false), None);
        }
        assert!(continuation.is_soft());
    }

    #[test]
    fn exchanges_that_stall_get_springs_once() {
        let mut continuation = Continuation::new(KAPPA);
        let mut stage = |excess: f64, has_stalled| {
            continuation.next_stage(&wrong(excess, 0), 100, has_stalled, true)
        };
        // At least those for an excess of 1.
        assert_eq!(stage(0.1, true), Some(COMPLIANCE_PER_EXCESS * KAPPA));
        assert_eq!(stage(3.0, true), None);
    }
}
