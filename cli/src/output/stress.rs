//! `stress-NNN.nc` and `stress-NNN.vtr`: displacements and stresses on planes in the body, computed and written plane
//! by plane, so that only one plane is in memory; and the pictures of the same planes, with `stress-NNN.npz` to redraw
//! them.

pub mod fields;
mod netcdf;
pub mod npz;
mod plane_values;
mod planes;
pub mod view;
mod vtr;

use std::path::Path;

use pellicle::case::Case;
use pellicle::case::output::Format;
use pellicle::case::stress::StressCase;
use pellicle::summary::{RunSummary, StepSummary};
use pellicle_contact::{LoadingPath, StressField};

pub use self::plane_values::{FIELDS, FieldName};
use self::plane_values::{PlaneValues, StressFile, StressHead};
use self::planes::{PlaneUses, block_radius};
use self::view::{SectionDepths, ViewCollector};
use super::pictures::{self, StressDrawings};
use super::write_progress::WriteProgress;
use crate::failure::Failure;
use pellicle::result::fields::Fields;
use pellicle_plot::sheet::style::Style;
use pellicle_plot::stress::view::{StressView, SurfaceLine};

/// Selects the formats in which stresses are written.
#[must_use]
pub fn formats(formats: &[Format]) -> Vec<Format> {
    let is_one = |format: &Format| matches!(format, Format::Nc | Format::Vti | Format::Npz);
    formats.iter().copied().filter(is_one).collect()
}

/// The requested files and pictures of the stresses of a step.
#[derive(Debug, Clone)]
struct WantedStresses {
    step: usize,
    formats: Vec<Format>,
    is_pictured: bool,
}

/// Returns the steps that have files or pictures of stresses.
fn wanted(case: &Case, steps: usize) -> Vec<WantedStresses> {
    if case.stress.is_none() {
        return Vec::new();
    }
    let output = &case.output;
    let of_step = |step: usize| WantedStresses {
        step,
        formats: if output.fields.contains(step, steps) {
            formats(&output.formats)
        } else {
            Vec::new()
        },
        is_pictured: output.pictures.contains(step, steps),
    };
    let all = (0..steps).map(of_step);
    all.filter(|wanted| wanted.is_pictured || !wanted.formats.is_empty())
        .collect()
}

/// The number of files and pictures of the stresses.
#[must_use]
pub fn count(case: &Case, summary: &RunSummary) -> usize {
    let pictures = pictures::of_stresses(summary).len();
    let count =
        |wanted: &WantedStresses| wanted.formats.len() + usize::from(wanted.is_pictured) * pictures;
    wanted(case, summary.steps.len()).iter().map(count).sum()
}

/// Writes the stresses of the steps that have fields or pictures, one after the other, and returns the drawings for the
/// report.
///
/// # Errors
///
/// [`Failure`] if a file cannot be written or a field cannot be computed.
pub fn write(
    folder: &Path,
    path: &LoadingPath,
    summary: &RunSummary,
    case: &Case,
    writer: &WriteProgress<'_>,
) -> Result<Vec<StressDrawings>, Failure> {
    let wanted = wanted(case, path.steps.len());
    let seen = case
        .stress
        .as_ref()
        .map(|stress| path.seen_from(stress.body.into()));
    let path = seen.as_ref().unwrap_or(path);
    let geometry = (wanted.iter().any(|wanted| wanted.is_pictured)).then(|| path.geometry());
    let mut drawn = Vec::new();
    for wanted in wanted {
        let step = wanted.step;
        let view = writer.files(wanted.formats.len(), || {
            write_step(folder, path, summary, case, &wanted)
        })?;
        if !wanted.is_pictured {
            continue;
        }
        let surface = geometry
            .as_ref()
            .and_then(|geometry| path.surface(geometry, step));
        if let (Some(Some(view)), Some(geometry), Some(surface)) = (view, &geometry, &surface) {
            let fields = Fields::of(path, geometry, step, surface);
            let style = &Style::default();
            drawn.push(pictures::stresses(
                folder, summary, step, fields, &view, style, writer,
            )?);
        } else {
            writer.leave_out(pictures::of_stresses(summary).len());
        }
    }
    Ok(drawn)
}

