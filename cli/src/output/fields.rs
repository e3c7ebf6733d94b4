//! `fields-NNN.npz`: the fields of one loading step, for `numpy.load`.

use std::fs::File;
use std::io;
use std::path::Path;

use ndarray::{Array1, Array2, ArrayView2, ShapeError};
use ndarray_npy::{NpzReader, NpzWriter, ReadNpyError, ReadNpzError, WriteNpyError, WriteNpzError};
use pellicle_contact::{LoadingPath, Solution};

use super::file::write_whole;
use crate::failure::Failure;

/// Name of the file of a step in a results folder.
#[must_use]
pub fn file(step: usize) -> String {
    format!("fields-{step:03}.npz")
}

/// Writes `x`, `y` (N values each), and `pressure`, `displacement`, `gap`, `shortening`, `profile`, `mask` (N × N, the
/// first index along x).
///
/// # Errors
///
/// [`Failure::Write`] if the file cannot be written.
pub fn write(file: &Path, path: &LoadingPath, solution: &Solution) -> Result<(), Failure> {
    write_whole(file, |file| {
        npz(file, path, solution).map_err(io::Error::other)
    })
}

fn npz(
    file: &mut io::BufWriter<File>,
    path: &LoadingPath,
    solution: &Solution,
) -> Result<(), WriteNpzError> {
    let grid = &path.grid;
    let size = grid.size();
    let centres: Array1<f64> = (0..size).map(|i| grid.centre(i)).collect();
    let mut npz = NpzWriter::new_compressed(file);
    npz.add_array("x", &centres)?;
    npz.add_array("y", &centres)?;
    let fields = [
        ("pressure", &solution.pressure[..]),
        ("displacement", &solution.displacement),
        ("gap", &solution.gap),
        ("shortening", &solution.shortening),
        ("profile", path.relief.profile()),
    ];
    for (name, field) in fields {
        npz.add_array(name, &square(size, field)?)?;
    }
    npz.add_array("mask", &square(size, path.relief.mask())?)?;
    npz.finish()?;
    Ok(())
}

fn square<T>(size: usize, field: &[T]) -> Result<ArrayView2<'_, T>, WriteNpzError> {
    ArrayView2::from_shape((size, size), field)
        .map_err(|error: ShapeError| WriteNpyError::Io(io::Error::other(error)).into())
}

/// What a picture needs of the fields of a step.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredFields {
    /// Elements per side.
    pub size: usize,
    /// Pressure, Pa; N² values.
    pub pressure: Vec<f64>,
    /// Whether an element belongs to the relief; N² values.
    pub mask: Vec<bool>,
}

/// Reads the fields of a step back.
///
/// # Errors
///
/// [`Failure::Damaged`] if the file is not one that [`write()`] wrote.
pub fn read(path: &Path) -> Result<StoredFields, Failure> {
    let read = || -> Result<StoredFields, ReadNpzError> {
        let mut npz = NpzReader::new(File::open(path).map_err(ReadNpyError::Io)?)?;
        let pressure: Array2<f64> = npz.by_name("pressure")?;
        let mask: Array2<bool> = npz.by_name("mask")?;
        Ok(StoredFields {
            size: pressure.nrows(),
            pressure: pressure.into_iter().collect(),
            mask: mask.into_iter().collect(),
        })
    };
    let fields = read().map_err(|cause| Failure::damaged(path, &cause))?;
    let StoredFields {
        size,
        pressure,
        mask,
    } = &fields;
    if pressure.len() != size * size || mask.len() != pressure.len() {
        return Err(Failure::damaged(path, &"the fields are not square"));
    }
    Ok(fields)
}
