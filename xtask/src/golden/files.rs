//! The values in the files that a run writes.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use ndarray::{ArrayD, OwnedRepr};
use ndarray_npy::{NpzReader, ReadableElement};
use serde_json::{Value, json};

use super::leaves::leaves;
use super::outcome::Outcome;
use super::steady::steady;
use crate::XtaskError;

/// What is kept of the files that a run writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Files {
    /// The cells of tables and the arrays of fields.
    Numbers,
    /// Also the values of summaries, and a hash of every other file.
    All,
}

/// The values of a file, or of all files below a folder that are not hidden, by their names and paths inside. Nothing
/// if it does not exist.
pub fn values(out: &Path, kept: Files) -> Result<Outcome, XtaskError> {
    let mut found = Outcome::new();
    if out.is_file() {
        found.extend(file(out, &name(out), kept)?);
    }
    if out.is_dir() {
        for path in entries(out)? {
            let below = values(&path, kept)?;
            let is_folder = path.is_dir();
            let inside = |key: String| {
                if is_folder {
                    format!("{}/{key}", name(&path))
                } else {
                    key
                }
            };
            found.extend(below.into_iter().map(|(key, value)| (inside(key), value)));
        }
    }
    Ok(found)
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, XtaskError> {
    let unreadable = |cause| XtaskError::read(folder, cause);
    let paths = fs::read_dir(folder).map_err(unreadable)?;
    let paths = paths.map(|entry| entry.map(|entry| entry.path()));
    let paths: Vec<PathBuf> = paths.collect::<Result<_, _>>().map_err(unreadable)?;
    let mut shown: Vec<_> = paths
        .into_iter()
        .filter(|path| !name(path).starts_with('.'))
        .collect();
    shown.sort();
    Ok(shown)
}

fn name(path: &Path) -> String {
    path.file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into()
}

fn file(path: &Path, name: &str, kept: Files) -> Result<Outcome, XtaskError> {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    if ending == "npz" {
        return arrays(path, name);
    }
    if kept == Files::Numbers && ending != "csv" {
        return Ok(Outcome::new());
    }
    let bytes = fs::read(path).map_err(|cause| XtaskError::read(path, cause))?;
    let text = String::from_utf8(bytes);
    Ok(match (ending.as_ref(), text) {
        ("csv", Ok(text)) => cells(name, &text),
        ("json", Ok(text)) => {
            let value = serde_json::from_str(&text);
            leaves(name, &value.unwrap_or_else(|_| text.into()))
        }
        (_, Ok(text)) => Outcome::from([(name.into(), hash(steady(&text).as_bytes()).into())]),
        (_, Err(binary)) => Outcome::from([(name.into(), hash(binary.as_bytes()).into())]),
    })
}

/// The cells of a table by row and heading.
fn cells(name: &str, table: &str) -> Outcome {
    let mut lines = table.lines();
    let headings: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let mut found = Outcome::new();
    for (row, line) in lines.enumerate() {
        for (column, cell) in line.split(',').enumerate() {
            let heading = headings
                .get(column)
                .copied()
                .unwrap_or("beyond the headings");
            let value = match cell.parse::<f64>() {
                Ok(number) if number.is_finite() => number.into(),
                _ => cell.into(),
            };
            found.insert(format!("{name}.{row}.{heading}"), value);
        }
    }
    found
}

/// Of each array its shape, least, largest and sum, and a hash of its bits.
fn arrays(path: &Path, name: &str) -> Result<Outcome, XtaskError> {
    let unreadable = |cause: String| XtaskError::read(path, std::io::Error::other(cause));
    let open = File::open(path).map_err(|cause| XtaskError::read(path, cause))?;
    let mut npz = NpzReader::new(open).map_err(|cause| unreadable(cause.to_string()))?;
    let names = npz.names().map_err(|cause| unreadable(cause.to_string()))?;
    let mut found = Outcome::new();
    for array in names {
        let numbers = numbers::<f64>(&mut npz, &array, |number| number)
            .or_else(|| numbers::<bool>(&mut npz, &array, |is| f64::from(u8::from(is))))
            .or_else(|| numbers::<u8>(&mut npz, &array, f64::from))
            .or_else(|| numbers::<u32>(&mut npz, &array, f64::from))
            .or_else(|| numbers::<i32>(&mut npz, &array, f64::from))
            .or_else(|| numbers::<u64>(&mut npz, &array, |number| number as f64))
            .or_else(|| numbers::<i64>(&mut npz, &array, |number| number as f64));
        let values = numbers
            .as_ref()
            .map_or_else(|| BTreeMap::from([("type", "unknown".into())]), digest);
        let array = array.trim_end_matches(".npy");
        found.extend(
            values
                .into_iter()
                .map(|(key, value)| (format!("{name}.{array} {key}"), value)),
        );
    }
    Ok(found)
}

fn numbers<T: ReadableElement + Copy>(
    npz: &mut NpzReader<File>,
    name: &str,
    to: fn(T) -> f64,
) -> Option<ArrayD<f64>> {
    let array = npz.by_name::<OwnedRepr<T>, ndarray::IxDyn>(name).ok()?;
    Some(array.mapv(to))
}

fn digest(array: &ArrayD<f64>) -> BTreeMap<&'static str, Value> {
    let bytes: Vec<u8> = array
        .iter()
        .flat_map(|number| number.to_le_bytes())
        .collect();
    // NaN marks what is not computed; the hash shows where it stands.
    let numbers = || array.iter().copied().filter(|number| !number.is_nan());
    BTreeMap::from([
        ("shape", format!("{:?}", array.shape()).into()),
        ("least", json!(numbers().reduce(f64::min))),
        ("largest", json!(numbers().reduce(f64::max))),
        ("sum", json!(numbers().sum::<f64>())),
        ("bits", hash(&bytes).into()),
    ])
}

