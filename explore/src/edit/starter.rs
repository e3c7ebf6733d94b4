//! Values to start from, for tables that the page adds: those of commented cases, or else examples of the declarations.

use pellicle::case::Case;
use pellicle::declare::{Field, KindsShape, Presence, Shape, TableShape, keys};
use toml_edit::{DocumentMut, Item, Table, TableLike, Value};

/// Cases whose values are taken.
#[derive(Debug, Default)]
pub struct Starters(Vec<DocumentMut>);

impl Starters {
    /// Those of these texts; one that is not TOML is left out.
    #[must_use]
    pub fn new<'a>(texts: impl IntoIterator<Item = &'a str>) -> Self {
        Self(
            texts
                .into_iter()
                .filter_map(|text| text.parse().ok())
                .collect(),
        )
    }

    /// The table of a path with the fields that it needs.
    #[must_use]
    pub fn table(&self, path: &[String]) -> Table {
        let mut table = Table::new();
        let case = Case::shape();
        for shape in keys::at(&case, path) {
            match kind_or_table(shape) {
                Some(Fields::Table(of)) => self.complete(&mut table, path, &[of], None),
                Some(Fields::Kinds(of)) => {
                    let word = of.default.or(of.kinds.first().map(|(word, ..)| *word));
                    self.change_kind(&mut table, path, word.unwrap_or_default());
                }
                None => {}
            }
        }
        table
    }

    /// Gives a table another kind: fields that this does not have go, those that it needs come.
    pub fn change_kind(&self, table: &mut dyn TableLike, path: &[String], kind: &str) {
        let case = Case::shape();
        for shape in keys::at(&case, path) {
            let Some(Fields::Kinds(kinds)) = kind_or_table(shape) else {
                continue;
            };
            let Some((_, _, own)) = kinds.kinds.iter().find(|(word, ..)| *word == kind) else {
                continue;
            };
            let known = [own.keys(), kinds.shared.keys(), vec![kinds.key]].concat();
            let foreign = table.iter().map(|(key, _)| key.to_owned());
            let foreign: Vec<_> = foreign
                .filter(|key| !known.contains(&key.as_str()))
                .collect();
            for key in foreign {
                table.remove(&key);
            }
            match table.get_mut(kinds.key).and_then(Item::as_value_mut) {
                Some(word) => {
                    let decor = word.decor().clone();
                    *word = kind.into();
                    *word.decor_mut() = decor;
                }
                None => drop(table.insert(kinds.key, toml_edit::value(kind))),
            }
            self.complete(table, path, &[own, &kinds.shared], Some((kinds.key, kind)));
        }
    }

    /// Adds the missing fields that are required.
    fn complete(
        &self,
        table: &mut dyn TableLike,
        path: &[String],
        shapes: &[&TableShape],
        kind: Option<(&str, &str)>,
    ) {
        for shape in shapes {
            let is_given = |key: &&&str| table.contains_key(key);
            let mut alternative = shape.one_of.iter().find(is_given).copied();
            for field in &shape.fields {
                let is_free = shape.together.contains(&field.key);
                if field.presence != Presence::Required || is_free || table.contains_key(field.key)
                {
                    continue;
                }
                let one_of = shape.one_of.contains(&field.key);
                if one_of && alternative.is_some() {
                    continue;
                }
                if let Some(value) = self.value(path, field, kind) {
                    alternative = alternative.or(one_of.then_some(field.key));
                    table.insert(field.key, Item::Value(value.decorated(" ", "")));
                }
            }
        }
    }

    /// A value of a field: that of a case in which the table has this kind, or of any case, or an example.
    fn value(&self, path: &[String], field: &Field, kind: Option<(&str, &str)>) -> Option<Value> {
        // The indenter's body is made as the foundation is.
        let path = match path {
            [indenter, body, rest @ ..] if indenter == "indenter" && body == "body" => {
                &[&["foundation".to_owned()], rest].concat()
            }
            path => path,
        };
        let tables = || self.0.iter().filter_map(|case| table_at(case, path));
        let of_kind = |table: &&dyn TableLike| {
            kind.is_none_or(|(key, word)| table.get(key).and_then(Item::as_str) == Some(word))
        };
        let value = |table: &dyn TableLike| table.get(field.key)?.as_value().cloned();
        let alike = tables().filter(of_kind).find_map(value);
        alike
            .or_else(|| tables().find_map(value))
            .or_else(|| example(&field.shape))
    }
}

/// A table, or one whose fields depend on a word.
enum Fields<'a> {
    Table(&'a TableShape),
    Kinds(&'a KindsShape),
}

fn kind_or_table(shape: &Shape) -> Option<Fields<'_>> {
    match shape {
        Shape::Table(table) => Some(Fields::Table(table)),
        Shape::Kinds(kinds) => Some(Fields::Kinds(kinds)),
        Shape::Either(shapes) => shapes.iter().find_map(kind_or_table),
        _ => None,
    }
}

/// The table of a path in a case; an item of a list stands for any.
fn table_at<'a>(case: &'a DocumentMut, path: &[String]) -> Option<&'a dyn TableLike> {
    let mut table: &dyn TableLike = case.as_table();
    for key in path.iter().filter(|key| key.parse::<usize>().is_err()) {
        table = match table.get(key)? {
            Item::ArrayOfTables(list) => list.get(0)?,
            Item::Value(Value::Array(list)) => list.get(0)?.as_inline_table()?,
            item => item.as_table_like()?,
        };
    }
    Some(table)
}

fn example(shape: &Shape) -> Option<Value> {
    Some(match shape {
        Shape::Quantity(dimension, _) => dimension.example().parse().ok()?,
        Shape::Words(words) => (*words.first()?).into(),
        Shape::Count(range) => i64::try_from(*range.start()).ok()?.into(),
        Shape::Range(range) => (0.5 * (range.start() + range.end())).into(),
        Shape::Switch => false.into(),
        Shape::List(item, count) => {
            let item = example(item)?;
            Value::Array(std::iter::repeat_n(item, count.unwrap_or(1)).collect())
        }
        Shape::Either(shapes) => shapes.iter().find_map(example)?,
        _ => return None,
    })
}
