//! A commented case completed by its declarations: the keys that it leaves out.

use super::keys::value;
use super::shape::{Field, KindsShape, Presence, Shape, TableShape};

/// The text of a case with a comment at its end: every key that may be left out and that the text does not mention,
/// with its value, its meaning and what holds without it.
#[must_use]
pub fn with_other_keys(text: &str, root: &TableShape) -> String {
    let mut others = String::new();
    for field in &root.fields {
        let section = Section::of(text, field.key);
        let rows: String = match &field.shape {
            Shape::Table(table) => section.others(&table.fields),
            Shape::Kinds(kinds) => section.others_of_kind(kinds),
            _ => String::new(),
        };
        if !rows.is_empty() {
            others = format!("{others}#  [{}]\n{rows}", field.key);
        }
        // Of a list of tables, the keys of one.
        let inner = field.shape.tables().into_iter().flat_map(|of| &of.fields);
        for (key, table) in inner.filter_map(items) {
            let path = format!("{}.{key}", field.key);
            let rows = Section::of(text, &path).others(&table.fields);
            if !rows.is_empty() {
                others = format!("{others}#  [[{path}]]\n{rows}");
            }
        }
    }
    format!("{}\n\n{HEAD}{others}", text.trim_end())
}

/// The first line of the comment.
const HEAD: &str = "# Further keys: value, meaning, and what holds without them.\n#\n";

/// The tables of a field that is a list of them.
fn items(field: &Field) -> Option<(&'static str, &TableShape)> {
    match &field.shape {
        Shape::List(item, _) => match &**item {
            Shape::Table(table) => Some((field.key, table)),
            _ => None,
        },
        _ => None,
    }
}

/// The lines of a table in a text, those in comments included.
struct Section<'a> {
    lines: Vec<&'a str>,
}

impl<'a> Section<'a> {
    fn of(text: &'a str, path: &str) -> Self {
        let mut lines = Vec::new();
        let mut is_in = false;
        for line in text.lines() {
            let line = line.trim_start_matches(['#', ' ']);
            if let Some(header) = line.strip_prefix('[') {
                let name = header.trim_start_matches('[').split(']').next();
                is_in = name == Some(path);
            } else if is_in {
                lines.push(line);
            }
        }
        Self { lines }
    }

    /// The value of a key, if the section has it.
    fn value(&self, key: &str) -> Option<&'a str> {
        let mut pairs = self.lines.iter().filter_map(|line| line.split_once('='));
        pairs.find_map(|(found, value)| (found.trim() == key).then_some(value.trim()))
    }

    /// The lines of the keys that may be left out and are.
    fn others<'b>(&self, fields: impl IntoIterator<Item = &'b Field>) -> String {
        let rows = fields.into_iter().filter_map(|field| {
            let Presence::Default(without) = &field.presence else {
                return None;
            };
            let is_told = self.value(field.key).is_some() || items(field).is_some();
            let (key, meaning) = (field.key, field.meaning);
            let value = value(&field.shape).replace('`', "");
            (!is_told).then(|| format!("#   {key}: {value}; {meaning}; without it {without}\n"))
        });
        rows.collect::<Vec<_>>().concat()
    }

    /// The same of a table whose keys depend on its kind.
    fn others_of_kind(&self, kinds: &KindsShape) -> String {
        let given = self.value(kinds.key).map(|word| word.split('"').nth(1));
        let kind = given.unwrap_or(kinds.default);
        let own = kinds.kinds.iter().find(|(word, ..)| Some(*word) == kind);
        let own = own.into_iter().flat_map(|(_, _, table)| &table.fields);
        let mut rows = self.others(own.chain(&kinds.shared.fields));
        if given.is_none() {
            let words: Vec<_> = kinds.kinds.iter().map(|(word, ..)| *word).collect();
            let (key, words) = (kinds.key, words.join("\", \""));
            let without = kinds.default.map_or("", |word| word);
            rows = format!("{rows}#   {key}: \"{words}\"; without it \"{without}\"\n");
        }
        for key in &kinds.shared.together {
            let field = kinds.shared.fields.iter().find(|field| field.key == *key);
            if let (None, Some(field)) = (self.value(key), field) {
                let value = value(&field.shape);
                rows = format!(
                    "{rows}#   {key}: {value}; {}; without it rigid\n",
                    field.meaning
                );
            }
        }
        rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;

    #[test]
    fn a_case_is_completed_by_the_keys_that_it_does_not_mention() {
        let text = "[indenter]\nkind = \"cone\"\nhalf_angle = 1.2\n\n# [grid]\n# elements = 64\n";
        let whole = with_other_keys(text, &Case::shape());
        let told = |line: &str| whole.lines().any(|of| of.starts_with(line));
        assert!(whole.starts_with(text.trim_end()));
        assert!(told(
            "#   tip_radius: a length; radius of the rounded tip; without it 0, sharp"
        ));
        assert!(told("#   side: a length") && !told("#   elements"));
        assert!(told("#   kind: \"bare\", \"cylinders\"") && !told("#   half_angle"));
        assert!(told("#  [[foundation.layer]]") && told("#   interface_shear_strength"));
        assert!(told(
            "#   young_modulus: a pressure; Young's modulus of the indenter"
        ));
    }
}
