//! `vary.from = "samples.csv"`: cases from elsewhere, with a column for every key and a row for every case.
//!
//! The first line names the keys, each followed by the unit of its numbers in brackets if they have one:
//! `load.force [mN]`. Without a unit the values are written as in a case file, without the quotes: `3 mN`, `64`,
//! `true`, `bare`. A column of numbers takes eight bytes per case.

use std::path::{Path, PathBuf};

use pellicle::input::dimension::Dimension;
use pellicle::input::quantity;
use pellicle::input::span::Span;
use pellicle::input::toml_tree::{TomlNode, TomlValue};
use pellicle_files::cell::{self, is_plain, on_one_line};

use crate::StudyError;

/// The values of one key, one for each row of the file.
#[derive(Debug, Clone, PartialEq)]
pub enum SampleColumn {
    /// Quantities in SI units.
    Quantities(Vec<f64>, Dimension),
    /// Integers.
    Integers(Vec<i64>),
    /// Numbers without a unit.
    Numbers(Vec<f64>),
    /// Words, including `true` and `false`.
    Words(Vec<String>),
}

impl SampleColumn {
    /// Returns the number of values.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Quantities(numbers, _) | Self::Numbers(numbers) => numbers.len(),
            Self::Integers(numbers) => numbers.len(),
            Self::Words(words) => words.len(),
        }
    }

    /// Returns the `i`-th value, as if it stood in a case file at this place; `None` if there is no such value.
    #[must_use]
    pub fn value(&self, i: usize, span: &Span) -> Option<TomlNode> {
        let value = match self {
            Self::Quantities(numbers, dimension) => {
                TomlValue::Text(format!("{:e} {}", numbers.get(i)?, dimension.si_unit()))
            }
            Self::Integers(numbers) => TomlValue::Integer(*numbers.get(i)?),
            Self::Numbers(numbers) => TomlValue::Float(*numbers.get(i)?),
            Self::Words(words) => match words.get(i)?.as_str() {
                "true" => TomlValue::Boolean(true),
                "false" => TomlValue::Boolean(false),
                word => TomlValue::Text(word.to_owned()),
            },
        };
        let span = span.clone();
        Some(TomlNode { value, span })
    }
}

/// Reads the keys of a file and their values, in the order of its columns.
///
/// # Errors
///
/// [`StudyError::Samples`] if the file cannot be read, has no rows or more than `most`, or if a value is not of the
/// kind of its column.
pub fn read(path: &Path, most: usize) -> Result<Vec<(String, SampleColumn)>, StudyError> {
    let samples = Samples::read(path, most)?;
    let headings = samples.headings.iter().enumerate();
    let column = |(i, heading): (usize, &String)| {
        let (key, unit) = split(heading);
        if !is_plain(key) {
            return Err(samples.wrong(0, i, heading, "a key of a case"));
        }
        Ok((key.to_owned(), samples.column(i, unit)?))
    };
    headings.map(column).collect()
}

/// The cells of a file.
struct Samples {
    path: PathBuf,
    headings: Vec<String>,
    rows: Vec<csv::StringRecord>,
}

impl Samples {
    fn read(path: &Path, most: usize) -> Result<Self, StudyError> {
        let unreadable = |cause: &dyn std::fmt::Display| StudyError::Samples {
            path: path.to_owned(),
            place: String::new(),
            found: cause.to_string(),
            wanted: "a table of values, its first line the keys".into(),
        };
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .from_path(path)
            .map_err(|cause| unreadable(&cause))?;
        let headings = reader.headers().map_err(|cause| unreadable(&cause))?;
        let headings = headings.iter().map(str::to_owned).collect();
        let mut rows = Vec::new();
        for row in reader.records() {
            rows.push(row.map_err(|cause| unreadable(&cause))?);
            if rows.len() > most {
                return Err(unreadable(&format!("more than {most} rows")));
            }
        }
        if rows.is_empty() {
            return Err(unreadable(&"no rows"));
        }
        let path = path.to_owned();
        Ok(Self {
            path,
            headings,
            rows,
        })
    }

    /// Returns the values of a column whose heading gives this unit.
    fn column(&self, i: usize, unit: Option<&str>) -> Result<SampleColumn, StudyError> {
        let heading = self.headings.get(i).map_or("", String::as_str);
        if let Some(unit) = unit {
            let dimension = quantity::dimension_of(&format!("1 {unit}"));
            let wanted = "a key, with a known unit in brackets such as `load.force [mN]`";
            let dimension = dimension.ok_or_else(|| self.wrong(0, i, heading, wanted))?;
            let wanted = format!("a number, whose unit is {unit}");
            let number = |cell: &str| in_unit(cell, unit, dimension);
            let numbers = self.all(i, number, &wanted)?;
            return Ok(SampleColumn::Quantities(numbers, dimension));
        }
        let first = self.cell(0, i);
        if let Some(dimension) = quantity::dimension_of(first) {
            let wanted = format!("{}, as in the first row", dimension.noun());
            let number = |cell: &str| quantity::parse(cell, dimension).ok();
            let numbers = self.all(i, number, &wanted)?;
            return Ok(SampleColumn::Quantities(numbers, dimension));
        }
        if let Ok(integers) = self.all(i, |cell| cell.parse().ok(), "") {
            return Ok(SampleColumn::Integers(integers));
        }
        if first.parse::<f64>().is_ok() {
            let numbers = self.all(i, |cell| cell.parse().ok(), "a number, as in the first row")?;
            return Ok(SampleColumn::Numbers(numbers));
        }
        let word = |cell: &str| (!cell.is_empty()).then(|| cell.to_owned());
        self.all(i, word, "a value in every row")?;
        let plain = |cell: &str| is_plain(cell).then(|| cell.to_owned());
        let words = self.all(i, plain, cell::WANTED)?;
        Ok(SampleColumn::Words(words))
    }

