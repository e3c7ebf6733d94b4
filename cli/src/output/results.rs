//! A results folder: what is written into it, and what is read back to draw it again.

use std::io::Write;
use std::path::Path;

use pellicle_contact::LoadingPath;

use super::fields::Fields;
use super::npz::StoredFields;
use super::record::Record;
use super::summary::Summary;
use super::{curve, file, gsf, json, netcdf, npz, pictures, summary, vti};
use crate::failure::Failure;

/// Writes everything a run leaves behind into an empty folder.
///
/// # Errors
///
/// [`Failure`] if a file cannot be written.
pub fn write(folder: &Path, path: &LoadingPath, summary: &Summary) -> Result<(), Failure> {
    let text = json(summary)?;
    let record = Record::parse(&text, summary.case.units)?;
    for (i, step) in path.steps.iter().enumerate() {
        let fields = Fields::of(path, &step.solution);
        let (packed, (written, drawn)) = rayon::join(
            || npz::write(&folder.join(npz::file(i)), &fields),
            || {
                (
                    write_fields(folder, &record, i, &fields),
                    pictures::write_step(folder, &record, i, fields),
                )
            },
        );
        packed.and(written).and(drawn)?;
    }
    pictures::write_run(folder, &record)?;
    write_text(&folder.join(curve::FILE), &curve::csv(summary))?;
    write_text(&folder.join(summary::FILE), &text)
}

/// The fields of a step for other programs.
fn write_fields(
    folder: &Path,
    record: &Record,
    step: usize,
    fields: &Fields<'_>,
) -> Result<(), Failure> {
    let units = record.units;
    vti::write(&folder.join(vti::file(step)), fields, units)?;
    gsf::write(&folder.join(gsf::file(step)), fields, units)?;
    netcdf::write(&folder.join(netcdf::file(step)), fields, record, step)
}

/// Writes a text file, whole or not at all.
///
/// # Errors
///
/// [`Failure::Write`] if it cannot be written.
pub fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    file::write_whole(path, |file| file.write_all(text.as_bytes()))
}

/// Draws the pictures of a results folder again, from its files alone; how many there are.
///
/// # Errors
///
/// [`Failure`] if the folder holds no results or a picture cannot be written.
pub fn draw(folder: &Path) -> Result<usize, Failure> {
    let record = Record::read(folder)?;
    let mut count = pictures::write_run(folder, &record)?;
    for i in 0..record.steps.len() {
        let fields = StoredFields::read(&folder.join(npz::file(i)))?;
        count += pictures::write_step(folder, &record, i, fields.fields(record.grid.side))?;
    }
    Ok(count)
}
