//! The tree of a text, kept for faults that are found only after reading.

use std::sync::Arc;

use super::diagnosis::{Diagnosis, Fault};
use super::key_path;
use super::span::{Source, Span};
use super::toml_tree::{TomlNode, TomlTable, TomlValue};
use super::value_reader::ValueReader;

/// The tree from which a case was read, for diagnoses and warnings after reading. It is ignored when cases are
/// compared: any two are equal.
#[derive(Debug, Clone)]
pub struct Document(Arc<TomlNode>);

impl PartialEq for Document {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Default for Document {
    /// The document of an empty text.
    fn default() -> Self {
        let source = Arc::new(Source::new("", String::new()));
        Self(Arc::new(TomlNode {
            value: TomlValue::Table(TomlTable::default()),
            span: Span::end_of(&source),
        }))
    }
}

impl Document {
    /// Keeps the tree.
    #[must_use]
    pub fn new(root: &TomlNode) -> Self {
        Self(Arc::new(root.clone()))
    }

    /// The tree.
    #[must_use]
    pub fn root(&self) -> &TomlNode {
        &self.0
    }

    /// The diagnosis that the value of the first of these keys in the document is rejected for this reason.
    #[must_use]
    pub fn refused(&self, keys: &[&str], reason: &dyn std::error::Error) -> Diagnosis {
        let found = keys.iter().find_map(|key| self.field(key));
        found.map_or_else(
            || {
                let reason = reason.to_string();
                Diagnosis::of_text(self.0.span.clone(), Fault::Refused { reason })
            },
            |field| field.refused(reason),
        )
    }

    /// The diagnosis that another value of this key is wanted.
    #[must_use]
    pub fn wanted(&self, key: &str, wanted: &str) -> Diagnosis {
        self.field(key).map_or_else(
            || {
                let wanted = format!("{key} of {wanted}");
                let fault = Fault::Missing { wanted };
                Diagnosis::of_text(self.0.span.clone(), fault)
            },
            |field| field.wanted(wanted),
        )
    }

    /// The texts in the value of this key: the value itself, the items of a list, the ends of a range.
    #[must_use]
    pub fn texts(&self, key: &str) -> Vec<&str> {
        let mut found = Vec::new();
        if let Some(field) = self.field(key) {
            texts_in(field.value(), &mut found);
        }
        found
    }

    /// Whether there is a value of this key.
    #[must_use]
    pub fn has(&self, key: &str) -> bool {
        self.field(key).is_some()
    }

    fn field(&self, key: &str) -> Option<ValueReader<'_>> {
        let mut node = self.root();
        for part in key_path::parts(key)? {
            node = match &node.value {
                TomlValue::Table(table) => &table.entry(&part)?.node,
                TomlValue::List(items) => items.get(part.parse::<usize>().ok()?)?,
                _ => return None,
            };
        }
        Some(ValueReader::new(key.to_owned(), node))
    }
}

fn texts_in<'a>(value: &'a TomlValue, found: &mut Vec<&'a str>) {
    match value {
        TomlValue::Text(text) => found.push(text),
        TomlValue::List(items) => items.iter().for_each(|item| texts_in(&item.value, found)),
        TomlValue::Table(table) => {
            let nodes = table.entries.iter().map(|entry| &entry.node);
            nodes.for_each(|node| texts_in(&node.value, found));
        }
        _ => {}
    }
}
