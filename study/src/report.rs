//! `report.html` of a study, a single page that needs no network: every column against every other, and the failed
//! cases with their reasons. The page itself is `study/templates/study_report.html`.
//!
//! For a long study the page shows a sample, chosen pseudorandomly by case number so that no value of a key is left
//! out. The ranges of the columns and the reasons are those of all cases.

mod column;
mod reasons;

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

use askama::Template;
use pellicle_files::{disk, whole};
use serde::Serialize;

use self::column::{ColumnRow, StudyColumn};
use self::reasons::{Reason, Reasons};
use crate::StudyError;
use crate::case_blocks::CaseBlocks;
use crate::case_status::{CaseStatus, Tally};
use crate::identity::StudyIdentity;
use crate::shard;

/// Name of the file in the folder of a study.
pub const FILE: &str = "report.html";

/// Text near the beginning of the page, by which it is recognised.
const MARK: &str = "<meta name=\"generator\" content=\"pellicle study\">";

/// Bytes in which [`MARK`] is found.
const MARK_WITHIN: u64 = 1000;

/// Approximate number of rows on the page of a longer study: a few MB, drawn in a tenth of a second.
const SAMPLE: usize = 5000;

/// Columns that are not drawn.
const NOT_DRAWN: [&str; 2] = ["case", "message"];

/// The content of a study's tables as the page shows it.
struct StudyTables {
    columns: Vec<StudyColumn>,
    /// Rows of the sample, with a number for each word.
    rows: Vec<SampledRow>,
    rows_read: usize,
    tally: Tally,
    reasons: Reasons,
    /// A case is in the sample if its pseudorandom number does not exceed this.
    share: usize,
}

/// A row in the page's data: the case, and a number for each column, `None` for an empty cell.
#[derive(Serialize)]
struct SampledRow(usize, Vec<Option<f64>>);

/// The data for the page's script.
#[derive(Serialize)]
struct Data<'a> {
    columns: Vec<&'a StudyColumn>,
    rows: Vec<SampledRow>,
}

/// The page, with its numbers as text.
#[derive(Template)]
#[template(path = "study_report.html")]
struct StudyPage<'a> {
    study: &'a str,
    version: &'a str,
    counts: String,
    /// The extent of the sample, if not every row is on the page.
    sample: Option<String>,
    columns: Vec<ColumnRow>,
    reasons: Vec<&'a Reason>,
    /// Number of failed cases whose reasons are not listed.
    others: usize,
    /// JSON without a `<` that could end the script.
    data: String,
}

/// Writes the page for the cases done so far in these tables of one study. Returns false if something else is in its
/// place, which is left untouched.
///
/// # Errors
///
/// [`StudyError`] if a table cannot be read or the page cannot be written.
pub fn write(folder: &Path, parts: &[StudyIdentity]) -> Result<bool, StudyError> {
    let path = folder.join(FILE);
    let Some(first) = parts.first().filter(|_| is_free(&path)) else {
        return Ok(false);
    };
    let mut tables = StudyTables::new(first);
    for part in parts {
        tables.read(&part.table(folder), part)?;
    }
    whole::write_bytes(&path, tables.page(first)?.as_bytes())?;
    Ok(true)
}

/// Removes the page of a study that begins again.
///
/// # Errors
///
/// [`StudyError::File`] if it cannot be removed.
pub fn discard(folder: &Path) -> Result<(), StudyError> {
    let path = folder.join(FILE);
    if !path.is_file() || !is_free(&path) {
        return Ok(());
    }
    disk::remove_file(&path).map_err(|cause| StudyError::write(&path, cause))
}

/// Whether a path is free or holds a page of a study.
fn is_free(path: &PathBuf) -> bool {
    if std::fs::symlink_metadata(path).is_err() {
        return true;
    }
    let mut start = Vec::new();
    let read = File::open(path).and_then(|file| file.take(MARK_WITHIN).read_to_end(&mut start));
    read.is_ok() && String::from_utf8_lossy(&start).contains(MARK)
}

