//! The JSON schema of a file, for editors that complete and check it while it is typed.
//!
//! Only what drafts 4 to 7 of JSON Schema share is used, since tools for TOML implement draft 4.

use serde_json::{Map, Value, json};

use crate::case::Case;

use super::shape::{Field, KindsShape, Presence, Shape, TableShape};

/// A number and something after it.
const WITH_UNIT: &str = r"^\s*[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?\s*[^0-9\s.].*$";

/// The schema of a file whose root is this table.
#[must_use]
pub fn of_file(title: &str, root: &TableShape) -> Value {
    let mut schema = json!({
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": title,
    });
    merge(&mut schema, table(root, &TableShape::default(), None));
    schema
}

/// The schema of a case.
#[must_use]
pub fn of_case() -> Value {
    of_file("A contact problem of Pellicle", &Case::shape())
}

/// A schema as text.
#[must_use]
pub fn text(schema: &Value) -> String {
    format!("{schema:#}\n")
}

fn merge(into: &mut Value, from: Value) {
    if let (Value::Object(into), Value::Object(from)) = (into, from) {
        into.extend(from);
    }
}

fn shape(of: &Shape) -> Value {
    match of {
        Shape::Quantity(..) => json!({
            "anyOf": [{ "type": "number" }, { "type": "string", "pattern": WITH_UNIT }],
        }),
        Shape::Number => json!({ "type": "number" }),
        Shape::Range(range) => json!({
            "type": "number", "minimum": range.start(), "maximum": range.end(),
        }),
        Shape::Count(range) => json!({
            "type": "integer", "minimum": range.start(), "maximum": range.end(),
        }),
        Shape::Words(words) => json!({ "enum": words }),
        Shape::Switch => json!({ "type": "boolean" }),
        Shape::Text => json!({ "type": "string" }),
        Shape::List(item, None) => json!({ "type": "array", "items": shape(item) }),
        Shape::List(item, Some(count)) => json!({
            "type": "array", "items": shape(item), "minItems": count, "maxItems": count,
        }),
        Shape::Table(fields) => table(fields, &TableShape::default(), None),
        Shape::Kinds(kinds) => json!({ "anyOf": self::kinds(kinds) }),
        Shape::Either(shapes) => {
            json!({ "anyOf": shapes.iter().map(shape).collect::<Vec<_>>() })
        }
    }
}

/// A schema for each kind, whose word is the only one allowed.
fn kinds(of: &KindsShape) -> Vec<Value> {
    let kind = |(word, meaning, fields): &(&'static str, &'static str, TableShape)| {
        let is_required = of.default != Some(*word);
        let kind = json!({ "enum": [word], "description": meaning });
        table(fields, &of.shared, Some((of.key, kind, is_required)))
    };
    of.kinds.iter().map(kind).collect()
}

/// A table of these fields, of those of every kind, and of the key of the kind itself.
fn table(of: &TableShape, shared: &TableShape, kind: Option<(&str, Value, bool)>) -> Value {
    let mut properties = Map::new();
    let mut required = Vec::new();
    if let Some((key, word, is_required)) = kind {
        properties.insert(key.into(), word);
        required.extend(is_required.then(|| Value::from(key)));
    }
    let is_alternative = |key: &str| [of, shared].iter().any(|of| of.one_of.contains(&key));
    let is_together = |key: &str| [of, shared].iter().any(|of| of.together.contains(&key));
    for field in of.fields.iter().chain(&shared.fields) {
        properties.insert(field.key.into(), property(field));
        let is_free = is_alternative(field.key) || is_together(field.key);
        if field.presence == Presence::Required && !is_free {
            required.push(field.key.into());
        }
    }
    let mut schema = json!({
        "type": "object", "properties": properties,
        "additionalProperties": of.open.or(shared.open).is_some(),
    });
    // Draft 4 knows no empty list of required keys.
    if !required.is_empty() {
        schema["required"] = required.into();
    }
    if !of.one_of.is_empty() {
        let each = of.one_of.iter().map(|key| json!({ "required": [key] }));
        schema["oneOf"] = each.collect();
    }
    let together: Vec<_> = [&of.together[..], &shared.together].concat();
    if !together.is_empty() {
        let all = |key: &&str| ((*key).to_owned(), json!(together));
        schema["dependencies"] = Value::Object(together.iter().map(all).collect());
    }
    schema
}

fn property(field: &Field) -> Value {
    let mut property = shape(&field.shape);
    let default = match &field.presence {
        Presence::Required => String::new(),
        Presence::Default(words) => format!("; if missing: {words}"),
    };
    let unit = field
        .shape
        .dimension()
        .map_or_else(String::new, |dimension| {
            let units: Vec<_> = dimension.unit_names().iter().take(6).copied().collect();
            format!(" ({})", units.join(", "))
        });
    property["description"] = format!("{}{unit}{default}", field.meaning).into();
    property
}
