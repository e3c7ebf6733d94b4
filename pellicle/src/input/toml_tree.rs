//! A text as a tree of TOML values, each with its position in the text.

use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::diagnosis::{Diagnosis, Fault};
use super::span::{Source, Span};

/// A value and its position in the text.
#[derive(Debug, Clone, PartialEq)]
pub struct TomlNode {
    /// The value.
    pub value: TomlValue,
    /// Its position in the text.
    pub span: Span,
}

/// A TOML value.
#[derive(Debug, Clone, PartialEq)]
pub enum TomlValue {
    /// A string.
    Text(String),
    /// An integer of 64 bits; a longer one is a float.
    Integer(i64),
    /// A float, `nan` and `inf` included.
    Float(f64),
    /// `true` or `false`.
    Boolean(bool),
    /// A date or a time; a case has none.
    Datetime,
    /// An array.
    List(Vec<TomlNode>),
    /// A table, in any notation.
    Table(TomlTable),
}

impl TomlValue {
    /// A noun for the value, used in messages.
    #[must_use]
    pub fn noun(&self) -> &'static str {
        match self {
            Self::Text(_) => "a string",
            Self::Integer(_) => "an integer",
            Self::Float(_) => "a number",
            Self::Boolean(_) => "a boolean",
            Self::Datetime => "a date",
            Self::List(_) => "a list",
            Self::Table(_) => "a table",
        }
    }
}

/// The entries of a table in the order of their keys.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TomlTable {
    /// The entries.
    pub entries: Vec<TomlEntry>,
}

/// One `key = value`.
#[derive(Debug, Clone, PartialEq)]
pub struct TomlEntry {
    /// The key.
    pub key: String,
    /// The position of the key.
    pub key_span: Span,
    /// The value.
    pub node: TomlNode,
}

impl TomlTable {
    /// The entry of `key`.
    #[must_use]
    pub fn entry(&self, key: &str) -> Option<&TomlEntry> {
        self.entries.iter().find(|entry| entry.key == key)
    }

    /// Mutable access to the entry of `key`.
    pub fn entry_mut(&mut self, key: &str) -> Option<&mut TomlEntry> {
        self.entries.iter_mut().find(|entry| entry.key == key)
    }
}

/// Parses a TOML text into a tree.
///
/// # Errors
///
/// A [`Diagnosis`] if the text is empty or not TOML.
pub fn parse(source: &Arc<Source>) -> Result<TomlNode, Diagnosis> {
    let root = DeTable::parse(source.inner()).map_err(|error| not_toml(source, &error))?;
    let node = TomlNode {
        value: TomlValue::Table(table(source, 0, root.get_ref())),
        span: Span::end_of(source),
    };
    refuse_empty(node)
}

fn refuse_empty(node: TomlNode) -> Result<TomlNode, Diagnosis> {
    if !matches!(&node.value, TomlValue::Table(table) if table.entries.is_empty()) {
        return Ok(node);
    }
    let fault = Fault::Wrong {
        found: "an empty file".into(),
        wanted: "a case: [foundation], [indenter] and [load]".into(),
    };
    Err(Diagnosis::of_text(node.span, fault)
        .with_help("`pellicle init > case.toml` writes one to start from"))
}

fn not_toml(source: &Arc<Source>, error: &toml::de::Error) -> Diagnosis {
    let span = match error.span() {
        Some(span) => Span::new(source, span),
        None => Span::end_of(source),
    };
    let fault = Fault::Wrong {
        found: error.message().to_owned(),
        wanted: "TOML (https://toml.io)".into(),
    };
    Diagnosis::of_text(span, fault)
}

/// Converts one parsed value, whose text begins at byte `start` of the source, to a tree.
#[must_use]
pub fn node(source: &Arc<Source>, start: usize, spanned: &Spanned<DeValue<'_>>) -> TomlNode {
    let span = spanned.span();
    let span = Span::new(source, start + span.start..start + span.end);
    let value = match spanned.get_ref() {
        DeValue::String(text) => TomlValue::Text(text.clone().into_owned()),
        DeValue::Integer(digits) => i64::from_str_radix(digits.as_str(), digits.radix())
            .map_or_else(|_| float(digits.as_str()), TomlValue::Integer),
        DeValue::Float(digits) => float(digits.as_str()),
        DeValue::Boolean(value) => TomlValue::Boolean(*value),
        DeValue::Datetime(_) => TomlValue::Datetime,
        DeValue::Array(items) => {
            TomlValue::List(items.iter().map(|item| node(source, start, item)).collect())
        }
        DeValue::Table(entries) => TomlValue::Table(table(source, start, entries)),
    };
    TomlNode { value, span }
}

