//! The columns of a study's table: case, status, the keys that vary, and those of a curve.

use super::Study;
use super::status::Status;
use crate::case::units::Units;
use crate::output::curve;
use crate::output::summary::Summary;

/// The columns, with units.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns {
    names: Vec<String>,
    /// How many of them a curve has.
    curve: usize,
}

impl Columns {
    /// The columns of a study whose cases have these units.
    #[must_use]
    pub fn new(study: &Study, units: Units) -> Self {
        let curve = curve::header(units);
        let keys = study.axes().iter().map(super::axis::Axis::heading);
        let metres = format!("domain side [{}]", units.name("m"));
        let first = ["case".to_owned(), "status".to_owned()];
        let last = [metres, "warnings".to_owned(), "message".to_owned()];
        Self {
            names: first
                .into_iter()
                .chain(keys)
                .chain(curve.iter().cloned())
                .chain(last)
                .collect(),
            curve: curve.len(),
        }
    }

    /// The first line of the table, without its end.
    #[must_use]
    pub fn header(&self) -> String {
        line(&self.names).trim_end().to_owned()
    }

    /// The rows of a case that has a result: one a loading step.
    #[must_use]
    pub fn solved(study: &Study, case: usize, summary: &Summary) -> String {
        let status = status(summary);
        let side = format!("{:e}", summary.grid.side);
        let codes = summary.warnings.iter().map(|warning| &warning.code[..]);
        let mut codes: Vec<_> = codes.filter(|code| !code.starts_with("cache")).collect();
        codes.sort_unstable();
        codes.dedup();
        let last = [side, codes.join(" "), String::new()];
        let steps = summary.steps.iter().enumerate();
        let row = |(i, step)| {
            let cells = [
                first(study, case, status),
                curve::row(i, step),
                last.to_vec(),
            ];
            line(&cells.concat())
        };
        steps.map(row).collect()
    }

    /// The one row of a case that has none.
    #[must_use]
    pub fn failed(&self, study: &Study, case: usize, message: &str) -> String {
        let empty = vec![String::new(); self.curve + 2];
        // A row is a line: what is read back is cut at its end.
        let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
        let cells = [first(study, case, Status::Failed), empty, vec![message]];
        line(&cells.concat())
    }
}

/// How a case ended that has a result.
#[must_use]
pub fn status(summary: &Summary) -> Status {
    match summary.status {
        pellicle_contact::Status::Certified => Status::Certified,
        pellicle_contact::Status::CutOff => Status::CutOff,
        pellicle_contact::Status::NotConverged => Status::NotConverged,
    }
}

fn first(study: &Study, case: usize, status: Status) -> Vec<String> {
    let choice = study.choice(case);
    let cells = study.axes().iter().zip(choice);
    let cells = cells.map(|(axis, i)| axis.cell(i).to_owned());
    [(case + 1).to_string(), status.word().to_owned()]
        .into_iter()
        .chain(cells)
        .collect()
}

/// The cells as one row with its end. Line ends within a cell stand between quotes.
fn line(cells: &[String]) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Into memory everything can be written, and UTF-8 it stays.
    drop(writer.write_record(cells));
    let bytes = writer.into_inner().unwrap_or_default();
    String::from_utf8(bytes).unwrap_or_default()
}
