//! What has worn away up to a step.

use pellicle_texture::{Relief, SampledRelief};

/// The wear of a step.
#[derive(Debug, Clone, PartialEq)]
pub struct StepWear {
    /// Sliding distance, m.
    pub distance: f64,
    /// Worn volume, m³: that of a cell if the domain is one.
    pub volume: f64,
    /// Largest depth of wear, m.
    pub max_depth: f64,
    /// Depth of wear of each element, m.
    pub depth: Vec<f64>,
    /// Area that touches but does not wear, or no longer, m²: the body between the tops of a relief, and where its
    /// springs are worn through.
    pub unwearing: f64,
    /// Whether the certificates of all contacts on the way are satisfied.
    pub is_certified: bool,
    /// Contacts solved on the way from the step before.
    pub contacts: usize,
    /// Their products with `K`.
    pub products: usize,
}

/// A sampled relief after wear.
pub(crate) struct WornFields {
    /// `f* − d`, m.
    pub profile: Vec<f64>,
    /// `η` of the springs that are left, m/Pa.
    pub compliance: Vec<f64>,
}

impl StepWear {
    /// The profile and the springs of a relief, sampled on the same grid, after this wear.
    pub(crate) fn applied(&self, relief: &Relief, sampled: &SampledRelief) -> WornFields {
        let per_length = relief.spring_modulus().map_or(0.0, f64::recip);
        let worn = |values: &[f64], rate: f64| -> Vec<f64> {
            let values = values.iter().zip(&self.depth);
            values.map(|(value, depth)| value - rate * depth).collect()
        };
        let compliance = worn(sampled.compliance(), per_length).into_iter();
        WornFields {
            profile: worn(sampled.profile(), 1.0),
            compliance: compliance.map(|left| left.max(0.0)).collect(),
        }
    }
}
