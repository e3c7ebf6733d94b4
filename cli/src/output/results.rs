//! The files of a run: written into a results folder, and its summary read back.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::time::Instant;

use pellicle::Completeness;
use pellicle::case::Case;
use pellicle::case::output::{Format, OutputCase};
use pellicle::result::fields::Fields;
use pellicle::result::table;
use pellicle::summary;
use pellicle::summary::RunSummary;
use pellicle_contact::LoadingPath;
use pellicle_files::{json, whole};
use pellicle_plot::sheet::style::Style;
use rayon::prelude::*;

use super::pictures::{self, StepDrawings};
use super::report;
use super::write_progress::{OnProgress, WriteProgress};
use super::{gsf, netcdf, npz, stress, vti};
use crate::failure::Failure;
use crate::interrupt;

/// Largest number of loading steps in the report, at some 100 kB each.
pub(super) const STEPS_IN_REPORT: usize = 24;

/// Writes all files of a run into an empty folder. The summary receives the time since `start`, including writing, and
/// the warnings about the writing.
///
/// If the user asks to stop, fields and pictures that are not finished soon are left out, and the result is partial;
/// summary, curve and report are always written.
///
/// # Errors
///
/// [`Failure`] if a file cannot be written.
pub fn write(
    folder: &Path,
    path: &LoadingPath,
    summary: &mut RunSummary,
    case: &Case,
    start: Instant,
    on_progress: OnProgress<'_>,
) -> Result<Completeness, Failure> {
    let output = &case.output;
    let files = files(summary, output) + stress::count(case, summary);
    let writer = WriteProgress::new(files, on_progress);
    let mut parts = write_steps(folder, path, summary, output, &writer)?;
    for drawings in stress::write(folder, path, summary, case, &writer)? {
        let part = parts.iter_mut().find(|part| part.step == drawings.step);
        part.into_iter()
            .for_each(|part| part.stresses.clone_from(&drawings.drawings));
    }
    let run = pictures::run(folder, summary, output.pictures, &Style::default(), &writer)?;
    summary.warnings.extend(writer.warnings());
    summary.timing.total_seconds = start.elapsed().as_secs_f64();
    write_page(folder, &report::html(summary, &parts, &run))?;
    write_text(&folder.join(table::FILE), &table::csv(summary))?;
    write_text(&folder.join(summary::FILE), &json(summary)?)?;
    Ok(if writer.is_whole() {
        Completeness::Whole
    } else {
        Completeness::Part
    })
}

/// Reads the summary of a results folder; its units are those of the curve.
///
/// # Errors
///
/// [`Failure::File`] if its files are missing or were not written by a run.
pub fn read_summary(folder: &Path) -> Result<RunSummary, Failure> {
    let path = folder.join(summary::FILE);
    let text = read_text(&path)?;
    let units = table::units(&read_text(&folder.join(table::FILE))?);
    RunSummary::parse(&text, units).map_err(|cause| Failure::damaged(&path, &cause))
}

fn read_text(path: &Path) -> Result<String, Failure> {
    fs::read_to_string(path).map_err(|cause| Failure::damaged(path, &cause))
}

/// The number of files of fields and of pictures.
fn files(summary: &RunSummary, output: &OutputCase) -> usize {
    let steps = summary.steps.len();
    let fields = output.fields.count(steps) * output.formats.len();
    let pictures = output.pictures.count(steps) * pictures::of_a_step(summary).len();
    fields + pictures + pictures::count_of_run(summary, output.pictures)
}

