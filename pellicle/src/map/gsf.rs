//! `.gsf`: Gwyddion Simple Field, a text header and four-byte numbers.
//!
//! A line `Gwyddion Simple Field 1.0`, lines `key = value`, one to four NUL bytes up to a multiple of four, then `XRes
//! · YRes` little-endian floats, row by row from the top. Source: Gwyddion user guide, *Simple Field Files*,
//! gwyddion.net/documentation/user-guide-en/gsf.html.

use super::error::MapError;
use super::map_file::MapFile;

const MAGIC: &[u8] = b"Gwyddion Simple Field 1.0\n";

/// Bytes of a number.
const NUMBER: usize = 4;

/// Reads the field, its size and its units.
///
/// # Errors
///
/// A [`MapError`] if the header is incomplete or invalid, or there are fewer or more data than it says.
pub fn parse(bytes: &[u8]) -> Result<MapFile, MapError> {
    let after = bytes.strip_prefix(MAGIC).ok_or(MapError::NotGsf)?;
    let end = after
        .iter()
        .position(|byte| *byte == 0)
        .ok_or(MapError::NotGsf)?;
    let text = std::str::from_utf8(&after[..end]).map_err(|error| {
        let before = after.iter().take(error.valid_up_to());
        MapError::NotText {
            encoding: "utf-8".into(),
            line: 2 + before.filter(|byte| **byte == b'\n').count(),
        }
    })?;
    let header = GsfHeader(text);
    let [columns, rows] = [header.resolution("XRes")?, header.resolution("YRes")?];
    // The first multiple of four after at least one NUL.
    let start = ((MAGIC.len() + end) / NUMBER + 1) * NUMBER;
    let picture = numbers(bytes.get(start..).unwrap_or_default(), columns, rows)?;
    Ok(MapFile {
        sides: match (header.size("XReal")?, header.size("YReal")?) {
            (Some(x), Some(y)) => Some([x, y]),
            _ => None,
        },
        lateral_unit: header.unit("XYUnits"),
        height_unit: header.unit("ZUnits"),
        ..MapFile::from_picture(columns, &picture)
    })
}

fn numbers(data: &[u8], columns: usize, rows: usize) -> Result<Vec<f64>, MapError> {
    let wanted = columns.saturating_mul(rows).saturating_mul(NUMBER);
    if data.len() != wanted {
        return Err(MapError::DataSize {
            found: data.len(),
            wanted,
        });
    }
    let (numbers, _) = data.as_chunks::<NUMBER>();
    let number = |bytes: &[u8; NUMBER]| f64::from(f32::from_le_bytes(*bytes));
    Ok(numbers.iter().map(number).collect())
}

/// The lines `key = value`.
struct GsfHeader<'a>(&'a str);

impl<'a> GsfHeader<'a> {
    fn value(&self, key: &str) -> Option<&'a str> {
        let pairs = self.0.lines().filter_map(|line| line.split_once('='));
        let mut pairs = pairs.map(|(name, value)| (name.trim(), value.trim()));
        pairs.find(|(name, _)| *name == key).map(|(_, value)| value)
    }

    fn resolution(&self, key: &'static str) -> Result<usize, MapError> {
        let found = self.value(key).unwrap_or("nothing");
        match found.parse() {
            Ok(count) if count > 0 => Ok(count),
            _ => Err(MapError::header(key, found, "a positive number of pixels")),
        }
    }

    fn size(&self, key: &'static str) -> Result<Option<f64>, MapError> {
        let size = |found: &str| match found.parse::<f64>() {
            Ok(size) if size > 0.0 && size.is_finite() => Ok(size),
            _ => Err(MapError::header(key, found, "a positive length")),
        };
        self.value(key).map(size).transpose()
    }

    fn unit(&self, key: &str) -> Option<String> {
        let unit = self.value(key).filter(|unit| !unit.is_empty());
        unit.map(str::to_owned)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(header: &str, numbers: &[f32]) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend(header.as_bytes());
        bytes.push(0);
        while !bytes.len().is_multiple_of(4) {
            bytes.push(0);
        }
        bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
        bytes
    }

    #[test]
    fn size_units_and_data_are_read_after_any_padding() {
        for title in ["", "a", "ab", "abc"] {
            let header = format!(
                "XRes = 3\nYRes=2\n XReal = 3e-06 \nYReal = 2e-6\nXYUnits = m\nZUnits = nm\nTitle = {title}\n"
            );
            let map = parse(&file(&header, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.5])).unwrap();
            assert_eq!((map.shape, map.sides), ([3, 2], Some([3e-6, 2e-6])));
            assert_eq!(map.heights, [4.0, 1.0, 5.0, 2.0, 6.5, 3.0]);
            assert_eq!(map.lateral_unit.as_deref(), Some("m"));
            assert_eq!(map.height_unit.as_deref(), Some("nm"));
        }
    }

    #[test]
    fn a_field_without_size_and_units_is_read() {
        let map = parse(&file("XRes = 1\nYRes = 1\nZUnits = \n", &[1.0])).unwrap();
        assert_eq!(map, MapFile::bare([1, 1], vec![1.0]));
    }

    #[test]
    fn invalid_gsf_files_are_rejected() {
        let good = file("XRes = 2\nYRes = 2\n", &[0.0; 4]);
        assert!(parse(&good).is_ok());
        let faulty = [
            good[1..].to_vec(),
            good[..good.len() - 1].to_vec(),
            good[..40].to_vec(),
            file("XRes = 2\n", &[0.0; 4]),
            file("XRes = 2\nYRes = -2\n", &[0.0; 4]),
            file("XRes = 18446744073709551615\nYRes = 9\n", &[0.0; 4]),
            file("XRes = 2\nYRes = 2\nXReal = 0\nYReal = 1\n", &[0.0; 4]),
        ];
        for (i, file) in faulty.iter().enumerate() {
            assert!(parse(file).is_err(), "{i}");
        }
    }
}
