//! A results folder: what is written into it, and what is read back to draw it again.

use std::io::Write;
use std::path::Path;

use pellicle_contact::LoadingPath;
use rayon::prelude::*;

use super::fields::Fields;
use super::npz::StoredFields;
use super::page::{self, StepPart};
use super::record::Record;
use super::summary::Summary;
use super::{curve, file, gsf, json, netcdf, npz, pictures, summary, vti};
use crate::failure::Failure;

/// Most loading steps on the report's page: some 100 kB each.
const STEPS_IN_REPORT: usize = 24;

/// Pictures of a loading step.
const PICTURES: usize = 3;

/// Writes everything a run leaves behind into an empty folder.
///
/// # Errors
///
/// [`Failure`] if a file cannot be written.
pub fn write(folder: &Path, path: &LoadingPath, summary: &Summary) -> Result<(), Failure> {
    let text = json(summary)?;
    let record = Record::parse(&text, summary.case.units)?;
    let geometry = path.geometry();
    let steps = (0..path.steps.len()).into_par_iter();
    let steps = steps.filter_map(|i| Some((i, path.surface(&geometry, i)?)));
    let parts = steps.map(|(i, surface)| {
        let fields = Fields::of(path, &geometry, i, &surface);
        let part = write_step(folder, &record, i, fields)?;
        Ok(is_in_report(i, path.steps.len()).then_some(part))
    });
    let parts = parts.collect::<Result<Vec<Option<StepPart>>, Failure>>()?;
    let parts: Vec<StepPart> = parts.into_iter().flatten().collect();
    write_text(&folder.join(curve::FILE), &curve::csv(summary))?;
    write_text(&folder.join(summary::FILE), &text)?;
    write_page(folder, &record, &parts).map(drop)
}

/// The fields and pictures of a step; what the report shows of them.
fn write_step(
    folder: &Path,
    record: &Record,
    step: usize,
    fields: Fields<'_>,
) -> Result<StepPart, Failure> {
    // What is packed takes about as long as all the rest.
    let (packed, part) = rayon::join(
        || npz::write(&folder.join(npz::file(step)), &fields),
        || {
            write_fields(folder, record, step, &fields)?;
            pictures::write_step(folder, record, step, fields)
        },
    );
    packed.and(part)
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

/// Draws the pictures and the report of a results folder again, from its files alone; how many pictures there are.
///
/// # Errors
///
/// [`Failure`] if the folder holds no results or a picture cannot be written.
pub fn draw(folder: &Path) -> Result<usize, Failure> {
    let record = Record::read(folder)?;
    let steps = record.steps.len();
    let mut parts = Vec::new();
    for i in 0..steps {
        let fields = StoredFields::read(&folder.join(npz::file(i)))?;
        let part = pictures::write_step(folder, &record, i, fields.fields(record.grid.side))?;
        parts.extend(is_in_report(i, steps).then_some(part));
    }
    Ok(PICTURES * steps + write_page(folder, &record, &parts)?)
}

/// Whether the report's page has room for a step: for the first, the last and some evenly between.
fn is_in_report(step: usize, steps: usize) -> bool {
    let gaps = (STEPS_IN_REPORT.min(steps) - 1).max(1);
    let nearest = (step * gaps).div_ceil((steps - 1).max(1));
    step == nearest * (steps - 1) / gaps
}

/// The pictures of the run as a whole, and the report; how many pictures there are.
fn write_page(folder: &Path, record: &Record, parts: &[StepPart]) -> Result<usize, Failure> {
    let run = pictures::write_run(folder, record)?;
    let page = page::html(record, parts, &run);
    file::write_bytes(&folder.join(page::FILE), page.as_bytes())?;
    Ok(usize::from(run.curve.is_some()) + usize::from(run.convergence.is_some()))
}

fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    file::write_whole(path, |file| file.write_all(text.as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kept(steps: usize) -> Vec<usize> {
        (0..steps).filter(|i| is_in_report(*i, steps)).collect()
    }

    #[test]
    fn a_long_curve_has_its_ends_and_steps_between_in_the_report() {
        assert_eq!(kept(1), [0]);
        assert_eq!(kept(3), [0, 1, 2]);
        for steps in [24, 25, 47, 1000] {
            let kept = kept(steps);
            assert_eq!(kept.len(), STEPS_IN_REPORT);
            assert_eq!((kept[0], kept[23]), (0, steps - 1));
        }
    }
}
