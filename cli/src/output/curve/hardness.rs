//! The columns for a pressure cut at a hardness.

use pellicle_contact::Summary;

use super::column::{CurveColumn, name, number};
use crate::case::Case;
use crate::input::units::Units;
use crate::output::summary::{RunSummary, StepSummary};

const COLUMNS: [CurveColumn<Summary>; 3] = [
    ("area at hardness", Some("m^2"), |summary| {
        summary.area_at_limit.map_or_else(String::new, number)
    }),
    ("area fraction at hardness", None, |summary| {
        summary.fraction_at_limit.map_or_else(String::new, number)
    }),
    ("plastic depth", Some("m"), |summary| {
        summary.plastic_depth.map_or_else(String::new, number)
    }),
];

/// The columns, present if there is a hardness.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct HardnessColumns {
    are_there: bool,
}

impl HardnessColumns {
    /// The columns of the steps of a summary.
    #[must_use]
    pub fn of_steps(summary: &RunSummary) -> Self {
        let are_there = summary
            .steps
            .iter()
            .any(|step| step.summary.area_at_limit.is_some());
        Self { are_there }
    }

    /// Adds the columns of a case.
    pub fn add(&mut self, case: &Case) {
        self.are_there |= case.hardness().is_some();
    }

    fn columns(self) -> impl Iterator<Item = &'static CurveColumn<Summary>> {
        COLUMNS.iter().filter(move |_| self.are_there)
    }

    /// Names of the columns, with units.
    #[must_use]
    pub fn header(self, units: Units) -> Vec<String> {
        self.columns().map(|column| name(column, units)).collect()
    }

    /// The values of a step; empty without a hardness.
    #[must_use]
    pub fn row(self, step: &StepSummary) -> Vec<String> {
        self.columns()
            .map(|(_, _, value)| value(&step.summary))
            .collect()
    }
}
