//! A value where a case has a table, such as `load = "200 mN"`: the diagnosis names the key that it was meant for.

use crate::declare::shape::{Field, Shape, TableShape};
use crate::input::diagnosis::Diagnosis;
use crate::input::quantity;
use crate::input::table_reader::TableReader;
use crate::input::toml_tree::TomlValue;

/// Refuses a text where a case has a table, with the key whose dimension it has, or `kind` for a word.
///
/// # Errors
///
/// A [`Diagnosis`] of the first such text.
pub(super) fn refuse(case: &TableReader<'_>, shape: &TableShape) -> Result<(), Diagnosis> {
    for field in &shape.fields {
        let Some(value) = case.optional(field.key) else {
            continue;
        };
        if let (TomlValue::Text(text), false) = (value.value(), field.shape.tables().is_empty())
            && let Some(key) = meant(&field.shape, text)
        {
            return Err(value.wanted(format!("a table, such as {{ {key} = \"{text}\" }}")));
        }
    }
    Ok(())
}

/// The key of a table for which a text was meant.
fn meant(table: &Shape, text: &str) -> Option<&'static str> {
    let fits = |field: &&Field| {
        let dimension = field.shape.dimension();
        dimension.is_some_and(|dimension| quantity::parse(text, dimension).is_ok())
    };
    let of_dimension = table
        .tables()
        .into_iter()
        .flat_map(|table| &table.fields)
        .find(fits);
    let is_word = text
        .chars()
        .all(|letter| letter.is_alphabetic() || "-_ ".contains(letter));
    let kind = || match table {
        Shape::Kinds(kinds) if is_word => Some(kinds.key),
        _ => None,
    };
    of_dimension.map(|field| field.key).or_else(kind)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;

    #[test]
    fn a_value_is_answered_with_the_key_that_it_was_meant_for() {
        for (table, text, wanted) in [
            ("load", "200 mN", Some("force")),
            ("load", "20 nm", Some("penetration")),
            ("indenter", "5 um", Some("radius")),
            ("indenter", "ball", Some("kind")),
            ("load", "heavy", None),
        ] {
            let fields = Case::shape().fields;
            let field = fields.iter().find(|field| field.key == table).unwrap();
            assert_eq!(meant(&field.shape, text), wanted, "{table} {text}");
        }
    }
}
