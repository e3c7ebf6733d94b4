//! Reads the value of a key as the required type.

use std::ops::RangeInclusive;

use super::diagnosis::{Diagnosis, Fault};
use super::dimension::{Dimension, Sign};
use super::quantity::{self, QuantityError};
use super::synonyms::suggestion;
use super::synonyms::value_suggestion;
use super::toml_tree::{TomlNode, TomlValue};

/// The value of one key, and its dotted path.
#[derive(Debug, Clone)]
pub struct ValueReader<'a> {
    path: String,
    node: &'a TomlNode,
}

impl<'a> ValueReader<'a> {
    /// Creates the reader of a value with its dotted path.
    #[must_use]
    pub fn new(path: String, node: &'a TomlNode) -> Self {
        Self { path, node }
    }

    /// The dotted path of the value.
    #[must_use]
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The value itself.
    #[must_use]
    pub fn value(&self) -> &'a TomlValue {
        &self.node.value
    }

    /// The node itself.
    #[must_use]
    pub fn node(&self) -> &'a TomlNode {
        self.node
    }

    /// The diagnosis that the key of this value is unknown, with a suggestion.
    #[must_use]
    pub fn unknown_key(&self, key: &str, known: &[&str]) -> Diagnosis {
        let wanted = format!("one of {}", known.join(", "));
        let diagnosis = self.diagnosis(Fault::Unknown { wanted });
        match suggestion(key, known) {
            Some(help) => diagnosis.with_help(help),
            None => diagnosis,
        }
    }

    /// The diagnosis that another value is wanted here.
    pub fn wanted(&self, wanted: impl Into<String>) -> Diagnosis {
        let (found, wanted) = (self.found(), wanted.into());
        self.diagnosis(Fault::Wrong { found, wanted })
    }

    /// The diagnosis that the model rejects this value for this reason.
    pub fn refused(&self, reason: &dyn std::error::Error) -> Diagnosis {
        let reason = reason.to_string();
        self.diagnosis(Fault::Refused { reason })
    }

    /// The diagnosis that this value cannot be used; the reason follows the user's text.
    pub fn unusable(&self, reason: &dyn std::fmt::Display, wanted: impl Into<String>) -> Diagnosis {
        let (found, wanted) = (format!("{}, {reason}", self.found()), wanted.into());
        self.diagnosis(Fault::Wrong { found, wanted })
    }

    /// The diagnosis of a fault of this value.
    #[must_use]
    pub fn diagnosis(&self, fault: Fault) -> Diagnosis {
        Diagnosis::of_key(self.path.clone(), self.node.span.clone(), fault)
    }

    /// The user's text; for a table or a long text only its kind.
    fn found(&self) -> String {
        let written = self.node.span.text();
        match &self.node.value {
            TomlValue::Table(_) => "a table".into(),
            _ if written.is_empty() || written.len() > 60 || written.contains('\n') => {
                self.node.value.noun().into()
            }
            _ => written.into(),
        }
    }

    /// Whether the value is a table.
    #[must_use]
    pub fn is_table(&self) -> bool {
        matches!(self.node.value, TomlValue::Table(_))
    }

    /// Reads the items of a list.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the value is not a list, or if the list is empty.
    pub fn list(&self, wanted: &str) -> Result<Vec<Self>, Diagnosis> {
        let items = self.items(wanted)?;
        match items[..] {
            [] => Err(self.wanted(wanted)),
            _ => Ok(items),
        }
    }

    /// Reads the items of a list, which may be empty.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the value has another type.
    pub fn items(&self, wanted: &str) -> Result<Vec<Self>, Diagnosis> {
        let TomlValue::List(items) = &self.node.value else {
            return Err(self.wanted(wanted));
        };
        let item = |(i, node)| Self {
            path: format!("{}[{i}]", self.path),
            node,
        };
        Ok(items.iter().enumerate().map(item).collect())
    }

    /// Reads a text.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the value has another type.
    pub fn text(&self) -> Result<&'a str, Diagnosis> {
        match &self.node.value {
            TomlValue::Text(text) => Ok(text),
            _ => Err(self.wanted("a string")),
        }
    }

    /// Reads one of these words and returns its meaning.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the value is none of them, with a suggestion for a misspelt one.
    pub fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Result<T, Diagnosis> {
        let words: Vec<_> = choices.iter().map(|(word, _)| *word).collect();
        let wanted = format!("one of \"{}\"", words.join("\", \""));
        let TomlValue::Text(found) = &self.node.value else {
            return Err(self.wanted(wanted));
        };
        if let Some((_, meaning)) = choices.iter().find(|(word, _)| word == found) {
            return Ok(*meaning);
        }
        let diagnosis = self.wanted(wanted);
        Err(match value_suggestion(found, &words) {
            Some(word) => diagnosis.with_help(format!("did you mean \"{word}\"?")),
            None => diagnosis,
        })
    }

    /// Reads an integer in `range`; `why` follows the range in the diagnosis.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the value is not such an integer.
    pub fn count(&self, range: RangeInclusive<usize>, why: &str) -> Result<usize, Diagnosis> {
        let count = match self.node.value {
            TomlValue::Integer(count) => usize::try_from(count).ok(),
            _ => None,
        };
        count.filter(|count| range.contains(count)).ok_or_else(|| {
            let (from, to) = range.into_inner();
            self.wanted(format!("an integer from {from} to {to}{why}"))
        })
    }

    /// Reads `true` or `false`.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the value has another type.
    pub fn switch(&self) -> Result<bool, Diagnosis> {
        match &self.node.value {
            TomlValue::Boolean(value) => Ok(*value),
            _ => Err(self.wanted("true or false")),
        }
    }

    /// Reads a number without a dimension.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the value is not a finite number.
    pub fn number(&self, wanted: &str) -> Result<f64, Diagnosis> {
        self.bare_number()
            .filter(|number| number.is_finite())
            .ok_or_else(|| self.wanted(wanted))
    }

    /// Reads a quantity in SI units or the case's own.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the value is not a quantity, or if its unit or sign is not allowed.
    pub fn quantity(&self, dimension: Dimension, sign: Sign) -> Result<f64, Diagnosis> {
        let value = match &self.node.value {
            TomlValue::Text(text) => quantity::parse(text, dimension)
                .map_err(|error| self.not_a_quantity(dimension, sign, &error))?,
            _ => (self.bare_number()).ok_or_else(|| self.wanted(sign.wanted(dimension)))?,
        };
        if !sign.allows(value) {
            return Err(self.wanted(sign.wanted(dimension)));
        }
        self.in_range(dimension, value)
    }

    /// Returns the value if its magnitude is within the range that a contact computation can represent: squares and
    /// quotients of such numbers are finite.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] with the limits otherwise.
    pub fn in_range(&self, dimension: Dimension, value: f64) -> Result<f64, Diagnosis> {
        let range = dimension.magnitudes();
        if value == 0.0 || range.contains(&value.abs()) {
            return Ok(value);
        }
        let (noun, unit) = (dimension.noun(), dimension.si_unit());
        let (least, most) = range.into_inner();
        Err(self.wanted(format!(
            "{noun} between {least:e} and {most:e} {unit}, or the same number in the case's own units"
        )))
    }

    fn bare_number(&self) -> Option<f64> {
        match self.node.value {
            TomlValue::Float(number) => Some(number),
            TomlValue::Integer(number) => Some(number as f64),
            _ => None,
        }
    }

    fn not_a_quantity(&self, dimension: Dimension, sign: Sign, error: &QuantityError) -> Diagnosis {
        let found = format!("{} ({error})", self.found());
        let wanted = sign.wanted(dimension);
        let diagnosis = self.diagnosis(Fault::Wrong { found, wanted });
        match error {
            QuantityError::NoUnit => diagnosis.with_help("a bare number is written without quotes"),
            QuantityError::UnknownUnit(unit) if unit.starts_with(',') => {
                diagnosis.with_help("the decimal mark is a point")
            }
            QuantityError::UnknownUnit(_) => {
                let units = dimension.unit_names().join(", ");
                diagnosis.with_help(format!("units of {}: {units}", dimension.noun()))
            }
            _ => diagnosis,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::super::span::Source;
    use super::super::table_reader::TableReader;
    use super::super::toml_tree;
    use super::*;

    fn root(text: &str) -> TomlNode {
        toml_tree::parse(&Arc::new(Source::new("case.toml", text.into()))).unwrap()
    }

    fn quantity(text: &str, dimension: Dimension) -> Result<f64, String> {
        let root = root(&format!("\na = {text}\n"));
        let field = TableReader::root(&root).unwrap().required("a", "").unwrap();
        field
            .quantity(dimension, Sign::Positive)
            .map_err(|diagnosis| diagnosis.to_string())
    }

    #[test]
    fn a_quantity_is_a_bare_number_or_a_string_with_unit() {
        assert_eq!(quantity("70", Dimension::Pressure), Ok(70.0));
        assert_eq!(quantity("1e-4", Dimension::Length), Ok(1e-4));
        assert_eq!(quantity("\"70 GPa\"", Dimension::Pressure), Ok(70e9));
    }

    #[test]
    fn a_unit_of_the_wrong_dimension_is_reported_as_found_and_wanted() {
        assert_eq!(
            quantity("\"5 nm\"", Dimension::Pressure).unwrap_err(),
            "case.toml, line 2, key `a`: found \"5 nm\" (a length), \
             wanted a positive pressure such as \"70 GPa\", or a bare number"
        );
    }

    #[test]
    fn quantities_too_small_or_large_for_the_arithmetic_are_rejected_with_the_limits() {
        for text in ["1e307", "1e-308", "\"1e40 nm\"", "1e-31"] {
            let message = quantity(text, Dimension::Length).unwrap_err();
            assert!(
                message.contains("wanted a length between 1e-30 and 1e30 m"),
                "{message}"
            );
        }
        assert_eq!(quantity("1e-30", Dimension::Length), Ok(1e-30));
    }

    #[test]
    fn an_unknown_unit_is_rejected_with_the_list_of_known_units() {
        let root = root("a = \"5 micros\"");
        let field = TableReader::root(&root).unwrap().required("a", "").unwrap();
        let diagnosis = field
            .quantity(Dimension::Length, Sign::Positive)
            .unwrap_err();
        assert!(
            diagnosis
                .help
                .unwrap()
                .starts_with("units of a length: m, km, cm, mm, um")
        );
    }

    #[test]
    fn nan_infinities_and_signs_out_of_range_are_rejected() {
        for text in [
            "nan",
            "inf",
            "-inf",
            "-1",
            "0",
            "\"nan nm\"",
            "\"-5 nm\"",
            "true",
            "[1]",
            "{}",
        ] {
            assert!(quantity(text, Dimension::Length).is_err(), "{text}");
        }
    }

    #[test]
    fn counts_are_integers_within_their_range() {
        for text in [
            "0",
            "1e9",
            "1000000000",
            "-3",
            "256.0",
            "\"256\"",
            "9999999999999999999999",
        ] {
            let root = root(&format!("n = {text}"));
            let field = TableReader::root(&root).unwrap().required("n", "").unwrap();
            let message = field.count(2..=8192, "").unwrap_err().to_string();
            assert!(
                message.contains("wanted an integer from 2 to 8192"),
                "{message}"
            );
        }
    }
}
