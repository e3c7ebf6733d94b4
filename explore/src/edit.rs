//! Changes of a case in its text, which keep its comments and its order.

mod starter;

use pellicle::input::key_path;
use serde::Deserialize;
use toml_edit::{DocumentMut, Item, Table, TableLike, Value};

pub use self::starter::Starters;

/// One change. A key is a path such as `foundation.layer[0].thickness`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "do", rename_all = "lowercase")]
pub enum Edit {
    /// Gives a key a value, read as `--set` reads it: as TOML, or else as a text.
    Set {
        /// The key.
        key: String,
        /// The value.
        to: String,
    },
    /// Gives a key a text, even if it reads like a number.
    Word {
        /// The key.
        key: String,
        /// The text.
        to: String,
    },
    /// Gives a table another kind, and the fields that this kind needs.
    Kind {
        /// The key of the table.
        key: String,
        /// The word of the kind.
        to: String,
    },
    /// Makes the value of a key a table with the fields that it needs.
    Table {
        /// The key.
        key: String,
    },
    /// Adds a table to a list of them, above the others: a copy of the first, if there is one.
    Add {
        /// The key of the list.
        key: String,
    },
    /// Removes a key, or an item of a list.
    Remove {
        /// The key.
        key: String,
    },
}

/// The reason why a text cannot be changed.
#[derive(Debug, thiserror::Error)]
pub enum EditError {
    /// The text is not TOML.
    #[error("found a text that is not TOML: {0}")]
    Text(#[from] toml_edit::TomlError),
    /// The key leads nowhere.
    #[error("found the key `{0}`, wanted one of a case")]
    Key(String),
}

/// The text of a case after some changes, in their order.
///
/// # Errors
///
/// [`EditError`] if the text is not TOML, or a key leads through a value that is no table.
pub fn edited(text: &str, edits: &[Edit], starters: &Starters) -> Result<String, EditError> {
    if edits.is_empty() {
        return Ok(text.to_owned());
    }
    let mut document: DocumentMut = text.parse()?;
    for edit in edits {
        apply(&mut document, edit, starters)?;
    }
    Ok(document.to_string())
}

fn apply(document: &mut DocumentMut, edit: &Edit, starters: &Starters) -> Result<(), EditError> {
    let (Edit::Set { key, .. }
    | Edit::Word { key, .. }
    | Edit::Kind { key, .. }
    | Edit::Table { key }
    | Edit::Add { key }
    | Edit::Remove { key }) = edit;
    let unknown = || EditError::Key(key.clone());
    let path = key_path::parts(key).ok_or_else(unknown)?;
    match edit {
        Edit::Remove { .. } => remove(document, &path),
        Edit::Set { to, .. } => put(document, &path, value(to)),
        Edit::Word { to, .. } => put(document, &path, to.as_str().into()),
        Edit::Kind { to, .. } => {
            at(document.as_table_mut(), &path).map(|table| starters.change_kind(table, &path, to))
        }
        Edit::Table { .. } => put_table(document, &path, starters),
        Edit::Add { .. } => add(document, &path, starters),
    }
    .ok_or_else(unknown)
}

/// A value as `--set` reads it.
fn value(text: &str) -> Value {
    text.trim().parse().unwrap_or_else(|_| text.trim().into())
}

/// The table at a path; missing ones are created.
fn at<'a>(mut table: &'a mut dyn TableLike, path: &[String]) -> Option<&'a mut dyn TableLike> {
    let mut path = path.iter();
    while let Some(key) = path.next() {
        // Between the keys of tables in one line there is no place for a header.
        let item = (table.entry(key)).or_insert_with(|| Item::Table(Table::new()));
        let list = matches!(item, Item::ArrayOfTables(_) | Item::Value(Value::Array(_)));
        let index = if list {
            Some(path.next()?.parse().ok()?)
        } else {
            None
        };
        table = match (item, index) {
            (Item::ArrayOfTables(list), Some(index)) => list.get_mut(index)?,
            (Item::Value(Value::Array(list)), Some(index)) => {
                list.get_mut(index)?.as_inline_table_mut()?
            }
            (item, _) => item.as_table_like_mut()?,
        };
    }
    Some(table)
}

