//! One key of a study with its values: a list, a range, or a column of a file.

use std::borrow::Cow;
use std::sync::OnceLock;

use pellicle::display::{dimensional, significant};
use pellicle::input::diagnosis::{Diagnosis, Fault};
use pellicle::input::dimension::Dimension;
use pellicle::input::quantity;
use pellicle::input::spacing::{self, Spacing};
use pellicle::input::span::Span;
use pellicle::input::table_reader::TableReader;
use pellicle::input::toml_tree::{TomlNode, TomlValue};
use pellicle::input::units::Units;
use pellicle::input::value_reader::ValueReader;
use pellicle_files::cell::{self, is_plain, on_one_line};

use crate::samples::SampleColumn;

/// Most values of one key; more are assumed to be a mistake.
const MAX_VALUES: usize = 100_000;

const WANTED: &str = "a list of values, or a table of from, to, count and spacing";

/// One key and its values.
#[derive(Debug, Clone, PartialEq)]
pub struct VariedKey {
    /// Dotted path of the key in the case, such as `foundation.layer[0].thickness`.
    pub key: String,
    /// Location of the key in the study file.
    pub key_span: Span,
    /// The axis of its values; keys that change together share one.
    pub axis: usize,
    /// Its values, in order.
    values: KeyValues,
    /// The common dimension of the values, if all of them are quantities.
    pub dimension: Option<Dimension>,
}

/// The values of a key.
#[derive(Debug, Clone, PartialEq)]
enum KeyValues {
    /// Values of a list or a range.
    Listed {
        nodes: Vec<TomlNode>,
        /// The values as written in the table, made once because a study needs them often.
        cells: Vec<String>,
        /// The values as shown to the user, made on first use.
        words: OnceLock<Vec<String>>,
        /// Whether they come from a range.
        is_range: bool,
    },
    /// A column of a file.
    Sampled(SampleColumn),
}

impl VariedKey {
    /// Reads the values of a key.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if they are neither a list nor a range, or a text is not [plain](is_plain).
    pub fn read(key: String, key_span: Span, node: &TomlNode) -> Result<Self, Diagnosis> {
        let field = ValueReader::new(key.clone(), node);
        if !is_plain(&key) {
            let (found, wanted) = (format!("{key:?}"), "a key of a case".into());
            return Err(Diagnosis::of_key(
                key,
                key_span,
                Fault::Wrong { found, wanted },
            ));
        }
        let values = match &node.value {
            TomlValue::List(items) if !items.is_empty() => items.clone(),
            TomlValue::Table(_) => range(&field.table()?, &node.span)?,
            _ => return Err(field.wanted(WANTED)),
        };
        if values.len() > MAX_VALUES {
            let field = ValueReader::new(key, node);
            return Err(field.wanted(format!("at most {MAX_VALUES} values")));
        }
        let dimension = common_dimension(&values);
        if dimension.is_none()
            && let Some(odd) = odd_quantity(&values)
        {
            let field = ValueReader::new(key, odd);
            return Err(field.wanted("a quantity of the kind of the key's other values"));
        }
        let cells: Vec<_> = values.iter().map(|node| cell(node, dimension)).collect();
        if let Some(i) = cells.iter().position(|cell| !is_plain(cell)) {
            return Err(ValueReader::new(key, &values[i]).wanted(cell::WANTED));
        }
        let values = KeyValues::Listed {
            cells,
            nodes: values,
            words: OnceLock::new(),
            is_range: matches!(node.value, TomlValue::Table(_)),
        };
        Ok(Self {
            key,
            key_span,
            axis: 0,
            values,
            dimension,
        })
    }

    /// Returns a key whose values are a column of a file, which the study names at `key_span`.
    #[must_use]
    pub fn sampled(key: String, key_span: Span, column: SampleColumn) -> Self {
        let dimension = match &column {
            SampleColumn::Quantities(_, dimension) => Some(*dimension),
            _ => None,
        };
        Self {
            key,
            key_span,
            axis: 0,
            values: KeyValues::Sampled(column),
            dimension,
        }
    }

    /// Whether its values are a column of a file.
    #[must_use]
    pub fn is_sampled(&self) -> bool {
        matches!(self.values, KeyValues::Sampled(_))
    }

