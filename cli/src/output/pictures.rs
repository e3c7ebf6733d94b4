//! The pictures of a results folder, each as SVG and as PNG, and the parts of the report that are made of them.

use std::path::Path;

use super::fields::Fields;
use super::file::write_bytes;
use super::page::{RunPart, StepPart, surface};
use super::record::Record;
use crate::failure::Failure;
use crate::picture::subject::Subject;
use crate::picture::{convergence, curve, png, pressure_map, pressure_view, section};

/// From a step to SVG.
type Draw = fn(&Subject<'_>) -> String;

/// Writes the three pictures of one loading step; what the report shows of them.
///
/// # Errors
///
/// [`Failure::Write`] if a picture cannot be written.
pub fn write_step(
    folder: &Path,
    record: &Record,
    step: usize,
    fields: Fields<'_>,
) -> Result<StepPart, Failure> {
    let subject = Subject {
        title: &record.title,
        units: record.units,
        relief_height: record.relief_height(),
        step: &record.steps[step],
        fields,
    };
    let draw = |name: String, draw: Draw| write(folder, &name, draw(&subject));
    let (map, (section, view)) = rayon::join(
        || draw(pressure_map::name(step), pressure_map::draw),
        || {
            rayon::join(
                || draw(section::name(step), section::draw),
                || draw(pressure_view::name(step), pressure_view::draw),
            )
        },
    );
    view?;
    Ok(StepPart {
        step,
        map: map?,
        section: section?,
        surface: surface::figure(&subject),
    })
}

/// Writes the pictures of the run as a whole, those that there are; what the report shows of them.
///
/// # Errors
///
/// [`Failure::Write`] if a picture cannot be written.
pub fn write_run(folder: &Path, record: &Record) -> Result<RunPart, Failure> {
    let write = |name, svg: Option<String>| svg.map(|svg| write(folder, name, svg)).transpose();
    Ok(RunPart {
        curve: write(curve::NAME, curve::draw(record))?,
        convergence: write(convergence::NAME, convergence::draw(record))?,
    })
}

/// Writes a drawing as it is and rendered, and gives it back. Neither is forced onto the disk: they can be drawn again.
fn write(folder: &Path, name: &str, svg: String) -> Result<String, Failure> {
    let file = |ending| folder.join(format!("{name}.{ending}"));
    write_bytes(&file("svg"), svg.as_bytes())?;
    let path = file("png");
    let png = png::render(&svg).map_err(|cause| Failure::Write {
        path: path.clone(),
        cause,
    })?;
    write_bytes(&path, &png)?;
    Ok(svg)
}