impl StudyTables {
    fn new(identity: &StudyIdentity) -> Self {
        let header = identity.header.as_bytes();
        let mut reader = csv::ReaderBuilder::new().from_reader(header);
        let names = reader.headers().map(|names| {
            let names = names.iter();
            names.map(str::to_owned).collect()
        });
        let names: Vec<String> = names.unwrap_or_default();
        // Case, status, the keys, then the columns of a curve, beginning with the step.
        let keys = names.iter().position(|name| name == "step").unwrap_or(2);
        let columns = names.into_iter().enumerate();
        let columns = columns.map(|(i, name)| StudyColumn::new(name, (2..keys).contains(&i)));
        let most_rows = identity.rows.different().into_iter().max().unwrap_or(1);
        let rows = identity.numbering.case_count().saturating_mul(most_rows);
        Self {
            columns: columns.collect(),
            rows: Vec::new(),
            rows_read: 0,
            tally: Tally::default(),
            reasons: Reasons::default(),
            share: share_of_numbers(SAMPLE, rows),
        }
    }

    /// Reads the complete cases of a table, if it exists.
    fn read(&mut self, path: &Path, identity: &StudyIdentity) -> Result<(), StudyError> {
        if !path.exists() {
            return Ok(());
        }
        let blocks = CaseBlocks::read(path, identity)?;
        for block in &blocks.blocks {
            self.tally.add(block.status);
        }
        let failed = |cause: &dyn std::fmt::Display| StudyError::damaged(path, cause);
        let file = File::open(path).map_err(|cause| failed(&cause))?;
        let text = BufReader::new(file).take(blocks.end);
        let mut reader = csv::ReaderBuilder::new().from_reader(text);
        let mut cells = csv::StringRecord::new();
        while (reader.read_record(&mut cells)).map_err(|cause| failed(&cause))? {
            self.row(&cells);
        }
        Ok(())
    }

    fn row(&mut self, cells: &csv::StringRecord) {
        self.rows_read += 1;
        let case = cells.get(0).and_then(|case| case.parse().ok()).unwrap_or(0);
        if cells.get(1).and_then(CaseStatus::of) == Some(CaseStatus::Failed) {
            let message = cells.iter().next_back().unwrap_or_default();
            self.reasons.add(case, message);
        }
        let columns = self.columns.iter_mut().zip(cells);
        let values = columns.map(|(column, cell)| column.add(cell));
        // Every cell is read, for the ranges.
        let values: Vec<_> = values.collect();
        if shard::mixed(case) <= self.share {
            self.rows.push(SampledRow(case, values));
        }
    }

    fn page(self, identity: &StudyIdentity) -> Result<String, StudyError> {
        let is_drawn =
            |column: &StudyColumn| !NOT_DRAWN.contains(&&*column.name) && !column.is_empty();
        let drawn: Vec<_> = self.columns.iter().map(is_drawn).collect();
        let of_drawn = |SampledRow(case, values)| {
            let values = values.into_iter().zip(&drawn);
            let values = values.filter_map(|(value, is_drawn)| is_drawn.then_some(value));
            SampledRow(case, values.collect())
        };
        let shown = self.rows.len();
        let data = Data {
            columns: self.columns.iter().filter(|c| is_drawn(c)).collect(),
            rows: self.rows.into_iter().map(of_drawn).collect(),
        };
        let data_text = serde_json::to_string(&data)?.replace('<', "\\u003c");
        let cases = identity.numbering.case_count();
        let reasons = self.reasons.sorted();
        let listed: usize = reasons.iter().map(|reason| reason.cases).sum();
        let page = StudyPage {
            study: &identity.study,
            version: &identity.version,
            counts: self.tally.words(cases),
            sample: (shown < self.rows_read).then(|| {
                format!(
                    "{shown} of {} rows are drawn, a random sample of the cases; ranges and reasons cover all cases.",
                    self.rows_read
                )
            }),
            columns: data.columns.iter().map(|column| column.row()).collect(),
            others: self.tally.failed - listed.min(self.tally.failed),
            reasons,
            data: data_text,
        };
        Ok(page.to_string())
    }
}

/// The limit on the pseudorandom numbers that selects a share `wanted / all` of the cases.
fn share_of_numbers(wanted: usize, all: usize) -> usize {
    let largest = u32::MAX as usize;
    if wanted >= all {
        return largest;
    }
    largest / all * wanted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_has_about_the_wanted_size_and_contains_every_value_of_a_key() {
        let share = share_of_numbers(5000, 1_000_000);
        let is_in = |case: &usize| shard::mixed(*case) <= share;
        let sample: Vec<_> = (1..=1_000_000).filter(is_in).collect();
        // Three standard deviations.
        assert!((4780..5220).contains(&sample.len()), "{}", sample.len());
        for last in 0..100 {
            assert!(sample.iter().any(|case| case % 100 == last), "{last}");
        }
        assert_eq!(share_of_numbers(5000, 5000), u32::MAX as usize);
    }
}