    /// Number of its values.
    #[must_use]
    pub fn len(&self) -> usize {
        match &self.values {
            KeyValues::Listed { nodes, .. } => nodes.len(),
            KeyValues::Sampled(column) => column.len(),
        }
    }

    /// Returns the `i`-th value; an empty text if there is none.
    #[must_use]
    pub fn value(&self, i: usize) -> TomlNode {
        let value = match &self.values {
            KeyValues::Listed { nodes, .. } => nodes.get(i).cloned(),
            KeyValues::Sampled(column) => column.value(i, &self.key_span),
        };
        value.unwrap_or_else(|| TomlNode {
            value: TomlValue::Text(String::new()),
            span: self.key_span.clone(),
        })
    }

    /// Whether the values may give cases of different shapes, with other layers or other keys. Lists, tables, switches
    /// and words may; numbers and quantities do not.
    #[must_use]
    pub fn shapes_cases(&self) -> bool {
        let is_number =
            |node: &TomlNode| matches!(node.value, TomlValue::Integer(_) | TomlValue::Float(_));
        match &self.values {
            KeyValues::Listed { nodes, .. } => {
                self.dimension.is_none() && !nodes.iter().all(is_number)
            }
            KeyValues::Sampled(column) => matches!(column, SampleColumn::Words(_)),
        }
    }

    /// Returns the name of its column in the table, with the unit.
    #[must_use]
    pub fn heading(&self) -> String {
        match self.dimension {
            Some(dimension) => format!("{} [{}]", self.key, dimension.si_unit()),
            None => self.key.clone(),
        }
    }

    /// Returns the `i`-th value as written in the table: in SI units if it has a unit, otherwise as in the file.
    #[must_use]
    pub fn cell(&self, i: usize) -> Cow<'_, str> {
        match &self.values {
            KeyValues::Listed { cells, .. } => cells.get(i).map_or("", String::as_str).into(),
            KeyValues::Sampled(column) if i < column.len() => {
                cell(&self.value(i), self.dimension).into()
            }
            KeyValues::Sampled(_) => "".into(),
        }
    }

    /// Returns the `i`-th value as shown to the user, on one line: as written, or rounded if it comes from a range or a
    /// file.
    #[must_use]
    pub fn words(&self, i: usize) -> Cow<'_, str> {
        match &self.values {
            KeyValues::Listed {
                nodes,
                words,
                is_range,
                ..
            } => {
                let all = || {
                    let nodes = nodes.iter();
                    let words = nodes.map(|node| spelt(&node.value, self.dimension, *is_range));
                    words.collect()
                };
                let words = words.get_or_init(all).get(i);
                words.map_or("", String::as_str).into()
            }
            KeyValues::Sampled(_) => spelt(&self.value(i).value, self.dimension, true).into(),
        }
    }
}

/// Writes a value for the user on one line; a computed quantity is rounded.
fn spelt(value: &TomlValue, dimension: Option<Dimension>, is_computed: bool) -> String {
    let words = match (value, dimension) {
        (TomlValue::Text(text), Some(dimension)) if is_computed => {
            rounded(text, dimension).unwrap_or_else(|| text.clone())
        }
        (TomlValue::Float(number), _) => significant(*number, 5),
        (value, _) => words(value),
    };
    on_one_line(&words)
}

/// The dimension of a value written with a unit.
fn dimension_of(node: &TomlNode) -> Option<Dimension> {
    match &node.value {
        TomlValue::Text(text) => quantity::dimension_of(text),
        _ => None,
    }
}

/// The common dimension of the values, if all of them are quantities of it or bare numbers.
fn common_dimension(values: &[TomlNode]) -> Option<Dimension> {
    let first = values.iter().find_map(dimension_of)?;
    let same = |node: &TomlNode| match &node.value {
        TomlValue::Text(_) => dimension_of(node) == Some(first),
        TomlValue::Float(_) | TomlValue::Integer(_) => true,
        _ => false,
    };
    values.iter().all(same).then_some(first)
}

/// The first text that is not a quantity of the same dimension as the others.
fn odd_quantity(values: &[TomlNode]) -> Option<&TomlNode> {
    let first = values.iter().find_map(dimension_of)?;
    let is_odd = |node: &&TomlNode| {
        matches!(node.value, TomlValue::Text(_)) && dimension_of(node) != Some(first)
    };
    values.iter().find(is_odd)
}

