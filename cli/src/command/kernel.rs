//! `pellicle kernel`: the compliance and the response of a foundation, by wavenumber.

use pellicle::case::Case;
use pellicle::input::units::Units;
use pellicle_files::json;
use serde::Serialize;

use crate::arguments::KernelArguments;
use crate::command::Outcome;
use crate::failure::Failure;
use crate::terminal;

/// Compliance and response at one wavenumber.
#[derive(Debug, Clone, Copy, Serialize)]
struct ComplianceRow {
    /// `k`, 1/m.
    wavenumber: f64,
    /// `C(k)`, m/Pa.
    compliance: f64,
    /// `Φ`.
    response: f64,
}

/// Prints a row for each wavenumber.
///
/// # Errors
///
/// [`Failure`] if the case cannot be read or its foundation is invalid.
pub fn kernel(arguments: &KernelArguments) -> Result<Outcome, Failure> {
    let case = Case::read(&arguments.case.path, &arguments.case.sets)?;
    let foundation = case.foundation.split()?.foundation;
    let row = |&wavenumber: &f64| ComplianceRow {
        wavenumber,
        compliance: foundation.compliance(wavenumber),
        response: foundation.response(wavenumber),
    };
    let rows: Vec<_> = arguments.wavenumbers.iter().map(row).collect();
    let text = if arguments.json {
        json(&rows)?
    } else {
        table(&rows, case.units)
    };
    terminal::print(&text)?;
    Ok(Outcome::Done)
}

fn table(rows: &[ComplianceRow], units: Units) -> String {
    let (per_metre, metre_per_pascal) = (units.name("1/m"), units.name("m/Pa"));
    let head = [
        format!("k [{per_metre}]"),
        format!("C(k) [{metre_per_pascal}]"),
        "Φ".into(),
    ];
    let row = |row: &ComplianceRow| line([row.wavenumber, row.compliance, row.response].map(exact));
    line(head) + &rows.iter().map(row).collect::<String>()
}

fn line(cells: [String; 3]) -> String {
    cells.map(|cell| format!("{cell:>24}")).concat() + "\n"
}

fn exact(value: f64) -> String {
    format!("{value:e}")
}
