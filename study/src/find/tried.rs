//! The cases that a search has tried, and their table `find.csv`.

use pellicle::result::quantity::cell;
use pellicle_files::cell::made_plain;

use super::Search;
use crate::case_status::CaseStatus;

/// Name of the table in the folder of a search.
pub const FILE: &str = "find.csv";

/// A case that was tried.
#[derive(Debug, Clone, PartialEq)]
pub struct Tried {
    /// The value of the key.
    pub key: f64,
    /// The status of the case.
    pub status: CaseStatus,
    /// The number of its last loading step; infinite for a critical force that is above the largest load of the case
    /// and the limit.
    pub number: Option<f64>,
    /// Its ±, if it has one that is resolved.
    pub error: Option<f64>,
    /// Whether its ± is resolved; none if the number has no ±.
    pub resolved: Option<bool>,
    /// Codes of the warnings.
    pub warnings: String,
    /// The reason for a failure, or for a missing number.
    pub message: String,
}

impl Tried {
    /// A case without a result.
    #[must_use]
    pub fn failed(key: f64, message: String) -> Self {
        Self {
            key,
            status: CaseStatus::Failed,
            number: None,
            error: None,
            resolved: None,
            warnings: String::new(),
            message,
        }
    }

    /// The number, if the case is certified and has it.
    #[must_use]
    pub fn certified(&self) -> Option<f64> {
        let is_certified = self.status == CaseStatus::Certified;
        self.number
            .filter(|number| is_certified && !number.is_nan())
    }

    /// The numbers between which the true one lies: the number itself if it has no ±, none if its ± is not resolved.
    #[must_use]
    pub fn band(&self) -> Option<[f64; 2]> {
        let number = self.certified()?;
        if number.is_infinite() {
            return Some([number; 2]);
        }
        match (self.error, self.resolved) {
            (Some(error), _) => Some([number - error, number + error]),
            (None, None) => Some([number; 2]),
            (None, Some(_)) => None,
        }
    }

    /// Why the case has no number that counts.
    #[must_use]
    pub fn reason(&self) -> String {
        match (self.status, self.message.as_str()) {
            (CaseStatus::Certified, message) => message.to_owned(),
            (CaseStatus::Failed, message) => format!("failed: {message}"),
            (status, _) if self.warnings.is_empty() => format!("is {}", status.word()),
            (status, _) => format!("is {} ({})", status.word(), self.warnings),
        }
    }

    fn cells(&self, case: usize) -> [String; 8] {
        [
            (case + 1).to_string(),
            self.status.word().to_owned(),
            cell(Some(self.key)),
            cell(self.number),
            cell(self.error),
            self.resolved
                .map_or_else(String::new, |resolved| resolved.to_string()),
            self.warnings.clone(),
            made_plain(&self.message),
        ]
    }

    fn of_cells(row: &csv::StringRecord) -> Option<Self> {
        let number = |place: usize| row.get(place)?.parse::<f64>().ok();
        Some(Self {
            key: number(2)?,
            status: CaseStatus::of(row.get(1)?)?,
            number: number(3),
            error: number(4),
            resolved: row.get(5)?.parse().ok(),
            warnings: row.get(6)?.to_owned(),
            message: row.get(7)?.to_owned(),
        })
    }
}

/// Writes the table.
#[must_use]
pub fn table(search: &Search, tried: &[Tried]) -> String {
    let result = &search.condition.result;
    let header = [
        "case".into(),
        "status".into(),
        search.key.heading(),
        result.heading(),
        result.error_heading(),
        format!("{} resolved", result.name),
        "warnings".into(),
        "message".into(),
    ];
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Writing to memory cannot fail, and the text stays UTF-8.
    drop(writer.write_record(&header));
    for (case, tried) in tried.iter().enumerate() {
        drop(writer.write_record(tried.cells(case)));
    }
    String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
}

/// Reads the rows of a table; those that a kill has cut off are left out.
#[must_use]
pub fn read(table: &str) -> Vec<Tried> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let rows = reader.records().filter_map(Result::ok);
    rows.filter_map(|row| Tried::of_cells(&row)).collect()
}
