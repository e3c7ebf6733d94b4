//! The points of a fit at which its model does not hold.

use std::collections::BTreeMap;

use pellicle_identify::Invalidity;

use super::curve_source::OutsidePoint;
use super::findings::ExcludedResult;

/// Points at which the model does not hold.
#[derive(Debug, Clone, Default)]
pub struct Outside {
    /// Of each point that was measured in contact, why, if so; empty if there are none.
    pub invalid: Vec<Option<Invalidity>>,
    /// The points, for each curve; empty if there are none.
    pub points: Vec<Vec<OutsidePoint>>,
    /// Their handling.
    pub handling: Handling,
    /// The reason why they could not be looked for, if any.
    pub failure: Option<String>,
}

/// The handling of the points at which the model does not hold.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Handling {
    /// They are not in the fit.
    #[default]
    LeftOut,
    /// They are in the fit, because the fit file says so.
    Kept,
    /// They are not in the fit, but by the fit without them they would be others.
    Unsettled,
    /// They are in the fit, because too few would be left without them.
    TooFewLeft,
    /// They are in the fit, which did not converge.
    NotConverged,
}

impl Outside {
    /// Whether they are missing in the fit.
    #[must_use]
    pub fn are_left_out(&self) -> bool {
        matches!(self.handling, Handling::LeftOut | Handling::Unsettled)
    }

    /// The points left out of the fit, by reason.
    #[must_use]
    pub fn excluded(&self) -> Vec<ExcludedResult> {
        if !self.are_left_out() {
            return Vec::new();
        }
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        for point in self.points.iter().flatten() {
            *counts.entry(point.reason.to_string()).or_default() += 1;
        }
        let reasons = counts.into_iter();
        reasons
            .map(|(reason, count)| ExcludedResult { reason, count })
            .collect()
    }
}
