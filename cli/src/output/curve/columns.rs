//! Columns of a curve: their names and cells, and those present only with a hardness or with a map.

use pellicle_contact::{RoughContact, Summary};

use crate::case::Case;
use crate::input::units::Units;
use crate::output::summary::{RunSummary, StepSummary};

/// A column: its name, its SI unit if it has one, and the text of its cell in the row of a `T`.
pub type CurveColumn<T> = (&'static str, Option<&'static str>, fn(&T) -> String);

/// The name of a column, with its unit.
pub fn name<T>((name, unit, _): &CurveColumn<T>, units: Units) -> String {
    match unit {
        Some(unit) => format!("{name} [{}]", units.name(unit)),
        None => (*name).to_owned(),
    }
}

/// The shortest text that reads back as the same number.
pub fn number(value: f64) -> String {
    format!("{value:e}")
}

const OF_HARDNESS: [CurveColumn<Summary>; 3] = [
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

/// The columns for a pressure cut at a hardness, present if there is a hardness.
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
        OF_HARDNESS.iter().filter(move |_| self.are_there)
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

const OF_ROUGH_CONTACT: [CurveColumn<RoughContact>; 4] = [
    ("contact fraction", None, |rough| {
        number(rough.contact_fraction)
    }),
    ("mean gap", Some("m"), |rough| number(rough.mean_gap)),
    ("islands", None, |rough| rough.islands.count.to_string()),
    ("corrected contact area", Some("m^2"), |rough| {
        number(rough.corrected_area)
    }),
];

/// The columns of rough contact, present if a map takes part.
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
        OF_ROUGH_CONTACT.iter().filter(move |_| self.are_there)
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
