//! The system of units of a case.

pub use pellicle_plot::display::Units;

use super::dimension::Dimension;
use super::quantity::dimension_of;
use super::toml_tree::{TomlNode, TomlValue};

/// The units of a case: SI if at least one value has a unit.
#[must_use]
pub fn of(root: &TomlNode) -> Units {
    if names_a_unit(&root.value) {
        Units::Si
    } else {
        Units::Consistent
    }
}

/// Keys whose text is never a quantity.
pub(crate) const PROSE: [&str; 2] = ["title", "file"];

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
        of(&toml_tree::parse(&Arc::new(Source::new("", text.into()))).unwrap())
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
