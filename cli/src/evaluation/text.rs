//! The numbers of an evaluation on the terminal.

use pellicle::display::{DisplayUnit, significant};
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
        Some(format!(
            "    {} = {}\n",
            of.symbol(),
            words(of, numbers[place]?)
        ))
    });
    printed.collect()
}

/// Most contacts that are listed one by one.
const LISTED: usize = 20;

/// What Oliver and Pharr's formula gives for each contact of a fit, beside its only unknown from that contact alone:
/// how far the base falsifies the formula. Empty without unloadings.
#[must_use]
pub fn beside(contacts: &[Indentation]) -> String {
    let place = |of| IndentationNumber::ALL.iter().position(|one| *one == of);
    let words_of = |contact: &Indentation, of: IndentationNumber| {
        let number = place(of).and_then(|place| contact.numbers[place]);
        number.map_or(String::new(), |number| words(of, number))
    };
    let line = |contact: &Indentation| {
        let depth = words_of(contact, IndentationNumber::ContactDepth);
        let modulus = words_of(contact, IndentationNumber::IndentationModulus);
        let exact = contact
            .exact
            .as_ref()
            .map(|exact| match (exact.value, exact.sd) {
                (Some(value), Some(sd)) => {
                    let number = Uncertain { value, sd };
                    let scale = units::scale(value.abs(), exact.unit);
                    format!(", exactly {} = {}", exact.key, on_scale(number, &scale))
                }
                _ => format!(", no {} in its bounds", exact.key),
            });
        format!(
            "  h_c = {depth}: E_IT = {modulus} by Oliver and Pharr{}\n",
            exact.unwrap_or_default()
        )
    };
    let lines: String = contacts.iter().take(LISTED).map(line).collect();
    match contacts.len().saturating_sub(LISTED) {
        0 => lines,
        more => lines + &format!("  and {more} more contacts, in {}\n", super::table::FILE),
    }
}

/// A number with its standard uncertainty and unit: `72.01 ± 0.31 GPa`.
#[must_use]
pub fn words(of: IndentationNumber, number: Uncertain) -> String {
    let scale = match of {
        IndentationNumber::Creep | IndentationNumber::ElasticWorkRatio => units::percent(),
        of => units::scale(number.value.abs(), of.unit()),
    };
    on_scale(number, &scale)
}

fn on_scale(number: Uncertain, scale: &DisplayUnit) -> String {
    let [value, sd] = [number.value, number.sd].map(|of| of / scale.divisor);
    let sd = if sd > 0.0 {
        format!(" ± {}", significant(sd, 2))
    } else {
        String::new()
    };
    let words = format!("{}{sd} {}", significant(value, 4), scale.label);
    words.trim_end().to_owned()
}
