//! The key that is searched: a number of the case, its unit, and the range of its values.

use std::sync::Arc;

use pellicle::case::{BaseCase, Case};
use pellicle::declare::Shape;
use pellicle::declare::keys;
use pellicle::declare::shape::TableShape;
use pellicle::display::{DisplayUnit, significant};
use pellicle::input::diagnosis::{Diagnosis, Fault, closest};
use pellicle::input::dimension::Dimension;
use pellicle::input::key_path;
use pellicle::input::overrides;
use pellicle::input::quantity;
use pellicle::input::span::{Source, Span};
use pellicle::input::toml_tree::{TomlNode, TomlValue};
use pellicle::input::units::Units;
use pellicle_files::cell::is_plain;

use super::number::text_of;

/// How far the search goes from the value of the case, up and down, unless it is told.
const DEFAULT_RANGE: f64 = 10.0;

/// Halvings, in logarithms, of the distance from the value of the case to an end that the case does not allow: the end
/// found is within 10^(1/2⁸) − 1 = 1 % of the last allowed value.
const END_HALVINGS: usize = 8;

/// What is wanted of a key.
const WANTED: &str = "a key of the case whose value is a number, such as load.force";

/// The key that is searched.
#[derive(Debug, Clone)]
pub struct SearchedKey {
    /// Its dotted path, such as `surface.period`.
    pub path: String,
    /// The dimension of its values.
    pub dimension: Option<Dimension>,
    /// The units of the case.
    pub units: Units,
    /// The name of the text that names it, such as `--by`.
    named: String,
}

/// The question whether a key is meant, by its path where a table of a case has it.
fn meant(shape: &TableShape, key: &str) -> String {
    let has = |table: &&str| !keys::at(shape, &[(*table).to_owned(), key.to_owned()]).is_empty();
    let mut tables = shape.fields.iter().map(|field| field.key).filter(has);
    match tables.next() {
        Some(table) => format!("did you mean `{table}.{key}`?"),
        None => format!("did you mean `{key}`?"),
    }
}

impl SearchedKey {
    /// Reads the path of a key of this case.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if there is no such key, or its values are no real numbers.
    pub fn read(text: &Arc<Source>, case: &BaseCase) -> Result<Self, Diagnosis> {
        let path = text.inner().trim();
        let wrong = |found: String, wanted: &str| {
            let span = Span::new(text, 0..text.inner().len());
            let wanted = wanted.to_owned();
            Diagnosis::of_text(span, Fault::Wrong { found, wanted })
        };
        let shape = Case::shape();
        let parts = key_path::parts(path).filter(|_| is_plain(path));
        let shapes = parts.map_or_else(Vec::new, |parts| keys::at(&shape, &parts));
        if shapes.is_empty() {
            let last = path.rsplit('.').next().unwrap_or_default();
            let known: Vec<_> = keys::fields(&shape).into_keys().collect();
            let diagnosis = wrong(
                format!("no number `{path}` among the keys of a case"),
                WANTED,
            );
            return Err(match closest(last, &known) {
                Some(known) => diagnosis.with_help(meant(&shape, known)),
                None => diagnosis,
            });
        }
        let Some(number) = shapes.iter().find_map(|shape| number(shape)) else {
            let value = keys::value(shapes[0]);
            return Err(wrong(format!("`{path}`, whose value is {value}"), WANTED));
        };
        Ok(Self {
            path: path.to_owned(),
            dimension: number.dimension(),
            units: Units::of(&case.root),
            named: text.name().to_owned(),
        })
    }

    /// Reads a value from a text.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the text is no number of this dimension.
    pub fn value(&self, text: &Arc<Source>) -> Result<f64, Diagnosis> {
        let span = Span::new(text, 0..text.inner().len());
        text_of(text.inner(), self.dimension, self.units).map_err(|wanted| {
            let found = format!("`{}`", text.inner());
            let wanted = format!("{wanted}, a value of {}", self.path);
            Diagnosis::of_text(span, Fault::Wrong { found, wanted })
        })
    }