fn put(document: &mut DocumentMut, path: &[String], mut value: Value) -> Option<()> {
    let (key, tables) = path.split_last()?;
    let table = at(document.as_table_mut(), tables)?;
    match table.get_mut(key) {
        // What is written behind a value is said about its key.
        Some(Item::Value(old)) => {
            *value.decor_mut() = old.decor().clone();
            *old = value;
        }
        _ => drop(table.insert(key, Item::Value(value))),
    }
    Some(())
}

fn put_table(document: &mut DocumentMut, path: &[String], starters: &Starters) -> Option<()> {
    let (key, tables) = path.split_last()?;
    let table = at(document.as_table_mut(), tables)?;
    let new = starters.table(path);
    // A table of the case has a header, one within another is written in a line.
    let item = if tables.is_empty() {
        Item::Table(new)
    } else {
        Item::Value(Value::InlineTable(new.into_inline_table()))
    };
    table.insert(key, item);
    Some(())
}

fn add(document: &mut DocumentMut, path: &[String], starters: &Starters) -> Option<()> {
    let (key, tables) = path.split_last()?;
    let table = at(document.as_table_mut(), tables)?;
    let new = || starters.table(&[path, &["0".to_owned()]].concat());
    match table.get_mut(key) {
        Some(Item::ArrayOfTables(list)) => {
            let first = list.get(0).cloned().unwrap_or_else(new);
            list.insert(0, first);
            // Where it stands follows from its place in the list.
            list.iter_mut().for_each(|table| table.set_position(None));
        }
        Some(Item::Value(Value::Array(list))) => {
            let first = list.get(0).cloned();
            let first = first.unwrap_or_else(|| Value::InlineTable(new().into_inline_table()));
            list.insert(0, first);
        }
        _ => {
            let list = toml_edit::Array::from_iter([Value::InlineTable(new().into_inline_table())]);
            table.insert(key, Item::Value(Value::Array(list)));
        }
    }
    Some(())
}