/// Converts digits checked by the parser; a number beyond f64 becomes infinite and is rejected by the reader.
fn float(digits: &str) -> TomlValue {
    TomlValue::Float(digits.parse().unwrap_or(f64::NAN))
}

fn table(source: &Arc<Source>, start: usize, entries: &DeTable<'_>) -> TomlTable {
    let entry = |(key, value): (&Spanned<_>, &Spanned<DeValue<'_>>)| {
        let span = key.span();
        let key: &std::borrow::Cow<'_, str> = key.get_ref();
        TomlEntry {
            key: key.clone().into_owned(),
            key_span: Span::new(source, start + span.start..start + span.end),
            node: node(source, start, value),
        }
    };
    TomlTable {
        entries: entries.iter().map(entry).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(text: &str) -> Arc<Source> {
        Arc::new(Source::new("case.toml", text.into()))
    }

    fn fault(text: &str) -> Diagnosis {
        parse(&source(text)).unwrap_err()
    }

    #[test]
    fn every_value_has_its_span() {
        let text = "title = \"a\"\n[foundation]\nsubstrate = { poisson_ratio = 0.3 }\n[[foundation.layer]]\nthickness = \"5 nm\"\n";
        let root = parse(&source(text)).unwrap();
        let TomlValue::Table(table) = &root.value else {
            panic!("{root:?}")
        };
        let foundation = &table.entry("foundation").unwrap().node;
        assert_eq!(foundation.span.text(), "[foundation]");
        let TomlValue::Table(foundation) = &foundation.value else {
            panic!("{foundation:?}")
        };
        let TomlValue::List(layers) = &foundation.entry("layer").unwrap().node.value else {
            panic!("{foundation:?}")
        };
        assert_eq!(layers[0].span.text(), "[[foundation.layer]]");
        let TomlValue::Table(layer) = &layers[0].value else {
            panic!("{layers:?}")
        };
        let thickness = layer.entry("thickness").unwrap();
        assert_eq!(thickness.key_span.text(), "thickness");
        assert_eq!(thickness.node.span.text(), "\"5 nm\"");
        assert_eq!(thickness.node.span.line(), 5);
    }

    #[test]
    fn a_file_without_a_case_is_rejected() {
        for text in ["", "\n\n", "# nothing\n"] {
            assert!(
                fault(text).to_string().contains("found an empty file"),
                "{text:?}"
            );
        }
    }

    #[test]
    fn invalid_toml_is_reported_at_its_position() {
        let diagnosis = fault("[load]\nforce = = 3\n");
        assert_eq!(diagnosis.span.line(), 2);
        assert!(diagnosis.to_string().contains("wanted TOML"));
    }

    #[test]
    fn a_duplicate_key_is_reported() {
        assert_eq!(fault("[load]\nforce = 1\nforce = 2\n").span.line(), 3);
    }

    #[test]
    fn very_deep_nesting_is_rejected_without_overflowing_the_stack() {
        fault(&format!("a = {}", "[".repeat(100_000)));
    }

    #[test]
    fn every_toml_number_format_is_read() {
        let root = parse(&source(
            "a = 0x10\nb = 1_000\nc = 1e400\nd = nan\ne = 99999999999999999999\n",
        ))
        .unwrap();
        let TomlValue::Table(table) = root.value else {
            panic!("not a table")
        };
        let value = |key| &table.entry(key).unwrap().node.value;
        assert_eq!(value("a"), &TomlValue::Integer(16));
        assert_eq!(value("b"), &TomlValue::Integer(1000));
        assert_eq!(value("c"), &TomlValue::Float(f64::INFINITY));
        assert!(matches!(value("d"), TomlValue::Float(nan) if nan.is_nan()));
        assert_eq!(value("e"), &TomlValue::Float(1e20));
    }
}
