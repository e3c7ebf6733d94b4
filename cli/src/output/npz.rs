//! `fields-NNN.npz`: the fields of one loading step, for `numpy.load`.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use ndarray::{Array1, Array2, ArrayView2, Ix2, OwnedRepr, ShapeError};
use ndarray_npy::{NpzReader, ReadNpyError, ReadNpzError, WriteNpyError, WriteNpzError};
use pellicle::map::npy_header::NpyHeader;
use pellicle::result::fields::{Fields, NUMBERS, NumberField, TRUTHS};
use zip::ZipArchive;

use super::large_file::write_stoppable;
use super::npz_archive::NpzArchive;
use crate::failure::Failure;

/// Largest size of an array, bytes: 16,384² numbers, the largest grid of a case, and a header.
const MAX_ARRAY_BYTES: u64 = (8 << 28) + (1 << 16);

/// Name of the file of a step in a results folder.
#[must_use]
pub fn file(step: usize) -> String {
    format!("fields-{step:03}.npz")
}

/// Writes `x`, `y` (`N_x` and `N_y` values), and `pressure`, `displacement`, `gap`, `shortening`, `profile`, `mask`,
/// `contact` (`N_x × N_y`, the first index along x), and `plastic_depth` if there is a hardness.
///
/// # Errors
///
/// [`Failure::File`] if the file cannot be written.
pub fn write(file: &Path, fields: &Fields<'_>) -> Result<(), Failure> {
    write_stoppable(file, |file| npz(file, fields).map_err(io::Error::other))
}

fn npz(file: impl io::Write + io::Seek, fields: &Fields<'_>) -> Result<(), WriteNpzError> {
    let lengths = fields.lengths();
    let mut npz = NpzArchive::new(file);
    for (axis, name) in ["x", "y"].into_iter().enumerate() {
        let centre = |i| fields.centre_along(axis, i);
        let centres: Array1<f64> = (0..lengths[axis]).map(centre).collect();
        npz.add(name, &centres)?;
    }
    for (field, values) in fields.numbers() {
        npz.add(field.name, &rectangle(lengths, values)?)?;
    }
    for truth in TRUTHS {
        npz.add(truth.name, &rectangle(lengths, &truth.of(fields))?)?;
    }
    npz.finish()
}

fn rectangle<T>(lengths: [usize; 2], field: &[T]) -> Result<ArrayView2<'_, T>, WriteNpzError> {
    ArrayView2::from_shape(lengths, field)
        .map_err(|error: ShapeError| WriteNpyError::Io(io::Error::other(error)).into())
}

/// Rejects arrays larger than any grid's, or than their header states, before memory is allocated for them.
///
/// # Errors
///
/// The reason why the file is rejected.
pub(super) fn check(path: &Path) -> Result<(), String> {
    let file = File::open(path).map_err(|cause| cause.to_string())?;
    let mut archive = ZipArchive::new(file).map_err(|cause| cause.to_string())?;
    for i in 0..archive.len() {
        let entry = archive.by_index(i).map_err(|cause| cause.to_string())?;
        let (name, size) = (entry.name().to_owned(), entry.size());
        if size > MAX_ARRAY_BYTES {
            return Err(format!(
                "{name} unpacks to {size} bytes, more than a field of any grid"
            ));
        }
        let mut start = Vec::new();
        let read = entry.take(1 << 16).read_to_end(&mut start);
        read.map_err(|cause| cause.to_string())?;
        let header = NpyHeader::read(&start).map_err(|error| format!("{name}, {error}"))?;
        if header.size() != Some(size) {
            return Err(format!(
                "{name} unpacks to {size} bytes, but its header says otherwise"
            ));
        }
    }
    Ok(())
}

/// The fields of a step, read back from a file.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredFields {
    /// Elements along x and y.
    lengths: [usize; 2],
    /// In the order of [`NUMBERS`]; empty if the step does not have it.
    numbers: [Vec<f64>; NUMBERS.len()],
    mask: Vec<bool>,
}

