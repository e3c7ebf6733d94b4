//! A line of `solve --stream`: an object of keys and values as JSON, each key once.

use std::fmt;
use std::sync::Arc;

use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};

use crate::failure::Failure;
use crate::input::key_path;
use crate::input::span::{STREAM, Source, Span};
use crate::input::toml_tree::{TomlEntry, TomlNode, TomlTable, TomlValue};

/// A value that takes the place of the case's own.
pub struct Replacement {
    /// Its key, such as `foundation.layer[0].thickness`.
    pub key: String,
    pub value: TomlNode,
    /// The whole line.
    pub span: Span,
}

/// Reads the keys of a line, each with its value: `{"load.force": "3 mN", "grid.elements": 64}`.
///
/// # Errors
///
/// [`Failure::Line`] if it is not an object in UTF-8, if a key is there twice, or if a key is part of another's value.
pub fn replacements(line: usize, bytes: &[u8]) -> Result<Vec<Replacement>, Failure> {
    let wrong = |found, wanted| Failure::Line {
        line,
        found,
        wanted,
    };
    let text = str::from_utf8(bytes).map_err(|error| {
        let byte = bytes[error.valid_up_to()];
        let found = format!("the byte 0x{byte:02x}, which is not UTF-8");
        wrong(found, "JSON in UTF-8")
    })?;
    let read = serde_json::from_str(text).map_err(|cause| wrong(cause.to_string(), OBJECT))?;
    let UniqueKeys(Value::Object(entries)) = read else {
        return Err(wrong("other JSON".into(), OBJECT));
    };
    if let Some([one, other]) = overlap(&entries) {
        let found = format!("the keys `{one}` and `{other}`, which overlap");
        return Err(wrong(found, "each key once"));
    }
    let name = format!("{STREAM}, line {line}");
    let whole = span(&name, text.to_owned());
    let replacement = |(key, value)| Replacement {
        key,
        value: node(value, &name),
        span: whole.clone(),
    };
    Ok(entries.into_iter().map(replacement).collect())
}

/// The form of a line.
const OBJECT: &str = "an object of keys and values, such as {\"load.force\": \"3 mN\"}";

/// Two keys of which one is the other, perhaps spelt differently, or a table in which the other lies.
fn overlap(entries: &Map<String, Value>) -> Option<[&str; 2]> {
    let paths: Vec<_> = (entries.keys())
        .filter_map(|key| Some((key.as_str(), key_path::parts(key)?)))
        .collect();
    paths.iter().enumerate().find_map(|(i, (key, path))| {
        let mut before = paths[..i].iter();
        let found = before.find(|(_, other)| path.starts_with(other) || other.starts_with(path));
        found.map(|(other, _)| [*other, *key])
    })
}

/// A value of JSON of which no object has a key twice; serde's own reader keeps the last silently.
struct UniqueKeys(Value);

impl<'de> Deserialize<'de> for UniqueKeys {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(UniqueKeysVisitor).map(Self)
    }
}

struct UniqueKeysVisitor;

impl<'de> Visitor<'de> for UniqueKeysVisitor {
    type Value = Value;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a value of JSON")
    }

    fn visit_unit<E: Error>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_str<E: Error>(self, value: &str) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Value, A::Error> {
        let mut list = Vec::new();
        while let Some(UniqueKeys(item)) = items.next_element()? {
            list.push(item);
        }
        Ok(list.into())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut object = Map::new();
        while let Some((key, UniqueKeys(value))) = entries.next_entry::<String, _>()? {
            if object.contains_key(&key) {
                return Err(A::Error::custom(format_args!("the key `{key}` twice")));
            }
            object.insert(key, value);
        }
        Ok(object.into())
    }
}

/// Converts a JSON value to TOML. TOML has no null: it becomes a date, which no key accepts.
fn node(value: Value, name: &str) -> TomlNode {
    let span = span(name, value.to_string());
    let value = match value {
        Value::Null => TomlValue::Datetime,
        Value::Bool(value) => TomlValue::Boolean(value),
        Value::Number(number) => match number.as_i64() {
            Some(number) => TomlValue::Integer(number),
            None => TomlValue::Float(number.as_f64().unwrap_or(f64::NAN)),
        },
        Value::String(text) => TomlValue::Text(text),
        Value::Array(items) => {
            let items = items.into_iter();
            TomlValue::List(items.map(|item| node(item, name)).collect())
        }
        Value::Object(entries) => {
            let entry = |(key, value)| TomlEntry {
                key,
                key_span: span.clone(),
                node: node(value, name),
            };
            let entries = entries.into_iter().map(entry).collect();
            TomlValue::Table(TomlTable { entries })
        }
    };
    TomlNode { value, span }
}

/// The position of a value, which messages quote, in a text of its own.
fn span(name: &str, text: String) -> Span {
    let source = Arc::new(Source::new(name, text));
    Span::new(&source, 0..source.inner().len())
}
