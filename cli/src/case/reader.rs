//! A table being read: takes its keys one by one and says what is wrong with them.

use super::diagnosis::{Diagnosis, Fault};
use super::document::{Entry, Node, Table};
use super::field::{Field, Sign};
use super::place::Place;
use super::quantity::Dimension;
use super::spelling::closest;

/// A table and the dotted path that leads to it.
#[derive(Debug, Clone)]
pub struct Reader<'a> {
    path: String,
    table: &'a Table,
    place: &'a Place,
}

impl<'a> Reader<'a> {
    /// A table, the dotted path that leads to it, and its place.
    #[must_use]
    pub fn new(path: String, table: &'a Table, place: &'a Place) -> Self {
        Self { path, table, place }
    }

    /// The table at the root of a case.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if the node is not a table.
    pub fn root(node: &'a Node) -> Result<Self, Diagnosis> {
        Field::new(String::new(), node).table()
    }

    /// Refuses every key but these, with a suggestion for a misspelt one.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first key in the text that is none of `known`.
    pub fn only(&self, known: &[&str]) -> Result<(), Diagnosis> {
        let unknown = |entry: &&Entry| !known.contains(&entry.key.as_str());
        let first = (self.table.entries.iter())
            .filter(unknown)
            .min_by_key(|entry| entry.key_place.span.start);
        first.map_or(Ok(()), |entry| Err(self.unknown(entry, known)))
    }

    fn unknown(&self, entry: &Entry, known: &[&str]) -> Diagnosis {
        let wanted = format!("one of {}", known.join(", "));
        let path = self.path_of(&entry.key);
        let diagnosis = Diagnosis::of_key(path, entry.key_place.clone(), Fault::Unknown { wanted });
        match closest(&entry.key, known) {
            Some(key) => diagnosis.with_help(format!("did you mean `{key}`?")),
            None => diagnosis,
        }
    }

    /// The value of a key that may be left out.
    #[must_use]
    pub fn optional(&self, key: &str) -> Option<Field<'a>> {
        let node = &self.table.entry(key)?.node;
        let path = self.path_of(key);
        Some(Field::new(path, node))
    }

    /// The value of a key that must be there; `wanted` says what it holds.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] at the table's place if the key is missing.
    pub fn required(&self, key: &str, wanted: &str) -> Result<Field<'a>, Diagnosis> {
        self.optional(key)
            .ok_or_else(|| self.missing(key, wanted.to_owned()))
    }

    /// The quantity of a key that must be there and positive.
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
        Diagnosis::of_key(path, self.place.clone(), Fault::Missing { wanted })
    }

    /// The keys of `candidates` that are there.
    #[must_use]
    pub fn given(&self, candidates: &[&'static str]) -> Vec<&'static str> {
        let is_there = |key: &&&str| self.table.entry(key).is_some();
        candidates.iter().filter(is_there).copied().collect()
    }

    fn path_of(&self, key: &str) -> String {
        match self.path.as_str() {
            "" => key.to_owned(),
            path => format!("{path}.{key}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::super::document;
    use super::super::place::Source;
    use super::*;

    fn root(text: &str) -> Node {
        document::parse(&Arc::new(Source::new("case.toml", text.into()))).unwrap()
    }

    #[test]
    fn a_misspelt_key_is_named_and_the_right_one_suggested() {
        let root = root("[layer]\nthickness = 1\nyuong_modulus = 2\n");
        let layer = Reader::root(&root).unwrap().required("layer", "").unwrap();
        let diagnosis = (layer.table().unwrap())
            .only(&["thickness", "young_modulus"])
            .unwrap_err();
        assert_eq!(diagnosis.key.as_deref(), Some("layer.yuong_modulus"));
        assert_eq!(diagnosis.place.line(), 3);
        assert_eq!(
            diagnosis.help.as_deref(),
            Some("did you mean `young_modulus`?")
        );
    }

    #[test]
    fn a_missing_key_is_diagnosed_at_its_table() {
        let root = root("title = \"a\"\n[load]\n");
        let load = Reader::root(&root).unwrap().required("load", "").unwrap();
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
