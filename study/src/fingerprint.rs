//! The hash that identifies a study, computed from the base case with its defaults and from every value of every key,
//! each once.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use pellicle::case::output::OutputCase;
use pellicle::case::{BaseCase, Case};
use pellicle::input::dimension::Dimension;
use pellicle::input::key_path;
use pellicle::input::quantity;
use pellicle::input::toml_tree::{TomlNode, TomlTable, TomlValue};
use pellicle::input::units::{PROSE, Units};

use crate::Study;
use crate::StudyError;

/// The key that names a file.
const FILE: &str = "file";

/// Hashes everything on which the results of a study depend: version of the program, base case, keys, values, contents
/// of the maps, system of units, and first line of the table.
///
/// A quantity counts by its value, not its spelling; comments and the order of keys do not count. `valid` is a valid
/// case with its number, which supplies the defaults of the base case.
///
/// # Errors
///
/// [`StudyError::Case`] if the case has no JSON form.
pub fn of(study: &Study, valid: (usize, &Case), header: &str) -> Result<String, StudyError> {
    let (number, case) = valid;
    let units = case.units;
    let mut hasher = FingerprintHasher::default();
    hasher.add(b'v', env!("CARGO_PKG_VERSION").as_bytes());
    hasher.add(b'h', header.as_bytes());
    hasher.add(b'u', &[u8::from(units == Units::Si)]);
    hasher.add(b'c', study.case_name.as_bytes());
    let numbering = study.numbering();
    hasher.add(b'z', format!("{numbering:?}").as_bytes());
    // Values that every case replaces do not count. All others are in every case, as no case may have an unused key.
    hasher.add(b'r', &resolved(case)?);
    if let Ok(tree) = study.tree(number) {
        hasher.files_in("", &tree);
    }
    // If a study kept no fields, they cannot be had without solving it again.
    for field in &study.keep {
        hasher.add(b'K', format!("{field:?}").as_bytes());
    }
    for varied in study.varied_keys() {
        let path = key_path::parts(&varied.key).unwrap_or_default();
        hasher.add(b'k', path.join(".").as_bytes());
        let key = path.last().map_or("", String::as_str);
        for i in 0..varied.len() {
            if varied
                .dimension
                .is_some_and(|dimension| dimension != Dimension::Angle)
            {
                hasher.add(b'n', varied.cell(i).as_bytes());
            } else {
                hasher.node(key, &varied.value(i));
            }
        }
    }
    Ok(hasher.finish(&study.folder))
}

/// Hashes everything on which the cases of a search depend: version of the program, a case with its defaults, contents
/// of the maps, key and number.
#[must_use]
pub fn of_search(base: &BaseCase, case: &Case, key: &str, number: &str) -> String {
    let mut hasher = FingerprintHasher::default();
    hasher.add(b'v', env!("CARGO_PKG_VERSION").as_bytes());
    hasher.add(b'r', &resolved(case).unwrap_or_default());
    hasher.add(b'k', key.as_bytes());
    hasher.add(b'h', number.as_bytes());
    hasher.files_in("", &base.root);
    hasher.finish(base.folder())
}

/// The case with all defaults, without the choice of files.
fn resolved(case: &Case) -> Result<Vec<u8>, StudyError> {
    let mut case = serde_json::to_value(case)?;
    OutputCase::leave_out_files(&mut case);
    Ok(serde_json::to_vec(&case)?)
}

/// The hash so far, and the files whose contents are still to be hashed.
#[derive(Default)]
struct FingerprintHasher {
    hasher: blake3::Hasher,
    files: BTreeSet<String>,
}

impl FingerprintHasher {
    /// Adds bytes of one kind, preceded by their length, so that no two sequences of parts have the same hash input.
    fn add(&mut self, kind: u8, bytes: &[u8]) {
        self.hasher.update(&[kind]);
        self.hasher.update(&(bytes.len() as u64).to_le_bytes());
        self.hasher.update(bytes);
    }

    fn number(&mut self, number: f64) {
        self.add(b'n', format!("{number:e}").as_bytes());
    }

    /// Collects the files that a tree names: the resolved case does not contain the heights of a map read from a file.
    fn files_in(&mut self, key: &str, node: &TomlNode) {
        match &node.value {
            TomlValue::Text(text) if key == FILE => {
                self.files.insert(text.clone());
            }
            TomlValue::List(items) => items.iter().for_each(|item| self.files_in(key, item)),
            TomlValue::Table(table) => {
                let entries = table.entries.iter();
                entries.for_each(|entry| self.files_in(&entry.key, &entry.node));
            }
            _ => {}
        }
    }

    /// Adds the value of a key.
    fn node(&mut self, key: &str, node: &TomlNode) {
        match &node.value {
            TomlValue::Text(text) => self.text(key, text),
            TomlValue::Integer(number) => self.number(*number as f64),
            TomlValue::Float(number) => self.number(*number),
            TomlValue::Boolean(value) => self.add(b'b', &[u8::from(*value)]),
            TomlValue::Datetime => self.add(b'd', b""),
            TomlValue::List(items) => {
                self.add(b'l', &(items.len() as u64).to_le_bytes());
                items.iter().for_each(|item| self.node(key, item));
            }
            TomlValue::Table(table) => self.table(table),
        }
    }

    fn table(&mut self, table: &TomlTable) {
        let mut entries: Vec<_> = table.entries.iter().collect();
        entries.sort_by(|a, b| a.key.cmp(&b.key));
        self.add(b't', &(entries.len() as u64).to_le_bytes());
        for entry in entries {
            self.add(b'k', entry.key.as_bytes());
            self.node(&entry.key, &entry.node);
        }
    }

    fn text(&mut self, key: &str, text: &str) {
        if key == FILE {
            self.files.insert(text.to_owned());
        }
        let dimension = quantity::dimension_of(text).filter(|_| !PROSE.contains(&key));
        match dimension {
            // A bare angle has a different unit.
            Some(Dimension::Angle) | None => self.add(b's', text.as_bytes()),
            Some(dimension) => match quantity::parse(text, dimension) {
                Ok(number) => self.number(number),
                Err(_) => self.add(b's', text.as_bytes()),
            },
        }
    }

    /// Returns the hash, with the contents of the named files.
    fn finish(mut self, folder: &Path) -> String {
        for name in std::mem::take(&mut self.files) {
            self.add(b'f', name.as_bytes());
            match fs::read(folder.join(&name)) {
                Ok(bytes) => self.add(b'm', &bytes),
                Err(_) => self.add(b'x', b""),
            }
        }
        self.hasher.finalize().to_hex().to_string()
    }
}
