//! Reads a table key by key and diagnoses its faults.

use super::diagnosis::{Diagnosis, Fault};
use super::dimension::{Dimension, Sign};
use super::key_path::dotted;
use super::span::Span;
use super::synonyms::suggestion;
use super::toml_tree::{TomlEntry, TomlNode, TomlTable, TomlValue};
use super::value_reader::ValueReader;
use super::withdrawn;

/// A table and its dotted path.
#[derive(Debug, Clone)]
pub struct TableReader<'a> {
    path: String,
    table: &'a TomlTable,
    span: &'a Span,
}

impl<'a> TableReader<'a> {
    /// Reads the table at the root of a case.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the node is not a table.
    pub fn root(node: &'a TomlNode) -> Result<Self, Diagnosis> {
        ValueReader::new(String::new(), node).table()
    }

    /// Rejects unknown keys, with a suggestion for a misspelt one.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first key in the text that is not in `known`.
    pub fn only(&self, known: &[&str]) -> Result<(), Diagnosis> {
        let unknown = |entry: &&TomlEntry| !known.contains(&entry.key.as_str());
        let first = (self.table.entries.iter())
            .filter(unknown)
            .min_by_key(|entry| entry.key_span.bytes.start);
        first.map_or(Ok(()), |entry| Err(self.unknown(entry, known)))
    }

    fn unknown(&self, entry: &TomlEntry, known: &[&str]) -> Diagnosis {
        let path = self.path_of(&entry.key);
        if let Some(instead) = withdrawn::instead_of(&path) {
            let wanted = instead.to_owned();
            return Diagnosis::of_key(path, entry.key_span.clone(), Fault::Withdrawn { wanted });
        }
        let wanted = format!("one of {}", known.join(", "));
        let diagnosis = Diagnosis::of_key(path, entry.key_span.clone(), Fault::Unknown { wanted });
        match suggestion(&entry.key, known) {
            Some(help) => diagnosis.with_help(help),
            None => diagnosis,
        }
    }

    /// The value of an optional key.
    #[must_use]
    pub fn optional(&self, key: &str) -> Option<ValueReader<'a>> {
        let node = &self.table.entry(key)?.node;
        let path = self.path_of(key);
        Some(ValueReader::new(path, node))
    }

    /// Returns the value of a required key; `wanted` describes it.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] at the position of the table if the key is missing.
    pub fn required(&self, key: &str, wanted: &str) -> Result<ValueReader<'a>, Diagnosis> {
        self.optional(key)
            .ok_or_else(|| self.missing(key, wanted.to_owned()))
    }

    /// Reads the positive quantity of a required key.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the key is missing or its value is not such a quantity.
    pub fn positive(&self, key: &str, dimension: Dimension) -> Result<f64, Diagnosis> {
        let wanted = Sign::Positive.wanted(dimension);
        self.required(key, &wanted)?
            .quantity(dimension, Sign::Positive)
    }

    /// The diagnosis that a key is missing from this table.
    #[must_use]
    pub fn missing(&self, key: &str, wanted: String) -> Diagnosis {
        let path = self.path_of(key);
        Diagnosis::of_key(path, self.span.clone(), Fault::Missing { wanted })
    }

    /// The keys of `candidates` in the table.
    #[must_use]
    pub fn given(&self, candidates: &[&'static str]) -> Vec<&'static str> {
        let is_there = |key: &&&str| self.table.entry(key).is_some();
        candidates.iter().filter(is_there).copied().collect()
    }

    fn path_of(&self, key: &str) -> String {
        dotted(&self.path, key)
    }
}

impl<'a> ValueReader<'a> {
    /// Reads the value as a table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the value has another type.
    pub fn table(self) -> Result<TableReader<'a>, Diagnosis> {
        let node = self.node();
        let TomlValue::Table(table) = &node.value else {
            return Err(self.wanted("a table"));
        };
        Ok(TableReader {
            path: self.path().to_owned(),
            table,
            span: &node.span,
        })
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use std::sync::Arc;

    use super::super::span::Source;
    use super::super::toml_tree;
    use super::*;

    /// Reads the text as one table; a diagnosis is returned as its sentence.
    pub fn read_table<T>(
        text: &str,
        read: impl FnOnce(TableReader<'_>) -> Result<T, Diagnosis>,
    ) -> Result<T, String> {
        // An extra key keeps a text without keys from counting as an empty file.
        let source = Arc::new(Source::new("case.toml", format!("{text}\n[unused]\n")));
        let mut root = toml_tree::parse(&source).map_err(|diagnosis| diagnosis.to_string())?;
        if let TomlValue::Table(table) = &mut root.value {
            table.entries.retain(|entry| entry.key != "unused");
        }
        TableReader::root(&root)
            .and_then(read)
            .map_err(|diagnosis| diagnosis.to_string())
    }

    fn root(text: &str) -> TomlNode {
        toml_tree::parse(&Arc::new(Source::new("case.toml", text.into()))).unwrap()
    }

    #[test]
    fn a_misspelt_key_is_named_and_the_right_one_suggested() {
        let root = root("[layer]\nthickness = 1\nyuong_modulus = 2\n");
        let layer = TableReader::root(&root)
            .unwrap()
            .required("layer", "")
            .unwrap();
        let diagnosis = (layer.table().unwrap())
            .only(&["thickness", "young_modulus"])
            .unwrap_err();
        assert_eq!(diagnosis.key.as_deref(), Some("layer.yuong_modulus"));
        assert_eq!(diagnosis.span.line(), 3);
        assert_eq!(
            diagnosis.help.as_deref(),
            Some("did you mean `young_modulus`?")
        );
    }

    #[test]
    fn a_missing_key_is_reported_at_its_table() {
        let root = root("title = \"a\"\n[load]\n");
        let load = TableReader::root(&root)
            .unwrap()
            .required("load", "")
            .unwrap();
        let diagnosis = load
            .table()
            .unwrap()
            .required("force", "a force")
            .unwrap_err();
        assert_eq!(
            diagnosis.to_string(),
            "case.toml, line 2, key `load.force`: found no such key, wanted a force"
        );
    }
}
