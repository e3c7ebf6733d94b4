//! The numbers of an evaluation on the terminal.

use pellicle::display::significant;
use pellicle_identify::indentation::{IndentationNumber, Uncertain};

use super::result::{EvaluationResult, Indentation, Repeats};
use crate::identification::units;

/// The numbers that are printed.
const PRINTED: [IndentationNumber; 7] = [
    IndentationNumber::IndentationModulus,
    IndentationNumber::IndentationHardness,
    IndentationNumber::ContactDepth,
    IndentationNumber::ContactStiffness,
    IndentationNumber::Exponent,
    IndentationNumber::Creep,
    IndentationNumber::DriftRate,
];

/// Describes the result, a few lines per curve.
#[must_use]
pub fn text(result: &EvaluationResult) -> String {
    let curve = |of: &Indentation| format!("  {}\n{}", of.file, lines(&of.numbers));
    let repeats = |of: &Repeats| {
        let count = of.curves.len();
        format!(
            "  mean of {count} curves, ± the standard deviation between them\n{}",
            lines(&of.numbers)
        )
    };
    let curves: String = result.indentation.iter().map(curve).collect();
    let means: String = result.repeats.iter().map(repeats).collect();
    format!("{}\n{curves}{means}", result.title)
}

fn lines(numbers: &[Option<Uncertain>]) -> String {
    let printed = PRINTED.into_iter().filter_map(|of| {
        let place = IndentationNumber::ALL.iter().position(|one| *one == of)?;
        Some(format!("    {} = {}\n", of.symbol(), words(of, numbers[place]?)))
    });
    printed.collect()
}

/// A number with its standard uncertainty and unit: `72.01 ± 0.31 GPa`.
#[must_use]
pub fn words(of: IndentationNumber, number: Uncertain) -> String {
    let scale = match of {
        IndentationNumber::Creep | IndentationNumber::ElasticWorkRatio => units::percent(),
        of => units::scale(number.value.abs(), of.unit()),
    };
    let [value, sd] = [number.value, number.sd].map(|of| of / scale.divisor);
    let sd = if sd > 0.0 {
        format!(" ± {}", significant(sd, 2))
    } else {
        String::new()
    };
    format!("{}{sd} {}", significant(value, 4), scale.label)
        .trim_end()
        .to_owned()
}
