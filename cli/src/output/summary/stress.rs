//! The stresses of a step in a summary.

use pellicle_contact::StressExtremes;
use serde::{Deserialize, Serialize};

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
