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

/// Describes the result: a few lines for an unloading, one for a reading of a continuous stiffness, of which a few at
/// depths far apart.
#[must_use]
pub fn text(result: &EvaluationResult) -> String {
    let of_files = result
        .indentation
        .chunk_by(|one, next| one.file == next.file);
    let curves: String = of_files.map(of_file).collect();
    let repeats = |of: &Repeats| {
        let count = of.curves.len();
        format!(
            "  mean of {count} curves, ± the standard deviation between them\n{}",
            lines(&of.numbers)
        )
    };
    let means: String = result.repeats.iter().map(repeats).collect();
    format!("{}\n{curves}{means}", result.title)
}

/// The contacts of one file.
fn of_file(contacts: &[Indentation]) -> String {
    let count = contacts.len();
    if !contacts.iter().all(|of| of.is_reading) {
        let all = names(contacts).into_iter().zip(contacts);
        let all = all.map(|(name, of)| format!("  {name}\n{}", lines(&of.numbers)));
        return all.collect::<Vec<_>>().concat();
    }
    let steps = count.min(READINGS);
    let places = (1..=steps).map(|step| (step * count).div_ceil(steps) - 1);
    let readings: Vec<_> = places.map(|place| reading(&contacts[place])).collect();
    let (file, table) = (&contacts[0].file, super::table::FILE);
    format!(
        "  {file}: {count} readings, all in {table}\n{}",
        readings.concat()
    )
}

/// The name of each contact: its file, and which of several in it.
#[must_use]
pub fn names(contacts: &[Indentation]) -> Vec<String> {
    let of_file = |contacts: &[Indentation]| -> Vec<String> {
        let count = contacts.len();
        let name = |(place, of): (usize, &Indentation)| {
            let what = if of.is_reading {
                "reading"
            } else {
                "unloading"
            };
            match count {
                1 => of.file.clone(),
                _ => format!("{}, {what} {} of {count}", of.file, place + 1),
            }
        };
        contacts.iter().enumerate().map(name).collect()
    };
    let files = contacts.chunk_by(|one, next| one.file == next.file);
    files.flat_map(of_file).collect()
}

/// Modulus and hardness at a depth, on one line.
fn reading(of: &Indentation) -> String {
    let [depth, numbers @ ..] = [
        IndentationNumber::ContactDepth,
        IndentationNumber::IndentationModulus,
        IndentationNumber::IndentationHardness,
    ]
    .map(|number| format!("{} = {}", number.symbol(), words_of(of, number)));
    format!("    {depth}: {}\n", numbers.join(", "))
}

/// A number of a contact in words; empty where it does not have it.
fn words_of(contact: &Indentation, of: IndentationNumber) -> String {
    contact.numbers[of.place()].map_or(String::new(), |number| words(of, number))
}

fn lines(numbers: &[Option<Uncertain>]) -> String {
    let printed = PRINTED.into_iter().filter_map(|of| {
        Some(format!(
            "    {} = {}\n",
            of.symbol(),
            words(of, numbers[of.place()]?)
        ))
    });
    printed.collect()
}

/// Readings of a continuous stiffness that are printed of a file.
const READINGS: usize = 8;
/// Most contacts that are listed one by one.
const LISTED: usize = 20;

/// What Oliver and Pharr's formula gives for each contact of a fit, beside its only unknown from that contact alone:
/// how far the base falsifies the formula. Empty without unloadings.
#[must_use]
pub fn beside(contacts: &[Indentation]) -> String {
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
