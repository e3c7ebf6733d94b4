//! The columns of rough contact in a curve.

use pellicle_contact::RoughContact;

use super::column::{CurveColumn, name, number};
use crate::case::Case;
use crate::input::units::Units;
use crate::output::summary::{RunSummary, StepSummary};

const COLUMNS: [CurveColumn<RoughContact>; 4] = [
    ("contact fraction", None, |rough| {
        number(rough.contact_fraction)
    }),
    ("mean gap", Some("m"), |rough| number(rough.mean_gap)),
    ("islands", None, |rough| rough.islands.count.to_string()),
    ("corrected contact area", Some("m^2"), |rough| {
        number(rough.corrected_area)
    }),
];

/// The columns, present if a map takes part.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RoughColumns {
    are_there: bool,
}

impl RoughColumns {
    /// The columns of the steps of a summary.
    #[must_use]
    pub fn of_steps(summary: &RunSummary) -> Self {
        let are_there = summary.has_rough_contact();
        Self { are_there }
    }

    /// Adds the columns of a case.
    pub fn add(&mut self, case: &Case) {
        self.are_there |= case.surface.map().is_some() || case.indenter.map().is_some();
    }

    fn columns(self) -> impl Iterator<Item = &'static CurveColumn<RoughContact>> {
        COLUMNS.iter().filter(move |_| self.are_there)
    }

    /// Names of the columns, with units.
    #[must_use]
    pub fn header(self, units: Units) -> Vec<String> {
        self.columns().map(|column| name(column, units)).collect()
    }

    /// The values of a step; empty without contact.
    #[must_use]
    pub fn row(self, step: &StepSummary) -> Vec<String> {
        let rough = step.rough_contact.as_ref();
        let cell =
            |(_, _, value): &CurveColumn<RoughContact>| rough.map_or_else(String::new, value);
        self.columns().map(cell).collect()
    }
}
