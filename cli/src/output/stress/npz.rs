//! `stress-NNN.npz`: the section and the tractions on interfaces that the pictures show, for `numpy.load`.

use std::fs::File;
use std::io;
use std::path::Path;

use ndarray::{Array1, Array2, Array3, ArrayView, Dimension, ShapeError};
use ndarray_npy::{NpzReader, ReadNpyError, ReadNpzError, WriteNpyError, WriteNpzError};
use pellicle_plot::stress::view::{InterfaceTractions, StressSection, StressView, SurfaceLine};

use super::super::large_file::write_stoppable;
use super::super::npz::check;
use super::super::npz_archive::NpzArchive;
use crate::failure::Failure;

/// Name of the file of a step in a results folder.
#[must_use]
pub fn file(step: usize) -> String {
    format!("stress-{step:03}.npz")
}

/// Writes `line` (x and y of a point of the section's line, and its direction), `s` (coordinates along it), `z` and
/// `body` (of the planes), `von_mises` and `max_principal` (planes × points); `x` (coordinates of the interfaces'
/// points along x, and along y), `interface` and `interface_z` (their numbers and depths), `shear_traction` and
/// `normal_traction` (interfaces × x × y).
///
/// # Errors
///
/// [`Failure::File`] if the file cannot be written.
pub fn write(path: &Path, view: &StressView) -> Result<(), Failure> {
    write_stoppable(path, |file| npz(file, view).map_err(io::Error::other))
}

fn npz(file: impl io::Write + io::Seek, view: &StressView) -> Result<(), WriteNpzError> {
    let (section, interfaces) = (&view.section, &view.interfaces);
    let [x, y] = section.line.through;
    let list = |values: &[f64]| Array1::from(values.to_vec());
    let joined = |values: fn(&InterfaceTractions) -> &[f64]| -> Vec<f64> {
        interfaces.iter().flat_map(values).copied().collect()
    };
    let body = section.bodies.iter().map(|body| *body as f64);
    let planes = (section.depths.len(), section.along.len());
    let maps = (interfaces.len(), view.centres.len(), view.centres.len());
    let mut npz = NpzArchive::new(file);
    npz.add("line", &list(&[x, y, section.line.direction]))?;
    npz.add("s", &list(&section.along))?;
    npz.add("z", &list(&section.depths))?;
    npz.add("body", &Array1::from_iter(body))?;
    npz.add("von_mises", &shaped(planes, &section.von_mises)?)?;
    npz.add("max_principal", &shaped(planes, &section.max_principal)?)?;
    npz.add("x", &list(&view.centres))?;
    let index = interfaces.iter().map(|interface| interface.index as f64);
    npz.add("interface", &Array1::from_iter(index))?;
    let depth = interfaces.iter().map(|interface| interface.depth);
    npz.add("interface_z", &Array1::from_iter(depth))?;
    let shear = joined(|interface| &interface.shear);
    npz.add("shear_traction", &shaped(maps, &shear)?)?;
    let normal = joined(|interface| &interface.normal);
    npz.add("normal_traction", &shaped(maps, &normal)?)?;
    npz.finish()
}

fn shaped<D: Dimension>(
    shape: impl ndarray::IntoDimension<Dim = D>,
    values: &[f64],
) -> Result<ArrayView<'_, f64, D>, WriteNpzError> {
    ArrayView::from_shape(shape.into_dimension(), values)
        .map_err(|error: ShapeError| WriteNpyError::Io(io::Error::other(error)).into())
}

/// Reads the view of a step back.
///
/// # Errors
///
/// [`Failure::File`] if the file is not one that a run wrote.
pub fn read(path: &Path) -> Result<StressView, Failure> {
    check(path).map_err(|reason| Failure::damaged(path, &reason))?;
    let view = try_read(path).map_err(|cause| Failure::damaged(path, &cause))?;
    view.ok_or_else(|| Failure::damaged(path, &"its arrays have inconsistent shapes"))
}

