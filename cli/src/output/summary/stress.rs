//! The stresses of a step in a summary.

use pellicle_contact::StressExtremes;
use serde::{Deserialize, Serialize};

use super::Summary;
use crate::case::stress::StressCase;
use crate::stresses::Stresses;

/// The largest stresses of a step, and the sliding that they come with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StressSummary {
    /// Coefficient of friction.
    pub friction: f64,
    /// Direction of sliding, degrees from +x to +y.
    pub direction_degrees: f64,
    /// The extremes in bodies and on interfaces.
    #[serde(flatten)]
    pub extremes: StressExtremes,
}

impl Summary {
    /// Adds the stresses that were found.
    pub fn add_stresses(&mut self, stress: &StressCase, found: Stresses) {
        for (step, extremes) in self.steps.iter_mut().zip(found.steps) {
            step.stress = Some(StressSummary {
                friction: stress.friction,
                direction_degrees: stress.direction_degrees(),
                extremes,
            });
        }
        self.critical = found.critical;
    }
}
