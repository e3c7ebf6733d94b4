//! The numbers of a study's table by case, as pictures show them.

use std::path::Path;

use crate::StudyError;
use crate::case_status::CaseStatus;
use crate::folder;
use crate::result_column::{ResultColumn, parts};
use crate::shard::Shard;

/// The rows of a study's table, one for each case.
#[derive(Debug, Clone, PartialEq)]
pub struct StudySeries {
    /// Name of the study.
    pub study: String,
    /// The varied keys.
    pub keys: Vec<KeyColumn>,
    /// Names of all columns.
    pub header: Vec<String>,
    /// Of each case the row of its last loading step, or of that asked for.
    rows: Vec<csv::StringRecord>,
}

/// The column of a varied key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KeyColumn {
    /// The key.
    pub name: String,
    /// The unit of its values, if they have one.
    pub unit: Option<String>,
    /// Its place.
    place: usize,
}

/// A number of a certified case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CaseNumber {
    /// The number.
    pub value: f64,
    /// Its ±.
    pub error: NumberError,
}

/// The ± of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NumberError {
    /// The number has none.
    None,
    /// Half the width of its interval.
    Resolved(f64),
    /// The grids do not resolve it.
    NotResolved,
}

impl StudySeries {
    /// Reads the table of a study that is not in parts; of each case the last loading step, or that asked for.
    ///
    /// # Errors
    ///
    /// [`StudyError`] if there is no such table, or it cannot be read.
    pub fn read(path: &Path, step: Option<usize>) -> Result<Self, StudyError> {
        let parts_of = folder::identities(path)?;
        let whole = parts_of.iter().find(|part| part.shard == Shard::WHOLE);
        let whole = whole.ok_or_else(|| StudyError::NoParts {
            path: path.to_owned(),
        })?;
        let table = whole.table(path);
        let failed = |cause: csv::Error| StudyError::damaged(&table, &cause);
        let mut reader = csv::Reader::from_path(&table).map_err(failed)?;
        let header: Vec<_> = reader
            .headers()
            .map_err(failed)?
            .iter()
            .map(str::to_owned)
            .collect();
        let column = header.iter().position(|name| name == "step").unwrap_or(2);
        let mut rows: Vec<csv::StringRecord> = Vec::new();
        for row in reader.records() {
            let row = row.map_err(failed)?;
            let is_wanted = |wanted: usize| {
                row.get(column)
                    .is_some_and(|cell| cell.is_empty() || cell == wanted.to_string())
            };
            if !step.is_none_or(is_wanted) {
                continue;
            }
            match rows.last_mut() {
                Some(last) if last.get(0) == row.get(0) => *last = row,
                _ => rows.push(row),
            }
        }
        let keys = header.iter().enumerate().take(column).skip(2);
        let keys = keys.map(|(place, name)| {
            let (name, unit) = parts(name);
            KeyColumn {
                name: name.to_owned(),
                unit: unit.map(str::to_owned),
                place,
            }
        });
        Ok(Self {
            study: whole.study.clone(),
            keys: keys.collect(),
            header,
            rows,
        })
    }

    /// Number of cases.
    #[must_use]
    pub fn cases(&self) -> usize {
        self.rows.len()
    }

    /// The value of a key in a case, as in the table.
    #[must_use]
    pub fn word(&self, case: usize, key: &KeyColumn) -> &str {
        self.rows
            .get(case)
            .and_then(|row| row.get(key.place))
            .unwrap_or_default()
    }

    /// The numbers of a key in all cases; none if it has other values.
    #[must_use]
    pub fn numbers(&self, key: &KeyColumn) -> Option<Vec<f64>> {
        let cases = 0..self.rows.len();
        cases
            .map(|case| self.word(case, key).parse().ok())
            .collect()
    }

    /// A number of the result in a case; none if the case is not certified or does not have it.
    #[must_use]
    pub fn number(&self, case: usize, result: &ResultColumn) -> Option<CaseNumber> {
        let row = self.rows.get(case)?;
        if CaseStatus::of(row.get(1)?) != Some(CaseStatus::Certified) {
            return None;
        }
        let cell = |place: usize| row.get(place)?.parse::<f64>().ok();
        let error = result.error.map(cell);
        Some(CaseNumber {
            value: cell(result.value)?,
            error: error.map_or(NumberError::None, |error| {
                error.map_or(NumberError::NotResolved, NumberError::Resolved)
            }),
        })
    }
}