/// Writes the requested fields and pictures of the steps, and returns the drawings for the report.
fn write_steps(
    folder: &Path,
    path: &LoadingPath,
    summary: &RunSummary,
    output: &OutputCase,
    writer: &WriteProgress<'_>,
) -> Result<Vec<StepDrawings>, Failure> {
    let count = path.steps.len();
    let wanted =
        |i: &usize| output.fields.contains(*i, count) || output.pictures.contains(*i, count);
    let steps: Vec<_> = (0..count).filter(wanted).collect();
    let pictured: Vec<_> = (0..count)
        .filter(|i| output.pictures.contains(*i, count))
        .collect();
    let shown = in_report(&pictured);
    let is_needed = !steps.is_empty() && !interrupt::is_overdue();
    let geometry = is_needed.then(|| path.geometry());
    let parts = steps.into_par_iter().map(|i| {
        let formats = if output.fields.contains(i, count) {
            &output.formats[..]
        } else {
            &[]
        };
        if interrupt::is_overdue() {
            let pictures = usize::from(pictured.contains(&i)) * pictures::of_a_step(summary).len();
            writer.leave_out(formats.len() + pictures);
            return Ok(None);
        }
        let surface = || path.surface(geometry.as_ref()?, i);
        let (Some(geometry), Some(surface)) = (&geometry, surface()) else {
            return Ok(None);
        };
        let fields = Fields::of(path, geometry, i, &surface);
        let draw = || {
            if !pictured.contains(&i) {
                return Ok(None);
            }
            pictures::step(folder, summary, i, fields, &Style::default(), writer).map(Some)
        };
        let (written, part) = rayon::join(
            || write_fields(folder, summary, i, &fields, formats, writer),
            draw,
        );
        written?;
        Ok(part?.filter(|part| shown.contains(&part.step)))
    });
    let parts = parts.collect::<Result<Vec<Option<StepDrawings>>, Failure>>()?;
    Ok(parts.into_iter().flatten().collect())
}

/// Writes the fields of a step in every requested format, in parallel: compression takes about as long as all the rest.
fn write_fields(
    folder: &Path,
    summary: &RunSummary,
    step: usize,
    fields: &Fields<'_>,
    formats: &[Format],
    writer: &WriteProgress<'_>,
) -> Result<(), Failure> {
    let units = summary.units;
    formats.par_iter().try_for_each(|format| {
        let write = || match format {
            Format::Npz => npz::write(&folder.join(npz::file(step)), fields),
            Format::Vti => vti::write(&folder.join(vti::file(step)), fields, units),
            Format::Nc => netcdf::write(&folder.join(netcdf::file(step)), fields, summary, step),
            Format::Gsf => gsf::write(folder, fields, units, step),
        };
        writer.file(write).map(drop)
    })
}

/// Selects the steps with pictures that appear in the report: the first, the last and some evenly spaced between.
#[must_use]
pub fn in_report(pictured: &[usize]) -> Vec<usize> {
    let steps = pictured.len();
    let gaps = (STEPS_IN_REPORT.min(steps).saturating_sub(1)).max(1);
    let is_kept = |i: &usize| {
        let nearest = (i * gaps).div_ceil(steps.saturating_sub(1).max(1));
        *i == nearest * (steps - 1) / gaps
    };
    (0..steps).filter(is_kept).map(|i| pictured[i]).collect()
}

/// Writes the report, without forcing it onto the disk: it can be drawn again.
///
/// # Errors
///
/// [`Failure::File`] if it cannot be written.
pub fn write_page(folder: &Path, page: &str) -> Result<(), Failure> {
    Ok(whole::write_bytes(
        &folder.join(report::FILE),
        page.as_bytes(),
    )?)
}

fn write_text(path: &Path, text: &str) -> Result<(), Failure> {
    Ok(whole::write_whole(path, |file| {
        file.write_all(text.as_bytes())
    })?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kept(steps: usize) -> Vec<usize> {
        in_report(&(0..steps).collect::<Vec<_>>())
    }

    #[test]
    fn the_report_of_a_long_curve_has_its_ends_and_steps_in_between() {
        assert!(kept(0).is_empty());
        assert_eq!(kept(1), [0]);
        assert_eq!(in_report(&[7]), [7]);
        assert_eq!(kept(3), [0, 1, 2]);
        for steps in [24, 25, 47, 1000] {
            let kept = kept(steps);
            assert_eq!(kept.len(), STEPS_IN_REPORT);
            assert_eq!((kept[0], kept[23]), (0, steps - 1));
        }
    }
}
