//! `indentation.csv`: the numbers of every curve, in SI units, each with its standard uncertainty.

use pellicle_files::cell::text_cell;
use pellicle_identify::indentation::IndentationNumber;

use super::result::Indentation;

/// Name of the file in a folder of results.
pub const FILE: &str = "indentation.csv";

/// The table of these curves.
#[must_use]
pub fn table(curves: &[Indentation]) -> String {
    let names = IndentationNumber::ALL.map(|of| {
        let (name, unit) = (of.name(), of.unit());
        format!("{name} [{unit}],{name} sd [{unit}]")
    });
    let row = |of: &Indentation| {
        let cells = of.numbers.iter().map(|number| match number {
            Some(number) => format!("{:e},{:e}", number.value, number.sd),
            None => ",".to_owned(),
        });
        let cells: Vec<String> = cells.collect();
        format!("{},{},{}\n", text_cell(&of.file), of.curve, cells.join(","))
    };
    format!("file,curve,{}\n", names.join(",")) + &curves.iter().map(row).collect::<String>()
}
