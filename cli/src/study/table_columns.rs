//! The columns of a study's table: case, status, the keys that vary, and those of a curve.

use super::Study;
use super::case_status::CaseStatus;
use crate::case::units::Units;
use crate::output::curve;
use crate::output::curve::stress::StressColumns;
use crate::output::summary::Summary;

/// The columns, with units.
#[derive(Debug, Clone, PartialEq)]
pub struct TableColumns {
    names: Vec<String>,
    /// The number of columns of a curve and of stresses.
    curve: usize,
    stress: StressColumns,
}

impl TableColumns {
    /// The columns of a study whose cases have these units and ask for these stresses.
    #[must_use]
    pub fn new(study: &Study, units: Units, stress: StressColumns) -> Self {
        let curve = [curve::header(units), stress.header(units)].concat();
        let keys = study
            .varied_keys()
            .iter()
            .map(super::varied_key::VariedKey::heading);
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
            stress,
        }
    }

    /// The first line of the table, without its end.
    #[must_use]
    pub fn header(&self) -> String {
        line(&self.names).trim_end().to_owned()
    }

    /// The rows of a case that has a result, one per loading step.
    #[must_use]
    pub fn solved(&self, study: &Study, case: usize, summary: &Summary) -> String {
        let status = status(summary);
        let side = format!("{:e}", summary.grid.side);
        let codes = summary.warnings.iter().map(|warning| &warning.code[..]);
        let mut codes: Vec<_> = codes.filter(|code| !code.starts_with("cache")).collect();
        codes.sort_unstable();
        codes.dedup();
        let last = [side, codes.join(" "), String::new()];
        let steps = summary.steps.iter().enumerate();
        let critical = summary.critical.as_deref().unwrap_or_default();
        let row = |(i, step)| {
            let cells = [
                first(study, case, status),
                curve::row(i, step),
                self.stress.row(step, critical),
                last.to_vec(),
            ];
            line(&cells.concat())
        };
        steps.map(row).collect()
    }

    /// The one row of a case without a result.
    #[must_use]
    pub fn failed(&self, study: &Study, case: usize, message: &str) -> String {
        let empty = vec![String::new(); self.curve + 2];
        // A row is a line: a message with line ends would be cut when it is read back.
        let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
        let cells = [first(study, case, CaseStatus::Failed), empty, vec![message]];
        line(&cells.concat())
    }
}

/// The status of a case that has a result.
#[must_use]
pub fn status(summary: &Summary) -> CaseStatus {
    match summary.status {
        pellicle_contact::Status::Certified => CaseStatus::Certified,
        pellicle_contact::Status::CutOff => CaseStatus::CutOff,
        pellicle_contact::Status::NotConverged => CaseStatus::NotConverged,
    }
}

fn first(study: &Study, case: usize, status: CaseStatus) -> Vec<String> {
    let choice = study.choice(case);
    let cells = study.varied_keys().iter().zip(choice);
    let cells = cells.map(|(varied, i)| varied.cell(i).into_owned());
    [(case + 1).to_string(), status.word().to_owned()]
        .into_iter()
        .chain(cells)
        .collect()
}

/// The cells as one row with its line end. Line ends within a cell are quoted.
fn line(cells: &[String]) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Writing to memory cannot fail, and the text stays UTF-8.
    drop(writer.write_record(cells));
    let bytes = writer.into_inner().unwrap_or_default();
    String::from_utf8(bytes).unwrap_or_default()
}