fn cell(node: &TomlNode, dimension: Option<Dimension>) -> String {
    match (&node.value, dimension) {
        (TomlValue::Text(text), Some(dimension)) => {
            quantity::parse(text, dimension).map_or_else(|_| text.clone(), |x| format!("{x:e}"))
        }
        (TomlValue::Float(number), Some(_)) => format!("{number:e}"),
        (TomlValue::Integer(number), Some(_)) => format!("{number:e}"),
        (value, _) => words(value),
    }
}

/// Writes a quantity with five digits and a suitable prefix.
fn rounded(text: &str, dimension: Dimension) -> Option<String> {
    let value = quantity::parse(text, dimension).ok()?;
    Some(dimensional(value, dimension, Units::Si))
}

fn words(value: &TomlValue) -> String {
    let list = |items: Vec<String>| items.join(", ");
    match value {
        TomlValue::Text(text) => text.clone(),
        TomlValue::Integer(number) => number.to_string(),
        TomlValue::Float(number) => format!("{number:e}"),
        TomlValue::Boolean(value) => value.to_string(),
        TomlValue::Datetime => "a date".into(),
        TomlValue::List(items) => {
            let items = items.iter().map(|node| words(&node.value)).collect();
            format!("[{}]", list(items))
        }
        TomlValue::Table(table) => {
            let entry = |entry: &pellicle::input::toml_tree::TomlEntry| {
                format!("{} = {}", entry.key, words(&entry.node.value))
            };
            format!("{{ {} }}", list(table.entries.iter().map(entry).collect()))
        }
    }
}

/// Returns the values of `{ from, to, count, spacing }`, all with the location of the table.
fn range(table: &TableReader<'_>, span: &Span) -> Result<Vec<TomlNode>, Diagnosis> {
    table.only(&spacing::KEYS)?;
    let spacing = Spacing::read(table)?;
    let [from, to] = [End::read(table, "from")?, End::read(table, "to")?];
    let field = table.required("to", WANTED)?;
    if from.dimension != to.dimension {
        return Err(field.wanted("a value with a unit of the same kind as that of from"));
    }
    if spacing == Spacing::Log && from.number * to.number <= 0.0 {
        return Err(field.diagnosis(Fault::Wrong {
            found: "a range with spacing = \"log\" that includes zero".into(),
            wanted: "from and to both positive, or both negative".into(),
        }));
    }
    let count = table.required("count", "how many values, an integer")?;
    let count = count.count(2..=MAX_VALUES, " values")?;
    let integers = from.is_integer && to.is_integer;
    let node = |number: f64| TomlNode {
        value: value(number, from.dimension, integers),
        span: span.clone(),
    };
    let numbers = spacing.between(from.number, to.number, count);
    Ok(numbers.into_iter().map(node).collect())
}

/// Returns one value of a range; between integers, a value that is an integer up to rounding becomes one.
fn value(number: f64, dimension: Option<Dimension>, integers: bool) -> TomlValue {
    let nearest = number.round();
    match dimension {
        Some(dimension) => TomlValue::Text(format!("{number:e} {}", dimension.si_unit())),
        #[expect(
            clippy::cast_possible_truncation,
            reason = "between two integers of 64 bits"
        )]
        None if integers && (number - nearest).abs() <= 1e-9 * nearest.abs() => {
            TomlValue::Integer(nearest as i64)
        }
        None => TomlValue::Float(number),
    }
}

/// One end of a range.
struct End {
    number: f64,
    dimension: Option<Dimension>,
    is_integer: bool,
}

impl End {
    fn read(table: &TableReader<'_>, key: &str) -> Result<Self, Diagnosis> {
        const WANTED: &str = "a number, or a quantity such as \"5 nm\"";
        let field = table.required(key, WANTED)?;
        let bare = |number, is_integer| Self {
            number,
            dimension: None,
            is_integer,
        };
        let end = match field.value() {
            TomlValue::Integer(number) => Some(bare(*number as f64, true)),
            TomlValue::Float(number) => Some(bare(*number, false)),
            TomlValue::Text(text) => quantity::dimension_of(text).and_then(|dimension| {
                Some(Self {
                    number: quantity::parse(text, dimension).ok()?,
                    dimension: Some(dimension),
                    is_integer: false,
                })
            }),
            _ => None,
        };
        end.filter(|end| end.number.is_finite())
            .ok_or_else(|| field.wanted(WANTED))
    }
}