/// FNV-1a with 64 bits, as text: it shows that bytes differ, nothing else.
pub fn hash(bytes: &[u8]) -> String {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    format!("{:016x}", bytes.iter().fold(0xcbf2_9ce4_8422_2325, step))
}

#[cfg(test)]
mod tests {
    use ndarray::array;
    use ndarray_npy::NpzWriter;

    use super::*;

    #[test]
    fn the_hash_is_that_of_its_authors() {
        // Test vectors of Fowler, Noll and Vo for FNV-1a, 64 bits.
        assert_eq!(hash(b""), "cbf29ce484222325");
        assert_eq!(hash(b"foobar"), "85944171f73967e8");
    }

    #[test]
    fn cells_are_found_by_row_and_heading() {
        let found = cells("curve.csv", "force [N],status\n0.5,certified\n1e0,\n");
        let wanted = json!({
            "curve.csv.0.force [N]": 0.5, "curve.csv.0.status": "certified",
            "curve.csv.1.force [N]": 1.0, "curve.csv.1.status": "",
        });
        assert_eq!(json!(found), wanted);
    }

    /// The values of an archive that holds these pressures and a mask.
    fn of_archive(pressure: [f64; 2]) -> Outcome {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out");
        fs::create_dir(&path).unwrap();
        let mut npz = NpzWriter::new(File::create(path.join("fields.npz")).unwrap());
        npz.add_array("pressure", &ndarray::arr1(&pressure))
            .unwrap();
        npz.add_array("mask", &array![true, false]).unwrap();
        npz.finish().unwrap();
        fs::write(path.join("page.html"), "in 2 s").unwrap();
        values(&path, Files::Numbers).unwrap()
    }

    #[test]
    fn one_bit_of_a_field_changes_its_hash() {
        let found = of_archive([1.0, 2.0]);
        assert_eq!(found["fields.npz.pressure largest"], 2.0);
        assert_eq!(found["fields.npz.mask sum"], 1.0);
        assert_eq!(found.len(), 10, "{found:?}");
        let moved = of_archive([1.0, 2.0_f64.next_up()]);
        assert_ne!(
            found["fields.npz.pressure bits"],
            moved["fields.npz.pressure bits"]
        );
        let swapped = of_archive([2.0, 1.0]);
        assert_ne!(
            found["fields.npz.pressure bits"],
            swapped["fields.npz.pressure bits"]
        );
    }

    #[test]
    fn a_run_that_wrote_nothing_has_no_values() {
        let folder = tempfile::tempdir().unwrap();
        assert!(
            values(&folder.path().join("none"), Files::All)
                .unwrap()
                .is_empty()
        );
    }
}
