//! The keys of a file: as a list in Markdown, and the dimension of each.

use std::collections::BTreeMap;

use super::shape::{Field, Presence, Shape, TableShape};
use crate::input::dimension::Dimension;
use crate::input::key_path::dotted;

/// All fields of a table and of the tables within it, each key once.
#[must_use]
pub fn fields(root: &TableShape) -> BTreeMap<&'static str, &Shape> {
    let mut found = BTreeMap::new();
    collect(root, &mut found);
    found
}

fn collect<'a>(table: &'a TableShape, found: &mut BTreeMap<&'static str, &'a Shape>) {
    for field in &table.fields {
        found.entry(field.key).or_insert(&field.shape);
        for inner in field.shape.tables() {
            collect(inner, found);
        }
    }
}

/// What the value at a path may be, such as `foundation.layer.0.thickness`: one shape for each kind of table that has
/// the key; none if no table has it.
#[must_use]
pub fn at<'a>(root: &'a TableShape, path: &[String]) -> Vec<&'a Shape> {
    let Some((key, rest)) = path.split_first() else {
        return Vec::new();
    };
    let fields = root.fields.iter().filter(|field| field.key == key);
    fields
        .flat_map(|field| within(&field.shape, rest))
        .collect()
}

fn within<'a>(shape: &'a Shape, path: &[String]) -> Vec<&'a Shape> {
    let Some((first, rest)) = path.split_first() else {
        return vec![shape];
    };
    match shape {
        Shape::List(item, _) if first.parse::<usize>().is_ok() => within(item, rest),
        Shape::List(..) => Vec::new(),
        Shape::Either(shapes) => {
            let shapes = shapes.iter();
            shapes.flat_map(|shape| within(shape, path)).collect()
        }
        _ => {
            let tables = shape.tables().into_iter();
            tables.flat_map(|table| at(table, path)).collect()
        }
    }
}

/// The dimension of each value that has one, by its key and those of the tables around it, such as
/// `foundation.layer.thickness`.
#[must_use]
pub fn dimensions(root: &TableShape) -> BTreeMap<String, Dimension> {
    let mut found = BTreeMap::new();
    collect_dimensions("", root, &mut found);
    found
}

fn collect_dimensions(path: &str, table: &TableShape, found: &mut BTreeMap<String, Dimension>) {
    for field in &table.fields {
        let path = dotted(path, field.key);
        for inner in field.shape.tables() {
            collect_dimensions(&path, inner, found);
        }
        if let Some(dimension) = field.shape.dimension() {
            found.entry(path).or_insert(dimension);
        }
    }
}

/// The SI unit of each key whose value is a number or several, as in messages: `dimensionless` for one without.
#[must_use]
pub fn si_units(root: &TableShape) -> BTreeMap<&'static str, &'static str> {
    let is_number = |shape: &Shape| match shape {
        Shape::Number | Shape::Range(_) => true,
        Shape::Either(shapes) => shapes.contains(&Shape::Number),
        _ => false,
    };
    let of_key = |(key, shape): (&'static str, &Shape)| {
        let unit = match shape.dimension() {
            Some(dimension) => dimension.si_unit(),
            None if is_number(shape) => "dimensionless",
            None => return None,
        };
        Some((key, unit))
    };
    fields(root).into_iter().filter_map(of_key).collect()
}

/// The list of keys in Markdown: a table for each table of the file and for each of its kinds.
#[must_use]
pub fn markdown(root: &TableShape) -> String {
    let mut text = String::new();
    section(&mut text, "", root);
    text
}

fn section(text: &mut String, path: &str, table: &TableShape) {
    rows(text, table);
    inside(text, path, table);
}

/// The table of the fields.
fn rows(text: &mut String, table: &TableShape) {
    let further = table
        .open
        .map(|meaning| format!("| others | a table or a value | {meaning} | none |\n"));
    let rows = table.fields.iter().map(|field| row(field, table));
    let rows: Vec<_> = rows.chain(further).collect();
    if !rows.is_empty() {
        *text += "| key | value | meaning | if missing |\n|---|---|---|---|\n";
        rows.iter().for_each(|row| *text += row);
        text.push('\n');
    }
}

/// The tables within a table.
fn inside(text: &mut String, path: &str, table: &TableShape) {
    for field in &table.fields {
        let path = match path {
            "" => field.key.to_owned(),
            path => format!("{path}.{}", field.key),
        };
        inner(text, &path, field.meaning, &field.shape);
    }
}