/// Writes the files of a step, and returns the content of its pictures if needed.
fn write_step(
    folder: &Path,
    path: &LoadingPath,
    summary: &RunSummary,
    case: &Case,
    wanted: &WantedStresses,
) -> Result<Option<StressView>, Failure> {
    let WantedStresses { step, formats, .. } = wanted;
    let stress = case.stress.clone().unwrap_or_default();
    let Some(field) = StressField::new(path, *step, stress.sliding()) else {
        return Ok(None);
    };
    let (body, prefix) = (case.stressed(), stress.body.prefix());
    let foundation = path.tables.foundation();
    let field = field.with_residual(body.residual_stress(foundation));
    let radius = block_radius(
        summary.steps[*step].summary.contact_radius,
        summary.grid.side,
    );
    let is_of_fields = |format: &&Format| **format != Format::Npz;
    let of_fields: Vec<_> = formats.iter().filter(is_of_fields).collect();
    let uses = PlaneUses {
        files: !of_fields.is_empty(),
        view: wanted.is_pictured || of_fields.len() < formats.len(),
    };
    let wanted = planes::wanted(&stress, &body, foundation, radius, uses);
    let filed: Vec<_> = wanted.iter().filter(|wanted| wanted.is_filed).collect();
    let mut computed = field.planes(stress.side(radius, summary.grid.side));
    let centres = computed.centres().to_vec();
    let names = body.body_names().into_iter();
    let head = StressHead {
        summary,
        step: *step,
        stress: &stress,
        bodies: names.map(|name| format!("{prefix}{name}")).collect(),
        centres: &centres,
        planes: &filed.iter().map(|wanted| wanted.plane).collect::<Vec<_>>(),
    };
    let begin = |format: &&Format| -> Result<Box<dyn StressFile + '_>, Failure> {
        Ok(match format {
            Format::Nc => Box::new(netcdf::StressNetcdf::begin(folder, &head)?),
            _ => Box::new(vtr::StressVtr::begin(folder, &head)?),
        })
    };
    let mut files = of_fields.iter().map(begin).collect::<Result<Vec<_>, _>>()?;
    let line = section_line(&summary.steps[*step], &stress);
    let drawn = stress.drawn_planes(&body, foundation, radius);
    let reach = SectionDepths {
        deepest: drawn.last().map_or(0.0, |plane| plane.depth.z),
        bottoms: body.bottoms(foundation),
    };
    let mut collector = ViewCollector::new(line, &centres, reach);
    let mut values = PlaneValues::new(centres.len());
    let mut number = 0;
    for wanted in &wanted {
        values.compute(&mut computed, wanted.plane)?;
        if wanted.is_viewed {
            collector.add(wanted.plane, &values);
        }
        if wanted.is_filed {
            (files.iter_mut()).try_for_each(|file| file.add(number, &values))?;
            number += 1;
        }
    }
    files.into_iter().try_for_each(StressFile::finish)?;
    let view = collector.finish();
    if formats.contains(&Format::Npz) {
        npz::write(&folder.join(npz::file(*step)), &view)?;
    }
    Ok(uses.view.then_some(view))
}

/// The line through the point of the largest von Mises stress, or of another stress if that is not wanted, along the
/// direction of sliding or along x.
fn section_line(step: &StepSummary, stress: &StressCase) -> SurfaceLine {
    let bodies = step
        .stress
        .iter()
        .flat_map(|stress| &stress.extremes.bodies);
    let largest = bodies
        .filter_map(|body| {
            let others = body.max_principal.or(body.max_shear).or(body.min_principal);
            body.max_von_mises.or(others)
        })
        .max_by(|one, other| one.value.abs().total_cmp(&other.value.abs()));
    SurfaceLine {
        through: largest.map_or([0.0; 2], |largest| [largest.at[0], largest.at[1]]),
        direction: if stress.friction > 0.0 {
            stress.direction
        } else {
            0.0
        },
    }
}