impl StoredFields {
    /// Reads the fields of a step back.
    ///
    /// # Errors
    ///
    /// [`Failure::File`] if the file is not one that a run wrote.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        check(path).map_err(|reason| Failure::damaged(path, &reason))?;
        let fields = Self::try_read(path).map_err(|cause| Failure::damaged(path, &cause))?;
        let count = fields.lengths[0] * fields.lengths[1];
        let is_whole = |(field, values): (&NumberField, &Vec<f64>)| {
            values.len() == count || (field.of_hardness && values.is_empty())
        };
        if count > 0
            && fields.mask.len() == count
            && NUMBERS.iter().zip(&fields.numbers).all(is_whole)
        {
            return Ok(fields);
        }
        Err(Failure::damaged(path, &"the fields have different sizes"))
    }

    fn try_read(path: &Path) -> Result<Self, ReadNpzError> {
        let mut npz = NpzReader::new(File::open(path).map_err(ReadNpyError::Io)?)?;
        let mask: Array2<bool> = npz.by_name("mask")?;
        let mut numbers: [Vec<f64>; NUMBERS.len()] = std::array::from_fn(|_| Vec::new());
        for (field, values) in NUMBERS.iter().zip(&mut numbers) {
            match npz.by_name::<OwnedRepr<f64>, Ix2>(field.name) {
                Ok(read) => *values = read.into_iter().collect(),
                Err(_) if field.of_hardness => {}
                Err(error) => return Err(error),
            }
        }
        Ok(Self {
            lengths: [mask.nrows(), mask.ncols()],
            numbers,
            mask: mask.into_iter().collect(),
        })
    }

    /// The fields, on a domain whose longer side is this.
    #[must_use]
    pub fn fields(&self, side: f64) -> Fields<'_> {
        let [
            pressure,
            displacement,
            gap,
            shortening,
            profile,
            plastic_depth,
        ] = &self.numbers;
        let [rows, columns] = self.lengths;
        Fields {
            side: side * (columns as f64 / rows.max(columns) as f64),
            size: columns,
            pressure,
            displacement,
            gap,
            shortening,
            plastic_depth,
            profile,
            mask: &self.mask,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use zip::write::SimpleFileOptions;
    use zip::{CompressionMethod, ZipWriter};

    use super::*;

    /// Returns the failure to read an archive of one array, with four bytes of its directory entry replaced.
    fn refused(header: &str, data: &[u8], patch: Option<(usize, u32)>) -> String {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("fields-000.npz");
        let mut archive = ZipWriter::new(io::Cursor::new(Vec::new()));
        let stored = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
        archive.start_file("mask.npy", stored).unwrap();
        let length = u16::try_from(header.len()).unwrap().to_le_bytes();
        let parts = [b"\x93NUMPY\x01\x00", &length[..], header.as_bytes(), data].concat();
        archive.write_all(&parts).unwrap();
        let mut bytes = archive.finish().unwrap().into_inner();
        if let Some((at, number)) = patch {
            let directory = bytes
                .windows(4)
                .rposition(|four| four == b"PK\x01\x02")
                .unwrap();
            bytes[directory + at..directory + at + 4].copy_from_slice(&number.to_le_bytes());
        }
        std::fs::write(&path, bytes).unwrap();
        StoredFields::read(&path).unwrap_err().to_string()
    }

    #[test]
    fn arrays_whose_headers_claim_too_much_memory_are_rejected_before_unpacking() {
        let header = "{'descr': '|b1', 'fortran_order': False, 'shape': (1, 1)}";
        // The uncompressed size in the directory entry.
        let large = refused(header, &[1], Some((24, 4_000_000_000)));
        assert!(
            large.contains("mask.npy unpacks to 4000000000 bytes"),
            "{large}"
        );
        let larger = header.replace("(1, 1)", "(8000, 8000)");
        let message = refused(&larger, &[1], None);
        assert!(message.contains("its header says otherwise"), "{message}");
        let twice = header.replace("(1, 1)", "(1, 1), 'shape': (99999999, 99999999)");
        let twice = refused(&twice, &[1], None);
        assert!(twice.contains("the key shape twice"), "{twice}");
    }
}
