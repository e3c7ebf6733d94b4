//! The text of a drafted `[[data]]` table: its keys, each with what it rests on.

use pellicle::display::{Unit, significant};

use super::NOT_IN_THE_FILE;
use super::survey::Survey;
use super::table_columns::{SurveyedColumn, SurveyedUnit};
use super::words::{quoted, stated};
use crate::measured::channel::Channel;
use crate::measured::decimal_mark::DecimalMark;
use crate::measured::stated::StatedQuantity;

/// A key with its value and what it rests on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Line {
    /// `key = value`.
    pub(super) key: String,
    /// What it rests on; empty if nothing is to be said.
    pub(super) why: String,
}

impl Line {
    /// A line with what it rests on.
    pub(super) fn new(key: impl Into<String>, why: impl Into<String>) -> Self {
        let (key, why) = (key.into(), why.into());
        Self { key, why }
    }

    /// The line as text: the comment behind the key if both are short, otherwise above it.
    pub(super) fn text(&self) -> String {
        const WIDTH: usize = 100;
        let Self { key, why } = self;
        if why.is_empty() {
            format!("{key}\n")
        } else if key.chars().count() + why.chars().count() < WIDTH {
            format!("{key}  # {why}\n")
        } else {
            format!("# {why}\n{key}\n")
        }
    }
}

/// The keys of the table of a file that say how it is read.
pub(super) fn keys(survey: &Survey) -> Vec<Line> {
    let mut lines = vec![columns(survey)];
    lines.extend(units(survey));
    lines.extend(text(survey));
    if let Some(spring) = &survey.spring {
        let key = format!(
            "spring_constant = {}",
            quoted(&stated(spring.value, Unit::NewtonPerMetre))
        );
        let why = match &spring.stated {
            Some(stated) => format!("line {}: {}", stated.line, stated.text),
            None => NOT_IN_THE_FILE.to_owned(),
        };
        lines.push(Line::new(key, why));
    }
    if survey.is_unloading {
        let why = if survey.has(Channel::Stiffness) {
            "continuous stiffness: every row is a contact"
        } else {
            ""
        };
        lines.push(Line::new("observe = \"unloading\"", why));
    } else if survey.has(Channel::Stiffness) {
        let why = "it needs neither the zero of the depth nor an area function";
        lines.push(Line::new("observe = \"stiffness at force\"", why));
    }
    lines
}

fn columns(survey: &Survey) -> Line {
    let name = |column: &SurveyedColumn| {
        let is_plain = !column
            .heading
            .contains(|c: char| c.is_control() || c == '\u{fffd}');
        let name = if column.is_unique && is_plain && !column.heading.is_empty() {
            quoted(&column.heading)
        } else {
            column.number.to_string()
        };
        format!("{} = {name}", column.channel.key())
    };
    let names: Vec<_> = survey.columns.iter().map(name).collect();
    let numbers: Vec<_> = survey
        .columns
        .iter()
        .map(|column| column.number.to_string())
        .collect();
    let numbers = format!("columns {} of {}", numbers.join(", "), survey.width);
    let is_named = survey
        .columns
        .iter()
        .all(|column| !column.heading.is_empty());
    let rivals = survey.columns.iter().filter_map(|column| {
        let others = column.other_columns()?;
        Some(format!(
            "; the {} may as well be column {others}",
            column.channel.key()
        ))
    });
    let why = if is_named {
        numbers + &rivals.collect::<String>()
    } else {
        format!("{numbers}, which have no names: the force is the one that rises ever faster")
    };
    Line::new(format!("columns = {{ {} }}", names.join(", ")), why)
}

fn units(survey: &Survey) -> Option<Line> {
    let mut why = String::new();
    let mut units = Vec::new();
    let is_reversed = |column: &SurveyedColumn| survey.reversed.contains(&column.channel);
    for column in &survey.columns {
        let key = column.channel.key();
        match &column.unit {
            SurveyedUnit::Assumed(unit) => {
                why = NOT_IN_THE_FILE.into();
                let sign = if is_reversed(column) { "-1 " } else { "" };
                units.push(format!("{key} = {}", quoted(&format!("{sign}{unit}"))));
            }
            SurveyedUnit::Sensitivity(value) => {
                why = match survey.stated(StatedQuantity::Sensitivity) {
                    Some(stated) => match stated.assumed_unit {
                        None => format!("line {}: {}", stated.line, stated.text),
                        Some(unit) => format!(
                            "line {}: {}; its unit, taken for {unit}, {NOT_IN_THE_FILE}",
                            stated.line, stated.text
                        ),
                    },
                    None => format!("an invented sensitivity, {NOT_IN_THE_FILE}"),
                };
                let sign = if is_reversed(column) { -1.0 } else { 1.0 };
                let value = significant(sign * value * 1e9, 4);
                let value = value
                    .parse::<f64>()
                    .map_or(value, |value| value.to_string());
                units.push(format!("{key} = {}", quoted(&format!("{value} nm/V"))));
            }
            SurveyedUnit::Stated(unit) if is_reversed(column) => {
                units.push(format!("{key} = {}", quoted(&format!("-1 {unit}"))));
            }
            SurveyedUnit::Stated(_) => {}
        }
    }
    if survey.reversed.contains(&Channel::Depth) {
        why = "the depth falls as the force rises, so its sign is reversed; check the units".into();
    } else if !survey.reversed.is_empty() {
        why = "the load is negative where it presses, so its sign is reversed; check the units"
            .into();
    }
    (!units.is_empty()).then(|| Line::new(format!("units = {{ {} }}", units.join(", ")), why))
}

fn text(survey: &Survey) -> Option<Line> {
    let mut options = Vec::new();
    let mut why = Vec::new();
    if survey.decimal == DecimalMark::Comma {
        options.push("decimal = \",\"".to_owned());
        why.push("numbers have a comma".to_owned());
    }
    if survey.tables > 1 {
        options.push("table = 1".to_owned());
        why.push(format!("the first of {} tables in the file", survey.tables));
    }
    if let Some(encoding) = survey.encoding {
        options.push(format!("encoding = {}", quoted(encoding)));
    }
    (!options.is_empty()).then(|| {
        Line::new(
            format!("text = {{ {} }}", options.join(", ")),
            why.join("; "),
        )
    })
}
