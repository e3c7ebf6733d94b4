//! Measured curves of seven kinds of instruments, read as a fit file specifies, and compared with numbers taken from
//! the files by hand.

#![expect(
    clippy::unreadable_literal,
    reason = "the numbers are written as in the files"
)]

use std::path::Path;
use std::sync::Arc;

use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::span::Source;
use pellicle_identify::measured::curve::MeasuredCurve;
use pellicle_identify::measured::data_table::DataTable;
use pellicle_identify::measured::exclusion::ExclusionReason;

mod cantilevers;
mod draft;
mod exports;
mod instruments;
mod invented;
mod stated;
mod tables;
mod tungsten;

/// Reads the curves of one table `[[data]]`, with files in this folder.
fn read(table: &str) -> Result<Vec<MeasuredCurve>, Diagnosis> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/curves");
    let text = format!("[[data]]\n{table}\n");
    let source = Arc::new(Source::new("fit.toml", text));
    let tables = DataTable::parse_all(&source, &folder)?;
    assert_eq!(tables.len(), 1);
    MeasuredCurve::read_all(&tables[0])
}

/// The only curve of a table.
fn one(table: &str) -> MeasuredCurve {
    let mut curves = read(table).expect("the files are curves");
    assert_eq!(curves.len(), 1, "{table}");
    curves.remove(0)
}

/// Returns the sentence of a table's diagnosis.
fn refused(table: &str) -> String {
    read(table).expect_err("some file is none").to_string()
}

/// Number of rows left out for a reason.
fn excluded(curve: &MeasuredCurve, reason: ExclusionReason) -> usize {
    let found = curve.excluded.iter().find(|found| found.reason == reason);
    found.map_or(0, |found| found.count)
}

fn codes(curve: &MeasuredCurve) -> Vec<&str> {
    curve.warnings.iter().map(|warning| warning.code).collect()
}

/// Checks the first and the last value. The tolerance allows one rounding of the number and one of its product with the
/// unit.
fn check_ends(values: Option<&[f64]>, first: f64, last: f64) {
    let values = values.expect("the column was read");
    let ends = [(values[0], first), (values[values.len() - 1], last)];
    for (found, wanted) in ends {
        assert!(
            (found - wanted).abs() <= 4e-16 * wanted.abs(),
            "{found:e}, not {wanted:e}"
        );
    }
}
