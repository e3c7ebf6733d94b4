//! The key `omit` of a fit file: rows of a measurement that are left out by hand.

use std::path::{Path, PathBuf};

use pellicle::declare::shape::{Shape, TableShape};
use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::toml_tree::TomlValue;
use pellicle::input::value_reader::ValueReader;

use super::curve_segment::ROWS;

/// Rows that are left out by hand.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct OmittedRows {
    /// The name of a file and its rows, from 1.
    of_files: Vec<(String, Vec<usize>)>,
}

const WANTED: &str = "the numbers of rows, such as [31, 44], or for several files a table of such lists by the \
                      names of the files, such as { \"test03.csv\" = [31] }";

impl OmittedRows {
    /// What it may be.
    #[must_use]
    pub fn shape() -> Shape {
        let by_file = TableShape::default().open_to("the name of a file, and its rows");
        Shape::Either(vec![Shape::list(Shape::Count(ROWS)), Shape::Table(by_file)])
    }

    /// Reads the list, or the table of lists; `files` are those of the `[[data]]` table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn read(field: &ValueReader<'_>, files: &[PathBuf]) -> Result<Self, Diagnosis> {
        let of_files = match (field.value(), files) {
            (TomlValue::List(_), [file]) => vec![(name(file), rows(field)?)],
            // Without files, a plan needs no rows.
            (TomlValue::List(_), []) => vec![(String::new(), rows(field)?)],
            (TomlValue::Table(table), _) => {
                let entries = table.entries.iter();
                let of_entry = |entry: &pellicle::input::toml_tree::TomlEntry| {
                    let path = format!("{}.{}", field.path(), entry.key);
                    let field = ValueReader::new(path, &entry.node);
                    if !files.is_empty() && !files.iter().any(|file| name(file) == entry.key) {
                        let names: Vec<String> = files.iter().map(|file| name(file)).collect();
                        return Err(field.wanted(format!("rows of one of {}", names.join(", "))));
                    }
                    Ok((entry.key.clone(), rows(&field)?))
                };
                entries.map(of_entry).collect::<Result<_, _>>()?
            }
            _ => return Err(field.wanted(WANTED)),
        };
        Ok(Self { of_files })
    }

    /// The rows of a file, from 1.
    #[must_use]
    pub fn of(&self, file: &Path) -> &[usize] {
        let found = self.of_files.iter().find(|(of, _)| *of == name(file));
        found.map_or(&[], |(_, rows)| rows)
    }
}

fn name(file: &Path) -> String {
    let name = file.file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

fn rows(field: &ValueReader<'_>) -> Result<Vec<usize>, Diagnosis> {
    let row = |item: &ValueReader<'_>| item.count(ROWS, ", the number of a row of the table");
    field.items(WANTED)?.iter().map(row).collect()
}