    /// Returns the case with a value of the key.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if these values make an invalid case.
    pub fn case(&self, base: &BaseCase, value: f64) -> Result<Case, Diagnosis> {
        let mut root = base.root.clone();
        let text = format!("{} = {}", self.path, self.words(value));
        let place = self.path.len() + 3..text.len();
        let source = Arc::new(Source::new(self.named.clone(), text));
        let key_span = Span::new(&source, 0..self.path.len());
        let node = TomlNode {
            value: self.written(value),
            span: Span::new(&source, place),
        };
        overrides::replace(&mut root, &self.path, &key_span, node)?;
        base.resolve(&root)
    }

    /// The value as in a case file.
    fn written(&self, value: f64) -> TomlValue {
        match self.dimension {
            Some(dimension) if self.units == Units::Si => {
                TomlValue::Text(format!("{value:e} {}", dimension.si_unit()))
            }
            _ => TomlValue::Float(value),
        }
    }

    /// The default range of values: a decade down and up from the value of the case, as far as the case allows it.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the case has no positive number there.
    pub fn default_range(&self, base: &BaseCase) -> Result<[f64; 2], Diagnosis> {
        let own = self.own_value(base).filter(|value| *value > 0.0);
        let own = own.ok_or_else(|| {
            let source = Arc::new(Source::new(self.named.clone(), self.path.clone()));
            let found = format!("`{}`, of which the case has no positive value", self.path);
            let wanted = "the range of its values: --between LOW HIGH".into();
            let span = Span::new(&source, 0..self.path.len());
            Diagnosis::of_text(span, Fault::Wrong { found, wanted })
        })?;
        self.case(base, own)?;
        let allowed = |value: f64| self.case(base, value).is_ok();
        Ok([own / DEFAULT_RANGE, own * DEFAULT_RANGE].map(|end| {
            if allowed(end) {
                return end;
            }
            let (mut inside, mut outside) = (own, end);
            for _ in 0..END_HALVINGS {
                let middle = (inside * outside).sqrt();
                if allowed(middle) {
                    inside = middle;
                } else {
                    outside = middle;
                }
            }
            inside
        }))
    }

    /// The value in the case, in SI units or the case's own.
    fn own_value(&self, base: &BaseCase) -> Option<f64> {
        let parts = key_path::parts(&self.path)?;
        let node = parts
            .iter()
            .try_fold(&base.root, |node, part| match &node.value {
                TomlValue::Table(table) => table.entry(part).map(|entry| &entry.node),
                TomlValue::List(items) => items.get(part.parse::<usize>().ok()?),
                _ => None,
            })?;
        match &node.value {
            TomlValue::Float(number) => Some(*number),
            TomlValue::Integer(number) => Some(*number as f64),
            TomlValue::Text(text) => quantity::parse(text, self.dimension?).ok(),
            _ => None,
        }
    }

    /// Its heading in a table, with the unit.
    #[must_use]
    pub fn heading(&self) -> String {
        match self.dimension {
            Some(dimension) => format!("{} [{}]", self.path, self.units.name(dimension.si_unit())),
            None => self.path.clone(),
        }
    }

    /// Writes a value with its unit, with five digits.
    #[must_use]
    pub fn words(&self, value: f64) -> String {
        self.words_of(&[value], 5).concat()
    }

    /// Writes values on one scale, with this many digits of the first.
    #[must_use]
    pub fn words_of(&self, values: &[f64], digits: usize) -> Vec<String> {
        let first = values.first().copied().unwrap_or_default();
        let scale = DisplayUnit::of_dimension(first, self.dimension, self.units);
        let word = |value: &f64| {
            let number = significant(value / scale.divisor, digits);
            format!("{number} {}", scale.label).trim_end().to_owned()
        };
        values.iter().map(word).collect()
    }
}

/// The shape of a real number, if a value may be one.
fn number(shape: &Shape) -> Option<&Shape> {
    match shape {
        Shape::Quantity(..) | Shape::Number | Shape::Range(_) => Some(shape),
        Shape::Either(shapes) => shapes.iter().find_map(number),
        _ => None,
    }
}