fn remove(document: &mut DocumentMut, path: &[String]) -> Option<()> {
    let (last, tables) = path.split_last()?;
    let Ok(index) = last.parse::<usize>() else {
        at(document.as_table_mut(), tables)?.remove(last);
        return Some(());
    };
    let (key, tables) = tables.split_last()?;
    let table = at(document.as_table_mut(), tables)?;
    let left = match table.get_mut(key)? {
        Item::ArrayOfTables(list) if index < list.len() => {
            list.remove(index);
            list.len()
        }
        Item::Value(Value::Array(list)) if index < list.len() => {
            list.remove(index);
            list.len()
        }
        _ => return None,
    };
    if left == 0 {
        table.remove(key);
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const CASE: &str = "# A ball.\n[foundation]\nsubstrate = { young_modulus = \"7 GPa\", poisson_ratio = 0.4 }  # soft\n\n\
        [[foundation.layer]]\nthickness = \"1 um\"   # thin\nyoung_modulus = \"70 GPa\"\npoisson_ratio = 0.3\n\n\
        [indenter]\nkind = \"paraboloid\"\nradius = \"1 mm\"\n\n[load]\nforce = \"10 mN\"\n";

    const CONE: &str = "[indenter]\nkind = \"cone\"\nhalf_angle = \"60 deg\"  # of a Rockwell\n";

    fn change(text: &str, edits: &str) -> String {
        let edits: Vec<Edit> = serde_json::from_str(edits).unwrap();
        edited(text, &edits, &Starters::new([CONE])).unwrap()
    }

    #[test]
    fn a_changed_value_leaves_every_other_byte() {
        let thick = change(
            CASE,
            r#"[{"do":"set","key":"foundation.layer[0].thickness","to":"2 um"}]"#,
        );
        assert_eq!(thick, CASE.replace("\"1 um\"", "\"2 um\""));
        let stiff = change(
            CASE,
            r#"[{"do":"set","key":"foundation.substrate.young_modulus","to":"8e9"}]"#,
        );
        assert_eq!(stiff, CASE.replace("\"7 GPa\"", "8e9"));
        assert_eq!(change(CASE, "[]"), CASE);
    }

    #[test]
    fn a_value_is_read_as_on_the_command_line() {
        let elements = change(CASE, r#"[{"do":"set","key":"grid.elements","to":"64"}]"#);
        assert!(elements.ends_with("[grid]\nelements = 64\n"), "{elements}");
        let title = change(CASE, r#"[{"do":"word","key":"title","to":"64"}]"#);
        assert!(title.contains("title = \"64\"\n"), "{title}");
    }

    #[test]
    fn a_layer_is_added_above_the_others_and_removed_again() {
        let two = change(
            CASE,
            r#"[{"do":"add","key":"foundation.layer"},{"do":"set","key":"foundation.layer[0].thickness","to":"5 nm"}]"#,
        );
        let at = |text: &str| two.find(text).unwrap();
        assert!(
            at("5 nm") < at("1 um") && at("1 um") < at("[indenter]"),
            "{two}"
        );
        let one = change(&two, r#"[{"do":"remove","key":"foundation.layer[0]"}]"#);
        assert!(!one.contains("5 nm") && one.contains("1 um"), "{one}");
        let none = change(&one, r#"[{"do":"remove","key":"foundation.layer.0"}]"#);
        assert!(!none.contains("layer"), "{none}");
        let again = change(&none, r#"[{"do":"add","key":"foundation.layer"}]"#);
        assert!(again.contains("layer = [{ thickness = "), "{again}");
    }

    #[test]
    fn another_kind_has_the_fields_that_it_needs_and_no_others() {
        let cone = change(CASE, r#"[{"do":"kind","key":"indenter","to":"cone"}]"#);
        assert!(
            cone.contains("kind = \"cone\"\nhalf_angle = \"60 deg\"\n"),
            "{cone}"
        );
        assert!(!cone.contains("radius"), "{cone}");
        let film = change(CASE, r#"[{"do":"kind","key":"surface","to":"film"}]"#);
        assert!(
            film.contains("[surface]\nkind = \"film\"\nthickness = "),
            "{film}"
        );
    }

    #[test]
    fn a_table_takes_the_place_of_a_word() {
        let rigid = change(
            CASE,
            r#"[{"do":"word","key":"foundation.substrate","to":"rigid"}]"#,
        );
        assert!(rigid.contains("substrate = \"rigid\"  # soft"), "{rigid}");
        let elastic = change(&rigid, r#"[{"do":"table","key":"foundation.substrate"}]"#);
        assert!(
            elastic.contains("substrate = { young_modulus = "),
            "{elastic}"
        );
        let body: Vec<Edit> =
            serde_json::from_str(r#"[{"do":"table","key":"indenter.body"}]"#).unwrap();
        let body = edited(CASE, &body, &Starters::new([CASE])).unwrap();
        assert!(
            body.contains("body = { substrate = { young_modulus = \"7 GPa\""),
            "{body}"
        );
        let stress = change(CASE, r#"[{"do":"table","key":"stress"}]"#);
        assert!(stress.ends_with("[stress]\n"), "{stress}");
    }

    #[test]
    fn a_key_that_leads_nowhere_is_named() {
        for key in ["foundation.layer[7].thickness", "title.a.b", "a..b", ""] {
            let edit = Edit::Set {
                key: key.into(),
                to: "1".into(),
            };
            let text = format!("title = \"\"\n{CASE}");
            let error = edited(&text, &[edit], &Starters::default()).unwrap_err();
            assert!(error.to_string().contains(&format!("`{key}`")), "{error}");
        }
    }
}
