//! The columns of a table that a draft reads, and their units as far as the header states them.

use super::DraftKind;
use super::column_guess::{self, ColumnGuess};
use super::words::quoted;
use crate::measured::channel::Channel;
use crate::measured::header::{HeaderField, HeaderUnit};
use crate::measured::text_options::TextOptions;
use crate::measured::text_table::TextTable;

/// A column that is read.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SurveyedColumn {
    /// Its quantity.
    pub(super) channel: Channel,
    /// Its number, from 1.
    pub(super) number: usize,
    /// Its heading; empty if there is none.
    pub(super) heading: String,
    /// Whether the heading names this column alone.
    pub(super) is_unique: bool,
    /// Its unit.
    pub(super) unit: SurveyedUnit,
    /// Numbers and headings of other columns that may as well be the quantity.
    pub(super) rivals: Vec<(usize, String)>,
}

impl SurveyedColumn {
    /// The other columns that may as well be the quantity, in words; none if there are none.
    pub(super) fn other_columns(&self) -> Option<String> {
        let other = |(number, heading): &(usize, String)| format!("{number}, {}", quoted(heading));
        let others: Vec<_> = self.rivals.iter().map(other).collect();
        (!others.is_empty()).then(|| others.join(", or "))
    }
}

/// The unit of a column.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum SurveyedUnit {
    /// The header states it.
    Stated(String),
    /// It is assumed.
    Assumed(&'static str),
    /// A deflection in volts has this sensitivity, m/V.
    Sensitivity(f64),
}

/// The quantities that the columns of a table may hold; none if it has no header and its numbers do not tell.
pub(super) fn guesses(table: &TextTable<'_>, options: &TextOptions) -> Option<Vec<ColumnGuess>> {
    let mut columns = vec![Vec::with_capacity(table.rows.len()); table.columns];
    for row in &table.rows {
        let fields = table.separator.fields(row);
        for (place, values) in columns.iter_mut().enumerate() {
            let number = fields
                .get(place)
                .and_then(|field| options.decimal.number(field));
            values.push(number.unwrap_or(f64::NAN));
        }
    }
    if table.header.is_empty() {
        return column_guess::of_numbers(&columns);
    }
    // Instruments write columns of what they did not measure.
    let named = table.header.iter().zip(&columns).map(|(head, values)| {
        if values.iter().all(|value| value.is_nan()) {
            HeaderField::new("")
        } else {
            head.clone()
        }
    });
    Some(column_guess::of_header(&named.collect::<Vec<_>>()))
}

/// The columns to read, and whether they are those of a cantilever; none if they make no curve.
pub(super) fn chosen(
    guesses: &[ColumnGuess],
    kind: DraftKind,
    states_spring: bool,
) -> Option<(Vec<ColumnGuess>, bool)> {
    let find = |channel| {
        guesses
            .iter()
            .find(|guess| guess.channel == channel)
            .copied()
    };
    let (force, depth, height) = (
        find(Channel::Force),
        find(Channel::Depth),
        find(Channel::Height),
    );
    let load = force.or(find(Channel::Deflection));
    let prefers_height = kind == DraftKind::Afm || states_spring || depth.is_none();
    let time = find(Channel::Time);
    let prefers_height = prefers_height && kind != DraftKind::Unloading;
    if let (Some(height), Some(load), true) = (height, load, prefers_height) {
        let columns = [Some(height), Some(load), time];
        return Some((columns.into_iter().flatten().collect(), true));
    }
    let columns = [Some(depth?), Some(force?), find(Channel::Stiffness), time];
    Some((columns.into_iter().flatten().collect(), false))
}

/// The columns chosen, with their headings.
pub(super) fn named(
    chosen: &[ColumnGuess],
    guesses: &[ColumnGuess],
    table: &TextTable<'_>,
) -> Vec<SurveyedColumn> {
    let rival = |place: usize| (place + 1, table.header[place].text.clone());
    let column = |guess: &ColumnGuess| {
        let head = table.header.get(guess.place);
        let is_same = |other: &&HeaderField| head.is_some_and(|head| head.text == other.text);
        SurveyedColumn {
            channel: guess.channel,
            number: guess.place + 1,
            heading: head.map(|head| head.text.clone()).unwrap_or_default(),
            is_unique: table.header.iter().filter(is_same).count() == 1,
            unit: match head.map(|head| &head.unit) {
                Some(HeaderUnit::Of(_)) => SurveyedUnit::Stated(
                    head.map(|head| head.unit_text.clone()).unwrap_or_default(),
                ),
                Some(HeaderUnit::Electrical) => SurveyedUnit::Sensitivity(1.0),
                _ => SurveyedUnit::Assumed(assumed(guess.channel, head)),
            },
            rivals: column_guess::rivals(&table.header, guesses, *guess)
                .into_iter()
                .map(rival)
                .collect(),
        }
    };
    chosen.iter().map(column).collect()
}

/// Units of mass in headers of loads, and the weight of one.
const WEIGHTS: [(&str, &str); 11] = [
    ("gram", "9.80665 mN"),
    ("grams", "9.80665 mN"),
    ("p", "9.80665 mN"),
    ("pond", "9.80665 mN"),
    ("mg", "9.80665 uN"),
    ("g", "9.80665 mN"),
    ("kg", "9.80665 N"),
    ("mgf", "9.80665 uN"),
    ("gf", "9.80665 mN"),
    ("kgf", "9.80665 N"),
    ("kp", "9.80665 N"),
];

/// The unit in which instruments mostly write a quantity.
fn assumed(channel: Channel, head: Option<&HeaderField>) -> &'static str {
    let last = head.and_then(|head| head.text.split([' ', '(', '[', '/', ',']).next_back());
    let last = last.map(|word| word.trim_end_matches([')', ']', ' ']));
    let weight = WEIGHTS.iter().find(|(mass, _)| last == Some(*mass));
    match channel {
        Channel::Force if let Some((_, weight)) = weight => weight,
        Channel::Force => "mN",
        Channel::Time => "s",
        Channel::Stiffness => "N/m",
        _ => "nm",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_for_units_are_understood() {
        for (channel, heading, unit) in [
            (Channel::Force, "Load (gram)", "9.80665 mN"),
            (Channel::Force, "Load (p)", "9.80665 mN"),
            (Channel::Force, "Load", "mN"),
            (Channel::Depth, "Depth", "nm"),
        ] {
            assert_eq!(
                assumed(channel, Some(&HeaderField::new(heading))),
                unit,
                "{heading}"
            );
        }
    }
}