/// Reads the view; none if its arrays do not match.
fn try_read(path: &Path) -> Result<Option<StressView>, ReadNpzError> {
    let mut npz = NpzReader::new(File::open(path).map_err(ReadNpyError::Io)?)?;
    let von_mises: Array2<f64> = npz.by_name("von_mises")?;
    let max_principal: Array2<f64> = npz.by_name("max_principal")?;
    let shear: Array3<f64> = npz.by_name("shear_traction")?;
    let normal: Array3<f64> = npz.by_name("normal_traction")?;
    let mut list = |name: &str| -> Result<Vec<f64>, ReadNpzError> {
        let list: Array1<f64> = npz.by_name(name)?;
        Ok(list.into_iter().collect())
    };
    let line = list("line")?;
    let [along, depths, body] = [list("s")?, list("z")?, list("body")?];
    let [centres, index, depth] = [list("x")?, list("interface")?, list("interface_z")?];
    let planes = [depths.len(), along.len()];
    let maps = [index.len(), centres.len(), centres.len()];
    let fits = von_mises.shape() == planes
        && max_principal.shape() == planes
        && shear.shape() == maps
        && normal.shape() == maps
        && body.len() == depths.len()
        && body.is_sorted()
        && depth.len() == index.len()
        && along.len() > 1
        && centres.len() > 1;
    let (Ok([x, y, direction]), true) = (<[f64; 3]>::try_from(line), fits) else {
        return Ok(None);
    };
    let interfaces = index.into_iter().zip(depth);
    let maps = shear.outer_iter().zip(normal.outer_iter());
    let interfaces = interfaces
        .zip(maps)
        .map(|((index, depth), (shear, normal))| {
            let [shear, normal] = [shear, normal].map(|map| map.iter().copied().collect());
            InterfaceTractions {
                index: number(index),
                depth,
                shear,
                normal,
            }
        });
    Ok(Some(StressView {
        interfaces: interfaces.collect(),
        section: StressSection {
            line: SurfaceLine {
                through: [x, y],
                direction,
            },
            along,
            depths,
            bodies: body.into_iter().map(number).collect(),
            von_mises: von_mises.into_iter().collect(),
            max_principal: max_principal.into_iter().collect(),
        },
        centres,
    }))
}

/// Converts the number of a body or an interface; 0 if it is invalid.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a small number of bodies; others are clamped"
)]
fn number(value: f64) -> usize {
    value as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view() -> StressView {
        StressView {
            section: StressSection {
                line: SurfaceLine {
                    through: [1e-6, -2e-6],
                    direction: 0.25,
                },
                along: vec![-1.0, 0.0, 1.0],
                depths: vec![0.0, 0.1, 0.1],
                bodies: vec![0, 0, 1],
                von_mises: (0..9).map(f64::from).collect(),
                max_principal: (0..9).map(|i| f64::from(i) - 4.0).collect(),
            },
            centres: vec![-0.5, 0.5],
            interfaces: vec![InterfaceTractions {
                index: 0,
                depth: 0.1,
                shear: vec![1.0, 2.0, 3.0, 4.0],
                normal: vec![-1.0, 0.0, 1.0, f64::NAN],
            }],
        }
    }

    #[test]
    fn a_view_is_read_back_as_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(file(0));
        write(&path, &view()).unwrap();
        // NaN is not equal to itself.
        assert_eq!(
            format!("{:?}", read(&path).unwrap()),
            format!("{:?}", view())
        );
        let bare = StressView {
            interfaces: Vec::new(),
            ..view()
        };
        write(&path, &bare).unwrap();
        assert_eq!(read(&path).unwrap(), bare);
    }

    #[test]
    fn arrays_of_inconsistent_shapes_are_rejected() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(file(0));
        let mut odd = view();
        odd.section.bodies.swap(0, 2);
        write(&path, &odd).unwrap();
        let message = read(&path).unwrap_err().to_string();
        assert!(message.contains("inconsistent shapes"), "{message}");
        std::fs::write(&path, "no archive").unwrap();
        assert!(read(&path).is_err());
    }
}
