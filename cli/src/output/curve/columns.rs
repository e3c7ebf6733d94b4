//! Columns of a curve: their names and cells, and those that only some curves have.

use pellicle::input::units::Units;
use pellicle::summary::StepSummary;
use pellicle_contact::RoughContact;

/// A column: its name, its SI unit if it has one, and the text of its cell in the row of a step.
pub type CurveColumn = (
    &'static str,
    Option<&'static str>,
    fn(&StepSummary) -> String,
);

/// The columns for a pressure cut at a hardness; empty in the row of a step without one.
pub const OF_HARDNESS: &[CurveColumn] = &[
    ("area at hardness", Some("m^2"), |step| {
        optional(step.summary.area_at_limit)
    }),
    ("area fraction at hardness", None, |step| {
        optional(step.summary.fraction_at_limit)
    }),
    ("plastic depth", Some("m"), |step| {
        optional(step.summary.plastic_depth)
    }),
];

/// The columns of rough contact; empty in the row of a step without a map or without contact.
pub const OF_ROUGH_CONTACT: &[CurveColumn] = &[
    ("contact fraction", None, |step| {
        of_rough(step, |rough| number(rough.contact_fraction))
    }),
    ("mean gap", Some("m"), |step| {
        of_rough(step, |rough| number(rough.mean_gap))
    }),
    ("islands", None, |step| {
        of_rough(step, |rough| rough.islands.count.to_string())
    }),
    ("corrected contact area", Some("m^2"), |step| {
        of_rough(step, |rough| number(rough.corrected_area))
    }),
];

/// The names of columns, with units.
pub fn names(columns: &[CurveColumn], units: Units) -> Vec<String> {
    let names = columns.iter().map(|(name, unit, _)| match unit {
        Some(unit) => format!("{name} [{}]", units.name(unit)),
        None => (*name).to_owned(),
    });
    names.collect()
}

/// The cells of columns in the row of a step, without commas.
pub fn cells(columns: &[CurveColumn], step: &StepSummary) -> Vec<String> {
    columns.iter().map(|(_, _, cell)| cell(step)).collect()
}

/// The shortest text that reads back as the same number.
pub fn number(value: f64) -> String {
    format!("{value:e}")
}

/// The same, or an empty cell.
pub fn optional(value: Option<f64>) -> String {
    value.map_or_else(String::new, number)
}

fn of_rough(step: &StepSummary, cell: fn(&RoughContact) -> String) -> String {
    step.rough_contact.as_ref().map_or_else(String::new, cell)
}
