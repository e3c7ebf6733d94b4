//! The system of units of a case.

use serde::{Deserialize, Serialize};

use super::dimension::Dimension;
use super::quantity::dimension_of;
use super::toml_tree::{TomlNode, TomlValue};

/// The system of units of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Units {
    /// Metres, pascals and newtons: at least one length, pressure or force has a unit.
    Si,
    /// Any consistent system: all numbers are bare, and only the author of the case knows the units.
    #[default]
    Consistent,
}

impl Units {
    /// The units of a case: SI if at least one value has a unit.
    #[must_use]
    pub fn of(root: &TomlNode) -> Self {
        if names_a_unit(&root.value) {
            Self::Si
        } else {
            Self::Consistent
        }
    }

    /// The units of a case with parts in these two systems.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        match (self, other) {
            (Self::Consistent, Self::Consistent) => Self::Consistent,
            _ => Self::Si,
        }
    }

    /// The name of an SI unit, or `case units` in a consistent system.
    #[must_use]
    pub fn name(self, si: &'static str) -> &'static str {
        match self {
            Self::Si => si,
            Self::Consistent => "case units",
        }
    }
}

/// Keys whose text is never a quantity.
pub const PROSE: [&str; 2] = ["title", "file"];

fn names_a_unit(value: &TomlValue) -> bool {
    match value {
        TomlValue::Text(text) => dimension_of(text).is_some_and(|found| found != Dimension::Angle),
        TomlValue::List(items) => items.iter().any(|item| names_a_unit(&item.value)),
        // A title or file name is prose, even if it begins like a quantity.
        TomlValue::Table(table) => {
            let mut entries = table
                .entries
                .iter()
                .filter(|entry| !PROSE.contains(&entry.key.as_str()));
            entries.any(|entry| names_a_unit(&entry.node.value))
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::super::span::Source;
    use super::super::toml_tree;
    use super::*;

    fn units(text: &str) -> Units {
        Units::of(&toml_tree::parse(&Arc::new(Source::new("", text.into()))).unwrap())
    }

    #[test]
    fn a_single_unit_makes_a_case_si() {
        assert_eq!(units("a = 1\nb = [{ c = \"5 nm\" }]"), Units::Si);
    }

    #[test]
    fn titles_and_angles_do_not_make_a_case_si() {
        assert_eq!(
            units("title = \"5 nm\"\nhalf_angle = \"70 deg\""),
            Units::Consistent
        );
    }
}
