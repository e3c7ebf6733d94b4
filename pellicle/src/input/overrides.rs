//! `--set key=value`: one value of the case replaced on the command line.

use std::sync::Arc;

use toml::de::DeValue;

use super::diagnosis::{Diagnosis, Fault};
use super::key_path;
use super::span::{COMMAND_LINE, Source, Span};
use super::toml_tree::{self, TomlEntry, TomlNode, TomlTable, TomlValue};

/// Replaces the value of a key in the tree by that in `argument`, `key.of.table=value`.
///
/// The value is read as TOML, or else as a string, so that `load.force=3 mN` needs no second pair of quotes. Items of
/// lists are numbered from 0: `foundation.layer.0.thickness`. Missing tables are created.
///
/// # Errors
///
/// A [`Diagnosis`] naming `--set` if the argument has no key or the key leads through a value that is not a table.
pub fn set(root: &mut TomlNode, argument: &str) -> Result<(), Diagnosis> {
    let source = Arc::new(Source::new(COMMAND_LINE, argument.to_owned()));
    let (key, value) = argument.split_once('=').ok_or_else(|| malformed(&source))?;
    let key_span = Span::new(&source, 0..key.len());
    let value = read(
        &source,
        argument.len() - value.trim_start().len(),
        value.trim(),
    );
    match key_path::parts(key) {
        Some(_) => replace(root, key, &key_span, value),
        None => Err(malformed(&source)),
    }
}

/// Replaces the value of a key, `foundation.layer[0].thickness`; missing tables are created.
///
/// # Errors
///
/// A [`Diagnosis`] if there is no such key and it cannot be created.
pub fn replace(
    root: &mut TomlNode,
    key: &str,
    key_span: &Span,
    value: TomlNode,
) -> Result<(), Diagnosis> {
    let diagnosis = |found| {
        let wanted = "a key of a case".into();
        Diagnosis::of_key(key.trim(), key_span.clone(), Fault::Wrong { found, wanted })
    };
    let parts = key_path::parts(key).ok_or_else(|| diagnosis(format!("`{key}`")))?;
    put(root, &parts, value, key_span).map_err(|at| {
        let found = format!("`{at}`, which is neither a table nor an item of the list");
        diagnosis(found).with_help("items of a list are counted from 0: `foundation.layer[0]`")
    })
}

fn malformed(source: &Arc<Source>) -> Diagnosis {
    let span = Span::new(source, 0..source.inner().len());
    let fault = Fault::Wrong {
        found: format!("`{}`", source.inner()),
        wanted: "key=value, such as load.force=\"3 mN\"".into(),
    };
    Diagnosis::of_text(span, fault)
}

fn read(source: &Arc<Source>, start: usize, text: &str) -> TomlNode {
    if let Ok(value) = DeValue::parse(text) {
        return toml_tree::node(source, start, &value);
    }
    TomlNode {
        value: TomlValue::Text(text.to_owned()),
        span: Span::new(source, start..start + text.len()),
    }
}

/// Puts the value at the end of the path; the error is the part that cannot be resolved.
fn put<'s>(
    node: &mut TomlNode,
    parts: &'s [String],
    value: TomlNode,
    at: &Span,
) -> Result<(), &'s str> {
    let Some((part, rest)) = parts.split_first() else {
        *node = value;
        return Ok(());
    };
    let next = match &mut node.value {
        TomlValue::Table(table) => entry(table, part, at),
        TomlValue::List(items) => part.parse().ok().and_then(|i: usize| items.get_mut(i)),
        _ => None,
    };
    put(next.ok_or(part.as_str())?, rest, value, at)
}

/// Returns the value of a key, created as an empty table if missing.
fn entry<'t>(table: &'t mut TomlTable, key: &str, at: &Span) -> Option<&'t mut TomlNode> {
    if table.entry(key).is_none() {
        table.entries.push(TomlEntry {
            key: key.to_owned(),
            key_span: at.clone(),
            node: TomlNode {
                value: TomlValue::Table(TomlTable::default()),
                span: at.clone(),
            },
        });
    }
    table.entry_mut(key).map(|entry| &mut entry.node)
}

#[cfg(test)]
mod tests {
    use super::super::table_reader::TableReader;
    use super::*;

    fn with(argument: &str) -> Result<TomlNode, Diagnosis> {
        let text = "[[foundation.layer]]\nthickness = 1\n[load]\nforce = 2\n";
        let mut root = toml_tree::parse(&Arc::new(Source::new("case.toml", text.into()))).unwrap();
        set(&mut root, argument).map(|()| root)
    }

    fn load(node: &TomlNode, key: &str) -> TomlValue {
        let root = TableReader::root(node).unwrap();
        let load = root.required("load", "").unwrap().table().unwrap();
        load.required(key, "").unwrap().value().clone()
    }

    #[test]
    fn a_value_is_parsed_as_toml_or_else_taken_as_text() {
        let set = |argument| load(&with(argument).unwrap(), "force");
        assert_eq!(set("load.force=3.5"), TomlValue::Float(3.5));
        assert_eq!(set("load.force = \"3 mN\""), TomlValue::Text("3 mN".into()));
        assert_eq!(set("load.force=3 mN"), TomlValue::Text("3 mN".into()));
        assert_eq!(set("load.force=true"), TomlValue::Boolean(true));
    }

    #[test]
    fn a_layer_is_addressed_by_its_number() {
        for key in [
            "foundation.layer.0.thickness",
            "foundation.layer[0].thickness",
        ] {
            let root = with(&format!("{key}=7")).unwrap();
            assert!(format!("{root:?}").contains("Integer(7)"), "{root:?}");
        }
        assert!(with("foundation.layer.1.thickness=7").is_err());
    }

    #[test]
    fn a_missing_table_is_created() {
        let root = with("grid.elements=64").unwrap();
        let root = TableReader::root(&root).unwrap();
        assert!(root.optional("grid").unwrap().is_table());
    }

    #[test]
    fn an_invalid_override_is_reported_with_its_option() {
        for argument in ["load.force", "=3", "load..force=1", "load.force.x=1", ""] {
            let message = with(argument).unwrap_err().to_string();
            assert!(message.starts_with("--set"), "{message}");
        }
    }
}
