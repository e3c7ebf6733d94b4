//! A section of the validation, which is one kind of evidence, its comparisons, and their table for the terminal.

use pellicle::display::significant;

use crate::comparison::{ComparedValue, Comparison, RowVerdict};
use crate::run::{ValidationError, ValidationRun};

/// Digits of a number in the table; JSON has all.
const DIGITS: usize = 9;

/// Characters of the longest word that fits its column.
const MAX_WORD_LENGTH: usize = 14;

/// One kind of evidence.
#[derive(Debug)]
pub struct ValidationSection {
    /// Its name.
    pub name: &'static str,
    /// The source of the references.
    pub source: &'static str,
    /// The scale of the errors, and the cause of the tolerance.
    pub because: &'static str,
    /// Computes its comparisons in a run.
    pub rows: fn(ValidationRun) -> Result<Vec<Comparison>, ValidationError>,
}

/// The comparisons of a section.
#[derive(Debug, Clone)]
pub struct SectionResult {
    /// The section.
    pub section: &'static ValidationSection,
    /// The comparisons.
    pub rows: Vec<Comparison>,
}

impl ValidationSection {
    /// Computes the section. If that fails, its only row gives the reason and fails.
    #[must_use]
    pub fn compute(&'static self, run: ValidationRun) -> SectionResult {
        let failed = |error| vec![Comparison::failed(self.name.into(), &error)];
        SectionResult {
            section: self,
            rows: (self.rows)(run).unwrap_or_else(failed),
        }
    }
}

/// Returns the names of the columns.
#[must_use]
pub fn heading() -> String {
    let cells = ["reference", "computed", "error", "tolerance", "verdict"];
    line("check", cells)
}

/// Writes a section: its name, its rows, and the sources of its references and tolerances.
#[must_use]
pub fn section_text(section: &SectionResult) -> String {
    let rows: String = section.rows.iter().map(row).collect();
    let ValidationSection {
        name,
        source,
        because,
        ..
    } = section.section;
    format!("\n{name}\n{rows}  reference: {source}\n  error: {because}\n")
}

fn row(row: &Comparison) -> String {
    let verdict = match row.verdict {
        RowVerdict::Pass => "pass",
        RowVerdict::Fail => "FAIL",
    };
    let (reference, computed) = (value(&row.reference), value(&row.computed));
    // An error message is put on its own line.
    let (computed, reason) = if computed.chars().count() > MAX_WORD_LENGTH {
        ("none".to_owned(), format!("      {computed}\n"))
    } else {
        (computed, String::new())
    };
    let [error, tolerance] = [row.error, row.tolerance].map(small);
    let cells = [&reference, &computed, &error, &tolerance, verdict];
    line(&format!("  {}", row.check), cells) + &reason
}

fn line(check: &str, [reference, computed, error, tolerance, verdict]: [&str; 5]) -> String {
    format!("{check:<54}{reference:>16}{computed:>16}{error:>10}{tolerance:>11}  {verdict}\n")
}

fn value(value: &ComparedValue) -> String {
    match value {
        ComparedValue::Number(number) => significant(*number, DIGITS),
        ComparedValue::Word(word) => word.clone(),
    }
}

fn small(number: f64) -> String {
    if number == 0.0 {
        "0".into()
    } else {
        format!("{number:.1e}")
    }
}
