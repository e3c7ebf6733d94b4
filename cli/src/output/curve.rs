//! `curve.csv`: one row per loading step, units in the header.

pub mod columns;
pub mod sensitivity;
pub mod stress;

use self::columns::{CurveColumn, OF_HARDNESS, OF_ROUGH_CONTACT, cells, names, number, optional};
use self::sensitivity::SensitivityColumns;
use self::stress::StressColumns;
use super::summary::{RunSummary, StepSummary};
use crate::input::units::Units;

/// Name of the file in a results folder.
pub const FILE: &str = "curve.csv";

const COLUMNS: &[CurveColumn] = &[
    ("force", Some("N"), |step| number(step.force)),
    ("penetration", Some("m"), |step| number(step.penetration)),
    ("max pressure", Some("Pa"), |step| {
        number(step.summary.max_pressure)
    }),
    ("mean pressure", Some("Pa"), |step| {
        number(step.summary.mean_pressure)
    }),
    ("contact area", Some("m^2"), |step| {
        number(step.summary.contact_area)
    }),
    ("contact area on relief", Some("m^2"), |step| {
        number(step.summary.contact_area_on_relief)
    }),
    ("contact area between", Some("m^2"), |step| {
        number(step.summary.contact_area_between)
    }),
    ("contact radius", Some("m"), |step| {
        number(step.summary.contact_radius)
    }),
    ("contact elements", None, |step| {
        step.summary.contact_elements.to_string()
    }),
    ("contact stiffness", Some("N/m"), |step| {
        optional(step.contact_stiffness)
    }),
    ("certificate worst", None, |step| {
        number(step.certificate.worst)
    }),
    ("certificate satisfied", None, |step| {
        step.certificate.satisfied.to_string()
    }),
    ("operator applications", None, |step| {
        step.work.operator_applications.to_string()
    }),
];

/// Writes the curve as comma-separated values.
#[must_use]
pub fn csv(summary: &RunSummary) -> String {
    let has_hardness = |step: &StepSummary| step.summary.area_at_limit.is_some();
    let hardness = given(summary.steps.iter().any(has_hardness), OF_HARDNESS);
    let stress = StressColumns::of_steps(summary);
    let sensitivities = SensitivityColumns::of_steps(summary);
    let rough = given(summary.has_rough_contact(), OF_ROUGH_CONTACT);
    let critical = summary.critical.as_deref().unwrap_or_default();
    let row = |(i, step): (usize, &StepSummary)| {
        let cells = [
            row(i, step),
            cells(hardness, step),
            stress.row(step, critical),
            sensitivities.row(step),
            cells(rough, step),
        ];
        cells.concat().join(",") + "\n"
    };
    let rows: String = summary.steps.iter().enumerate().map(row).collect();
    let units = summary.units;
    let names = [
        header(units),
        names(hardness, units),
        stress.header(units),
        sensitivities.header(units),
        names(rough, units),
    ]
    .concat();
    names.join(",") + "\n" + &rows
}

/// The columns, or none.
fn given(are_there: bool, columns: &'static [CurveColumn]) -> &'static [CurveColumn] {
    if are_there { columns } else { &[] }
}

/// Names of the columns, with units.
#[must_use]
pub fn header(units: Units) -> Vec<String> {
    let names = names(COLUMNS, units);
    std::iter::once("step".to_owned()).chain(names).collect()
}

/// The values of one step, without commas.
#[must_use]
pub fn row(i: usize, step: &StepSummary) -> Vec<String> {
    let cells = cells(COLUMNS, step);
    std::iter::once(i.to_string()).chain(cells).collect()
}

/// Whether a text is the curve of a run of this many steps, of this version or another.
#[must_use]
pub fn is_of(csv: &str, steps: usize) -> bool {
    let mut lines = csv.lines();
    let starts = |line: &str, first: &str| line.split(',').next() == Some(first);
    let is_header = |line: &str| line.starts_with("step,force");
    lines.next().is_some_and(is_header)
        && lines.clone().count() == steps
        && lines
            .enumerate()
            .all(|(i, line)| starts(line, &i.to_string()))
}

/// The units of a curve, from its header.
#[must_use]
pub fn units(csv: &str) -> Units {
    let header = csv.lines().next().unwrap_or_default();
    if header.contains("[N]") {
        Units::Si
    } else {
        Units::Consistent
    }
}