fn inner(text: &mut String, path: &str, meaning: &str, shape: &Shape) {
    match shape {
        Shape::Table(table) => {
            add(text, &format!("### `[{path}]`: {meaning}\n\n"));
            section(text, path, table);
        }
        Shape::List(item, _) if matches!(**item, Shape::Table(_)) => {
            if let Shape::Table(table) = &**item {
                add(text, &format!("### `[[{path}]]`: {meaning}\n\n"));
                section(text, path, table);
            }
        }
        Shape::Kinds(kinds) => {
            add(text, &format!("### `[{path}]`: {meaning}\n\n"));
            rows(text, &kinds.shared);
            for (word, meaning, table) in &kinds.kinds {
                let default = if kinds.default == Some(*word) {
                    ", the default"
                } else {
                    ""
                };
                add(
                    text,
                    &format!("`{} = \"{word}\"`: {meaning}{default}\n\n", kinds.key),
                );
                section(text, path, table);
            }
            inside(text, path, &kinds.shared);
        }
        Shape::Either(shapes) => {
            let tables = shapes.iter().filter_map(|shape| match shape {
                // Ranges are the same everywhere.
                Shape::Table(table) if !table.keys().contains(&"count") => Some(table),
                _ => None,
            });
            for table in tables {
                add(text, &format!("`{path} = {{ … }}`:\n\n"));
                section(text, path, table);
            }
        }
        _ => {}
    }
}

fn add(text: &mut String, more: &str) {
    text.push_str(more);
}

fn row(field: &Field, table: &TableShape) -> String {
    let missing = match &field.presence {
        Presence::Required if table.one_of.contains(&field.key) => "one of these is required",
        Presence::Required if table.together.contains(&field.key) => "none of these, or all",
        Presence::Required => "required",
        Presence::Default(words) => words,
    };
    let (key, value) = (field.key, value(&field.shape));
    format!("| `{key}` | {value} | {} | {missing} |\n", field.meaning)
}

/// What a value may be, in words.
#[must_use]
pub fn value(shape: &Shape) -> String {
    match shape {
        Shape::Quantity(dimension, _) => dimension.noun().into(),
        Shape::Number | Shape::Range(_) => "a number".into(),
        Shape::Count(range) if *range.end() == usize::MAX => {
            format!("an integer from {} on", range.start())
        }
        Shape::Count(range) => format!("{} to {}", range.start(), range.end()),
        Shape::Words(words) => format!("`\"{}\"`", words.join("\"`, `\"")),
        Shape::Switch => "`true`, `false`".into(),
        Shape::Text => "a text".into(),
        Shape::List(item, None) => format!("a list of {}", value(item)),
        Shape::List(item, Some(count)) => format!("a list of {count}: {}", value(item)),
        Shape::Table(table) if table.keys().contains(&"count") => {
            "`{ from, to, count, spacing }`".into()
        }
        Shape::Table(_) | Shape::Kinds(_) => "a table".into(),
        Shape::Either(shapes) => {
            let values: Vec<_> = shapes.iter().map(value).collect();
            values.join(" or ")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;

    #[test]
    fn a_path_leads_through_kinds_and_lists() {
        let case = Case::shape();
        let shapes = |path: &str| {
            let path: Vec<_> = path.split('.').map(str::to_owned).collect();
            at(&case, &path).into_iter().map(value).collect::<Vec<_>>()
        };
        assert!(shapes("surface.period")[0].starts_with("a length"));
        assert!(shapes("foundation.layer.1.thickness")[0].starts_with("a length"));
        assert!(shapes("foundation.layer.thickness").is_empty());
        assert!(shapes("surface.perod").is_empty());
        assert!(shapes("grid.elements")[0].contains(" to "));
    }

    #[test]
    fn every_quantity_has_its_unit() {
        let units = si_units(&Case::shape());
        for (key, unit) in [
            ("thickness", "m"),
            ("young_modulus", "Pa"),
            ("poisson_ratio", "dimensionless"),
            ("shear_compliance", "m/Pa"),
            ("half_angle", "rad"),
            ("offset", "m"),
            ("height_unit", "m"),
            ("forces", "N"),
            ("depths", "m"),
            ("friction", "dimensionless"),
            ("tolerance", "dimensionless"),
        ] {
            assert_eq!(units.get(key), Some(&unit), "{key}");
        }
    }
}
