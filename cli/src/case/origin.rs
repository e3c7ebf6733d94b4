//! Where a case was written: kept for what goes wrong, or is doubtful, after it was read.

use std::sync::Arc;

use super::diagnosis::{Diagnosis, Fault};
use super::document::{Node, Value};
use super::field::Field;
use super::overrides;

/// The tree that a case was read from. It is no part of what the case says: any two are equal.
#[derive(Debug, Clone)]
pub struct Origin(Arc<Node>);

impl PartialEq for Origin {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Origin {
    /// Keeps the tree.
    #[must_use]
    pub fn new(root: &Node) -> Self {
        Self(Arc::new(root.clone()))
    }

    /// The tree.
    #[must_use]
    pub fn root(&self) -> &Node {
        &self.0
    }

    /// The diagnosis that the value of the first of these keys that is there is refused, for this reason.
    #[must_use]
    pub fn refused(&self, keys: &[&str], reason: &dyn std::error::Error) -> Diagnosis {
        let found = keys.iter().find_map(|key| self.field(key));
        found.map_or_else(
            || {
                let (found, reason) = ("this case".into(), reason.to_string());
                Diagnosis::of_text(self.0.place.clone(), Fault::Refused { found, reason })
            },
            |field| field.refused(reason),
        )
    }

    fn field(&self, key: &str) -> Option<Field<'_>> {
        let mut node = self.root();
        for step in overrides::steps(key)? {
            node = match &node.value {
                Value::Table(table) => &table.entry(&step)?.node,
                Value::List(items) => items.get(step.parse::<usize>().ok()?)?,
                _ => return None,
            };
        }
        Some(Field::new(key.to_owned(), node))
    }
}