    /// Reads every value of a column with `read`; the first that cannot be read is the error.
    fn all<T>(
        &self,
        i: usize,
        read: impl Fn(&str) -> Option<T>,
        wanted: &str,
    ) -> Result<Vec<T>, StudyError> {
        let value = |row| {
            let cell = self.cell(row, i);
            read(cell).ok_or_else(|| self.wrong(row + 1, i, cell, wanted))
        };
        (0..self.rows.len()).map(value).collect()
    }

    fn cell(&self, row: usize, i: usize) -> &str {
        self.rows.get(row).and_then(|row| row.get(i)).unwrap_or("")
    }

    /// The error for a cell; row 0 is the first line.
    fn wrong(&self, row: usize, i: usize, found: &str, wanted: &str) -> StudyError {
        let position = row
            .checked_sub(1)
            .and_then(|row| self.rows.get(row)?.position());
        let line = position.map_or(1, csv::Position::line);
        let key = self.headings.get(i).map_or("", |heading| split(heading).0);
        let [key, found] = [key, found].map(shown);
        StudyError::Samples {
            path: self.path.clone(),
            place: format!(", line {line}, key `{key}`"),
            found: format!("\"{found}\""),
            wanted: wanted.to_owned(),
        }
    }
}

/// The beginning of a cell, on one line.
fn shown(cell: &str) -> String {
    /// Characters enough to find the cell again.
    const SHOWN: usize = 80;
    on_one_line(cell).chars().take(SHOWN).collect()
}

/// Converts a cell to SI units.
fn in_unit(cell: &str, unit: &str, dimension: Dimension) -> Option<f64> {
    // The cell must be a number by itself: "1e" and "1 k" would become numbers with other units.
    cell.parse::<f64>().ok()?;
    quantity::parse(&format!("{cell} {unit}"), dimension).ok()
}

/// Splits a heading into key and unit: brackets at the end are a unit if a space precedes them, otherwise the index of
/// a list.
fn split(heading: &str) -> (&str, Option<&str>) {
    let parts = heading.strip_suffix(']');
    match parts.and_then(|heading| heading.rsplit_once(" [")) {
        Some((key, unit)) => (key.trim(), Some(unit.trim())),
        None => (heading, None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<(String, SampleColumn)>, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("samples.csv");
        std::fs::write(&path, text).unwrap();
        super::read(&path, 3).map_err(|failure| failure.to_string())
    }

    #[test]
    fn units_are_in_the_heading_or_with_the_values() {
        let text = "\u{feff}load.force [mN], foundation.layer[0].thickness,\"grid.elements\",a,b\r\n\
                    1,10 nm,32,1e-3,bare\n2.5,0.02 um,64,2,film\n";
        let columns = read(text).unwrap();
        let (keys, values): (Vec<_>, Vec<_>) = columns.into_iter().unzip();
        let wanted = [
            "load.force",
            "foundation.layer[0].thickness",
            "grid.elements",
            "a",
            "b",
        ];
        assert_eq!(keys, wanted);
        let words = ["bare", "film"].map(str::to_owned).to_vec();
        // The units are powers of ten, so the numbers are correctly rounded.
        let wanted = [
            SampleColumn::Quantities(vec![1e-3, 2.5e-3], Dimension::Force),
            SampleColumn::Quantities(vec![10e-9, 20e-9], Dimension::Length),
            SampleColumn::Integers(vec![32, 64]),
            SampleColumn::Numbers(vec![1e-3, 2.0]),
            SampleColumn::Words(words),
        ];
        assert_eq!(values, wanted);
    }

    #[test]
    fn a_value_of_the_wrong_kind_is_reported_with_its_line_and_key() {
        for (text, wanted) in [
            (
                "a [mN]\n1\n2 N\n",
                "line 3, key `a`: found \"2 N\", wanted a number",
            ),
            (
                "a\n1 N\n2 nm\n",
                "line 3, key `a`: found \"2 nm\", wanted a force",
            ),
            (
                "a\n1.5\nx\n",
                "line 3, key `a`: found \"x\", wanted a number",
            ),
            (
                "a,b\n1,\n",
                "line 2, key `b`: found \"\", wanted a value in every row",
            ),
            (
                "a [furlong]\n1\n",
                "line 1, key `a`: found \"a [furlong]\", wanted a key",
            ),
            (
                "a\nbare\n@SUM(1)\n",
                "line 3, key `a`: found \"@SUM(1)\", wanted text without control characters",
            ),
            (
                "=a\n1\n",
                "line 1, key `=a`: found \"=a\", wanted a key of a case",
            ),
            (
                "a\n1\n\"x\ny\"\n",
                "line 3, key `a`: found \"x\\ny\", wanted a number, as in the first row",
            ),
            ("a\n", "found no rows"),
            ("a\n1\n2\n3\n4\n", "found more than 3 rows"),
            ("a,b\n1\n", "found CSV error"),
        ] {
            let message = read(text).unwrap_err();
            assert!(message.contains(wanted), "{wanted} in {message}");
        }
    }
}
