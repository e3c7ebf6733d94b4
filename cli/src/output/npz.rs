//! `fields-NNN.npz`: the fields of one loading step, for `numpy.load`.

use std::fs::File;
use std::io;
use std::path::Path;

use ndarray::{Array1, Array2, ArrayView2, ShapeError};
use ndarray_npy::{NpzReader, NpzWriter, ReadNpyError, ReadNpzError, WriteNpyError, WriteNpzError};
use zip::CompressionMethod;
use zip::write::SimpleFileOptions;

use super::fields::Fields;
use super::file::write_whole;
use super::watched::Watched;
use crate::failure::Failure;

/// How hard to pack, from 1 to 9. The usual 6 makes the files 13 % smaller in three times the time, and packing took 13 % of a curve's run.
const EFFORT: i64 = 1;

/// Name of the file of a step in a results folder.
#[must_use]
pub fn file(step: usize) -> String {
    format!("fields-{step:03}.npz")
}

/// Writes `x`, `y` (N values each), and `pressure`, `displacement`, `gap`, `shortening`, `profile`, `mask`,
/// `contact` (N × N, the first index along x).
///
/// # Errors
///
/// [`Failure::Write`] if the file cannot be written.
pub fn write(file: &Path, fields: &Fields<'_>) -> Result<(), Failure> {
    write_whole(file, |file| {
        npz(Watched::new(file), fields).map_err(io::Error::other)
    })
}

fn npz(file: impl io::Write + io::Seek, fields: &Fields<'_>) -> Result<(), WriteNpzError> {
    let size = fields.size;
    let centres: Array1<f64> = (0..size).map(|i| fields.centre(i)).collect();
    let packed = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
    let packed = packed.compression_level(Some(EFFORT));
    let mut npz = NpzWriter::new_with_options(file, packed);
    npz.add_array("x", &centres)?;
    npz.add_array("y", &centres)?;
    for field in fields.named() {
        npz.add_array(field.name, &square(size, field.values)?)?;
    }
    for truth in fields.truths() {
        npz.add_array(truth.name, &square(size, &truth.values)?)?;
    }
    npz.finish()?;
    Ok(())
}

fn square<T>(size: usize, field: &[T]) -> Result<ArrayView2<'_, T>, WriteNpzError> {
    ArrayView2::from_shape((size, size), field)
        .map_err(|error: ShapeError| WriteNpyError::Io(io::Error::other(error)).into())
}

/// The fields of a step as read back.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredFields {
    size: usize,
    /// Pressure, displacement, gap, shortening, profile.
    numbers: [Vec<f64>; 5],
    mask: Vec<bool>,
}

impl StoredFields {
    /// Reads the fields of a step back.
    ///
    /// # Errors
    ///
    /// [`Failure::Damaged`] if the file is not one that [`write()`] wrote.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let fields = Self::try_read(path).map_err(|cause| Failure::damaged(path, &cause))?;
        let count = fields.size * fields.size;
        let is_square = |length: usize| length == count;
        if count > 0
            && is_square(fields.mask.len())
            && fields.numbers.iter().all(|field| is_square(field.len()))
        {
            return Ok(fields);
        }
        Err(Failure::damaged(path, &"the fields are not square"))
    }

    fn try_read(path: &Path) -> Result<Self, ReadNpzError> {
        let mut npz = NpzReader::new(File::open(path).map_err(ReadNpyError::Io)?)?;
        let mask: Array2<bool> = npz.by_name("mask")?;
        let mut numbers = |name: &str| -> Result<Vec<f64>, ReadNpzError> {
            let field: Array2<f64> = npz.by_name(name)?;
            Ok(field.into_iter().collect())
        };
        Ok(Self {
            size: mask.nrows(),
            numbers: [
                numbers("pressure")?,
                numbers("displacement")?,
                numbers("gap")?,
                numbers("shortening")?,
                numbers("profile")?,
            ],
            mask: mask.into_iter().collect(),
        })
    }

    /// The fields, on a domain of this side.
    #[must_use]
    pub fn fields(&self, side: f64) -> Fields<'_> {
        let [pressure, displacement, gap, shortening, profile] = &self.numbers;
        Fields {
            side,
            size: self.size,
            pressure,
            displacement,
            gap,
            shortening,
            profile,
            mask: &self.mask,
        }
    }
}
