//! `curve.csv`: one row per loading step, units in the header.

pub mod numbers;
pub mod sensitivity;
pub mod stress;

use self::numbers::NumberColumns;
use self::sensitivity::SensitivityColumns;
use self::stress::StressColumns;
use crate::input::units::Units;
use crate::summary::{RunSummary, StepSummary};

/// Name of the file in a results folder.
pub const FILE: &str = "curve.csv";

/// Writes the curve as comma-separated values: the numbers of each step, its stresses with the critical loads, and its
/// derivatives.
#[must_use]
pub fn csv(summary: &RunSummary) -> String {
    let numbers = NumberColumns::of_run(summary);
    let stress = StressColumns::of_steps(summary);
    let sensitivities = SensitivityColumns::of_steps(summary);
    let critical = summary.critical.as_deref().unwrap_or_default();
    let row = |(i, step): (usize, &StepSummary)| {
        let cells = [
            numbers.row(i, step),
            stress.row(step, critical),
            sensitivities.row(step),
        ];
        cells.concat().join(",") + "\n"
    };
    let rows: String = summary.steps.iter().enumerate().map(row).collect();
    let units = summary.units;
    let names = [
        numbers.header(units),
        stress.header(units),
        sensitivities.header(units),
    ]
    .concat();
    names.join(",") + "\n" + &rows
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
