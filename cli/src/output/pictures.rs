//! The pictures of a results folder, each as SVG and as PNG.

use std::path::Path;

use rayon::prelude::*;

use super::fields::Fields;
use super::file::write_whole;
use super::record::Record;
use super::results::write_text;
use crate::failure::Failure;
use crate::picture::subject::Subject;
use crate::picture::{convergence, curve, png, pressure_map, pressure_view, section};

/// From a step to SVG.
type Draw = fn(&Subject<'_>) -> String;

/// Writes the pictures of one loading step; how many there are.
///
/// # Errors
///
/// [`Failure::Write`] if a picture cannot be written.
pub fn write_step(
    folder: &Path,
    record: &Record,
    step: usize,
    fields: Fields<'_>,
) -> Result<usize, Failure> {
    let subject = subject(record, step, fields);
    let pictures: [(String, Draw); 3] = [
        (pressure_map::name(step), pressure_map::draw),
        (section::name(step), section::draw),
        (pressure_view::name(step), pressure_view::draw),
    ];
    let write = |(name, draw): &(String, Draw)| write(folder, name, &draw(&subject));
    pictures.par_iter().try_for_each(write)?;
    Ok(pictures.len())
}

/// Writes the pictures of the run as a whole; how many there are.
///
/// # Errors
///
/// [`Failure::Write`] if a picture cannot be written.
pub fn write_run(folder: &Path, record: &Record) -> Result<usize, Failure> {
    let pictures = [
        (curve::NAME, curve::draw(record)),
        (convergence::NAME, convergence::draw(record)),
    ];
    let mut count = 0;
    for (name, picture) in pictures {
        if let Some(svg) = picture {
            write(folder, name, &svg)?;
            count += 1;
        }
    }
    Ok(count)
}

/// What the pictures of a step show.
#[must_use]
pub fn subject<'a>(record: &'a Record, step: usize, fields: Fields<'a>) -> Subject<'a> {
    Subject {
        title: &record.title,
        units: record.units,
        relief_height: record.relief_height(),
        step: &record.steps[step],
        fields,
    }
}

fn write(folder: &Path, name: &str, svg: &str) -> Result<(), Failure> {
    write_text(&folder.join(format!("{name}.svg")), svg)?;
    let path = folder.join(format!("{name}.png"));
    write_whole(&path, |file| {
        use std::io::Write as _;
        file.write_all(&png::render(svg)?)
    })
}
