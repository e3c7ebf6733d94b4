//! `stress-NNN.nc` and `stress-NNN.vtr`: displacements and stresses on planes in the body, computed and written plane
//! by plane, so that no more than one plane is in memory.

mod netcdf;
mod vtr;

use std::path::Path;

use pellicle_contact::{LoadingPath, StressField, StressPlanes};
use pellicle_influence::SubsurfaceState;
use rayon::prelude::*;

use super::summary::Summary;
use super::write_progress::WriteProgress;
use crate::case::Case;
use crate::case::foundation::depths::BodyPlane;
use crate::case::output::Format;
use crate::case::stress::StressCase;
use crate::failure::Failure;

/// A field in the files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FieldName {
    /// Its name.
    pub name: &'static str,
    /// Its unit in SI.
    pub unit: &'static str,
    /// Its meaning, in words.
    pub meaning: &'static str,
}

/// Fields of a state of the body.
const STATE: usize = 9;

/// The fields: those of [`SubsurfaceState`] in its order, and two that follow from them.
pub const FIELDS: [FieldName; 11] = [
    named("ux", "m", "displacement along x"),
    named("uy", "m", "displacement along y"),
    named("uz", "m", "displacement along z, into the body"),
    named("sxx", "Pa", "normal stress along x, tension positive"),
    named("syy", "Pa", "normal stress along y, tension positive"),
    named("szz", "Pa", "normal stress along z, tension positive"),
    named("sxy", "Pa", "shear stress xy"),
    named("sxz", "Pa", "shear stress xz"),
    named("syz", "Pa", "shear stress yz"),
    named("von_mises", "Pa", "von Mises' equivalent stress"),
    named(
        "max_principal",
        "Pa",
        "largest principal stress, tension positive",
    ),
];

const fn named(name: &'static str, unit: &'static str, meaning: &'static str) -> FieldName {
    FieldName {
        name,
        unit,
        meaning,
    }
}

/// The formats in which stresses are written.
#[must_use]
pub fn formats(formats: &[Format]) -> Vec<Format> {
    let is_one = |format: &Format| matches!(format, Format::Nc | Format::Vti);
    formats.iter().copied().filter(is_one).collect()
}

/// What the files of a step say besides the values.
#[derive(Debug)]
struct StressHead<'a> {
    summary: &'a Summary,
    step: usize,
    stress: &'a StressCase,
    /// Names of the bodies, from the surface down.
    bodies: Vec<String>,
    /// The coordinates of the points along x, and along y, m.
    centres: &'a [f64],
    planes: &'a [BodyPlane],
}

/// A file that takes plane after plane.
trait StressFile {
    fn add(&mut self, plane: usize, values: &PlaneValues) -> Result<(), Failure>;
    fn finish(self: Box<Self>) -> Result<(), Failure>;
}

/// The fields on one plane: a row for each coordinate along x.
#[derive(Debug)]
struct PlaneValues {
    fields: [Vec<f64>; FIELDS.len()],
    /// Points of a row.
    size: usize,
}

impl PlaneValues {
    fn new(size: usize) -> Self {
        Self {
            fields: std::array::from_fn(|_| vec![0.0; size * size]),
            size,
        }
    }

    fn compute(&mut self, planes: &mut StressPlanes, plane: BodyPlane) -> Result<(), Failure> {
        let take = |field: usize, values: &[f64]| self.fields[field].copy_from_slice(values);
        planes
            .fields_on(plane.depth, take)
            .map_err(Failure::Inside)?;
        self.derive();
        Ok(())
    }

    /// The fields that follow from the state.
    fn derive(&mut self) {
        let (state, derived) = self.fields.split_at_mut(STATE);
        let [von_mises, principal] = derived else {
            return;
        };
        let points = von_mises.par_iter_mut().zip(principal).enumerate();
        points.for_each(|(i, (von_mises, principal))| {
            let state = SubsurfaceState {
                displacement: [0.0; 3],
                stress: std::array::from_fn(|component| state[3 + component][i]),
            };
            *von_mises = state.von_mises();
            *principal = state.principal()[0];
        });
    }
}

/// The number of files that the fields of stresses take.
#[must_use]
pub fn count(case: &Case, steps: usize) -> usize {
    if case.stress.is_none() {
        return 0;
    }
    case.output.fields.count(steps) * formats(&case.output.formats).len()
}

/// Writes the stresses of the steps that have fields, one after the other.
///
/// # Errors
///
/// [`Failure`] if a file cannot be written or a field cannot be computed.
pub fn write(
    folder: &Path,
    path: &LoadingPath,
    summary: &Summary,
    case: &Case,
    writer: &WriteProgress<'_>,
) -> Result<(), Failure> {
    let formats = formats(&case.output.formats);
    let Some(stress) = case.stress.as_ref().filter(|_| !formats.is_empty()) else {
        return Ok(());
    };
    let steps = path.steps.len();
    let wanted = (0..steps).filter(|step| case.output.fields.contains(*step, steps));
    for step in wanted {
        writer.files(formats.len(), || {
            write_step(folder, path, summary, case, stress, step, &formats)
        })?;
    }
    Ok(())
}

fn write_step(
    folder: &Path,
    path: &LoadingPath,
    summary: &Summary,
    case: &Case,
    stress: &StressCase,
    step: usize,
    formats: &[Format],
) -> Result<(), Failure> {
    let Some(field) = StressField::new(path, step, stress.sliding()) else {
        return Ok(());
    };
    let radius = block_radius(summary, step);
    let foundation = path.tables.foundation();
    let planes = stress.planes(&case.foundation, foundation, radius);
    let mut computed = field.planes(stress.side(radius, summary.grid.side));
    let centres = computed.centres().to_vec();
    let head = StressHead {
        summary,
        step,
        stress,
        bodies: case.foundation.body_names(),
        centres: &centres,
        planes: &planes,
    };
    let begin = |format: &Format| -> Result<Box<dyn StressFile + '_>, Failure> {
        Ok(match format {
            Format::Nc => Box::new(netcdf::StressNetcdf::begin(folder, &head)?),
            _ => Box::new(vtr::StressVtr::begin(folder, &head)?),
        })
    };
    let mut files = formats.iter().map(begin).collect::<Result<Vec<_>, _>>()?;
    let mut values = PlaneValues::new(centres.len());
    for (i, plane) in planes.iter().enumerate() {
        values.compute(&mut computed, *plane)?;
        for file in &mut files {
            file.add(i, &values)?;
        }
    }
    files.into_iter().try_for_each(StressFile::finish)
}

/// The contact radius that the planes and their square are chosen by, m; of a step without contact a third of the
/// domain, as if it filled it.
fn block_radius(summary: &Summary, step: usize) -> f64 {
    let radius = summary.steps[step].contact_radius;
    if radius > 0.0 {
        radius
    } else {
        summary.grid.side / 3.0
    }
}
