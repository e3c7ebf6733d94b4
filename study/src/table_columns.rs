//! The columns of a study's table: case, status, the varied keys, and those of a curve.
//!
//! They are the same for all cases. Columns that not every case has, as those of a hardness, of stresses and of rough
//! contact, are present if any of the cases tried before the study begins has them, and empty in the rows of the
//! others.

use pellicle::case::Case;
use pellicle::input::units::Units;
use pellicle::result::table::numbers::NumberColumns;
use pellicle::result::table::stress::StressColumns;
use pellicle::summary::{RunSummary, StepSummary};
use pellicle_contact::CriticalLoad;
use pellicle_files::cell::made_plain;

use crate::Study;
use crate::case_status::CaseStatus;

/// The columns, with units.
#[derive(Debug, Clone)]
pub struct TableColumns {
    names: Vec<String>,
    /// Number of columns of results.
    of_results: usize,
    results: ResultColumns,
}

/// The columns of the results.
#[derive(Debug, Clone)]
pub struct ResultColumns {
    numbers: NumberColumns,
    stress: StressColumns,
}

impl Default for ResultColumns {
    fn default() -> Self {
        Self {
            numbers: NumberColumns::of_every_case(),
            stress: StressColumns::default(),
        }
    }
}

impl ResultColumns {
    /// Adds the columns of a case that are not there yet.
    pub fn add(&mut self, case: &Case) {
        self.numbers.add(case);
        self.stress.add(case);
    }

    /// Their names, with units.
    #[must_use]
    pub fn header(&self, units: Units) -> Vec<String> {
        [self.numbers.header(units), self.stress.header(units)].concat()
    }

    /// Their cells in the row of a step.
    #[must_use]
    pub fn row(&self, i: usize, step: &StepSummary, critical: &[CriticalLoad]) -> Vec<String> {
        [self.numbers.row(i, step), self.stress.row(step, critical)].concat()
    }
}

impl TableColumns {
    /// Returns the columns of a study whose cases have these units and results.
    #[must_use]
    pub fn new(study: &Study, units: Units, results: ResultColumns) -> Self {
        let of_results = results.header(units);
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
                .chain(of_results.iter().cloned())
                .chain(last)
                .collect(),
            of_results: of_results.len(),
            results,
        }
    }

    /// Returns the first line of the table, without its line end.
    #[must_use]
    pub fn header(&self) -> String {
        line(&self.names).trim_end().to_owned()
    }

    /// Returns the rows of a case with a result, one per loading step.
    #[must_use]
    pub fn solved(&self, study: &Study, case: usize, summary: &RunSummary) -> String {
        let status = status(summary);
        let side = format!("{:e}", summary.grid.side);
        let codes = summary.warnings.iter().map(|warning| &warning.code[..]);
        let mut codes: Vec<_> = codes.filter(|code| !code.starts_with("cache")).collect();
        codes.sort_unstable();
        codes.dedup();
        let first = first(study, case, status);
        let last = [side, codes.join(" "), String::new()];
        let critical = summary.critical.as_deref().unwrap_or_default();
        let row = |(i, step)| {
            let results = self.results.row(i, step, critical);
            let cells = [&first[..], &results, &last];
            line(&cells.concat())
        };
        summary.steps.iter().enumerate().map(row).collect()
    }

    /// Returns the one row of a case without a result.
    #[must_use]
    pub fn failed(&self, study: &Study, case: usize, message: &str) -> String {
        let empty = vec![String::new(); self.of_results + 2];
        // A row is one line: a message with line ends would be cut when it is read back.
        let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
        let message = made_plain(&message);
        let cells = [first(study, case, CaseStatus::Failed), empty, vec![message]];
        line(&cells.concat())
    }
}

/// Returns the status of a case with a result.
#[must_use]
pub fn status(summary: &RunSummary) -> CaseStatus {
    match summary.status {
        pellicle_contact::Status::Certified => CaseStatus::Certified,
        pellicle_contact::Status::CutOff => CaseStatus::CutOff,
        pellicle_contact::Status::BeyondModel => CaseStatus::BeyondModel,
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

/// Writes the cells as one row with its line end. Line ends within a cell are quoted.
fn line(cells: &[String]) -> String {
    let bytes = cells.iter().map(|cell| cell.len() + 1).sum();
    let mut writer = csv::WriterBuilder::new();
    let mut writer = writer.buffer_capacity(bytes).from_writer(Vec::new());
    // Writing to memory cannot fail, and the text stays UTF-8.
    drop(writer.write_record(cells));
    let bytes = writer.into_inner().unwrap_or_default();
    String::from_utf8(bytes).unwrap_or_default()
}
