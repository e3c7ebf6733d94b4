//! `indentation.csv`: the numbers of every curve, in SI units, each with its standard uncertainty.

use pellicle_files::cell::text_cell;
use pellicle_identify::indentation::IndentationNumber;

use super::result::Indentation;

/// Name of the file in a folder of results.
pub const FILE: &str = "indentation.csv";

/// The table of these contacts.
#[must_use]
pub fn table(contacts: &[Indentation]) -> String {
    let names = IndentationNumber::ALL.map(|of| head(of.name(), of.unit()));
    let exact = contacts.iter().find_map(|of| of.exact.as_ref());
    let exact = exact.map(|of| head(&of.key, of.unit));
    let names: Vec<String> = names.into_iter().chain(exact).collect();
    let row = |of: &Indentation| {
        let numbers = of.numbers.iter().map(|number| match number {
            Some(number) => cells(Some(number.value), Some(number.sd)),
            None => cells(None, None),
        });
        let exact = of.exact.as_ref().map(|of| cells(of.value, of.sd));
        let cells: Vec<String> = numbers.chain(exact).collect();
        format!("{},{},{}\n", text_cell(&of.file), of.curve, cells.join(","))
    };
    let rows: String = contacts.iter().map(row).collect();
    format!("file,curve,{}\n{rows}", names.join(","))
}

fn head(name: &str, unit: &str) -> String {
    format!("{name} [{unit}],{name} sd [{unit}]")
}

fn cells(value: Option<f64>, sd: Option<f64>) -> String {
    let cell = |number: Option<f64>| number.map(|of| format!("{of:e}")).unwrap_or_default();
    format!("{},{}", cell(value), cell(sd))
}
