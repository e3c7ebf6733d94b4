//! Height maps from files: NumPy's `.npy`, text in columns, Gwyddion's `.gsf`.
//!
//! All three are read into a [`MapFile`], whose heights have the layout of a [`Grid`](pellicle_texture::Grid): first
//! index along x, second along y, both increasing. NumPy arrays have that layout already, as do the arrays in a results
//! folder. Text and `.gsf` are pictures: a line is a row of pixels from left to right, x increasing, and the first line
//! is the top, where y is largest. Lines of three numbers that are the points x, y, z of a grid are read as points.
//! Heights that are missing are NaN.

mod axes;
mod blocks;
mod comma;
mod counts;
mod error;
mod grid_lines;
mod grid_points;
mod gsf;
mod header;
mod map_file;
mod npy;
pub mod npy_header;
mod point_units;
mod text;

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

pub use self::error::MapError;
pub use self::grid_points::{NoGrid, PointsError};
pub use self::map_file::MapFile;

/// The largest file that is read, bytes.
const MAX_FILE_BYTES: u64 = 512 << 20;

/// Reads the bytes of a file of one format.
type Parser = fn(&[u8]) -> Result<MapFile, MapError>;

impl MapFile {
    /// Reads the file in the format given by its extension.
    ///
    /// # Errors
    ///
    /// A [`MapError`] if the file cannot be read or its content does not match its extension.
    pub fn read(path: &Path) -> Result<Self, MapError> {
        let ending = path.extension().unwrap_or_default().to_string_lossy();
        let parse: Parser = match ending.to_lowercase().as_str() {
            "npy" => npy::parse,
            "csv" | "txt" | "dat" | "asc" => text::parse,
            "gsf" => gsf::parse,
            _ => {
                return Err(MapError::Ending {
                    found: ending.into_owned(),
                });
            }
        };
        parse(&bytes(path)?)
    }
}

fn bytes(path: &Path) -> Result<Vec<u8>, MapError> {
    // Reading from a pipe might never end.
    if !fs::metadata(path)?.is_file() {
        let message = "it is not a regular file";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message).into());
    }
    let mut bytes = Vec::new();
    let read = File::open(path)?
        .take(MAX_FILE_BYTES + 1)
        .read_to_end(&mut bytes)?;
    if read as u64 > MAX_FILE_BYTES {
        return Err(MapError::TooLarge {
            largest: MAX_FILE_BYTES,
        });
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Small valid files of the three formats.
    fn right() -> [(Parser, Vec<u8>); 3] {
        use ndarray_npy::WriteNpyExt;
        let mut npy = Vec::new();
        let array = ndarray::array![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]];
        array.write_npy(&mut npy).unwrap();
        let mut gsf =
            b"Gwyddion Simple Field 1.0\nXRes = 2\nYRes = 3\nXReal = 1e-6\nYReal = 2e-6\n".to_vec();
        gsf.resize((gsf.len() / 4 + 1) * 4, 0);
        gsf.extend([0; 24]);
        [
            (npy::parse as Parser, npy),
            (gsf::parse, gsf),
            (text::parse, b"# Height\n1,2\n3,4\n5,6\n".to_vec()),
        ]
    }

    proptest::proptest! {
        #[test]
        fn a_damaged_map_is_read_or_rejected_without_panic(
            changes in proptest::collection::vec((0.0..1.0, proptest::num::u8::ANY), 1..8),
            length in 0.0..1.5_f64,
        ) {
            for (parse, mut bytes) in right() {
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "a place in a small file"
                )]
                let at = |x: f64, length: usize| (x * length as f64) as usize;
                for (place, byte) in &changes {
                    let place = at(*place, bytes.len());
                    bytes[place] = *byte;
                }
                let kept = at(length, bytes.len()).min(bytes.len());
                if let Ok(map) = parse(&bytes[..kept]) {
                    proptest::prop_assert_eq!(map.heights.len(), map.shape[0] * map.shape[1]);
                }
            }
        }
    }

    #[test]
    fn very_deep_nesting_does_not_overflow_the_stack() {
        let shape = "'shape': (1, 1), ";
        for open in ["(", "[", "{"] {
            let header = format!("{{{shape}'descr': {}", open.repeat(60_000));
            let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
            bytes.extend(u16::try_from(header.len()).unwrap().to_le_bytes());
            bytes.extend(header.bytes());
            bytes.extend([0; 8]);
            assert!(npy::parse(&bytes).is_err(), "{open}");
        }
    }

    #[test]
    fn an_unknown_file_extension_is_rejected_before_the_file_is_opened() {
        let found = MapFile::read(Path::new("nowhere/tip.xyz"));
        assert!(matches!(found, Err(MapError::Ending { found }) if found == "xyz"));
    }
}
