//! Pictures redrawn using only the files of results folders.

use std::path::{Path, PathBuf};

use pellicle::case::output::Steps;
use pellicle::summary::{RunSummary, WarningSummary};
use pellicle_files::FileError;
use pellicle_plot::run::curve::draw_several;
use pellicle_plot::sheet::style::Style;
use rayon::prelude::*;

use super::npz::{self, StoredFields};
use super::pictures::{self, StepDrawings};
use super::report;
use super::write_progress::{OnProgress, WriteProgress};
use super::{results, stress};
use crate::failure::Failure;
use crate::picture::curve;

/// File name of the picture of several curves, without extension.
const CURVES: &str = "curves";

/// The pictures to redraw of one results folder.
#[derive(Debug, Clone, Default)]
pub struct RedrawOptions<'a> {
    /// Look of the pictures.
    pub style: Style,
    /// The only step to draw; by default all steps that have fields.
    pub step: Option<usize>,
    /// Folder of the pictures; by default they go beside the results, and into their report.
    pub out: Option<&'a Path>,
    /// Whether existing pictures in that folder may be replaced.
    pub replaces: bool,
}

/// The outcome of redrawing.
#[derive(Debug, Clone)]
pub struct Redrawn {
    /// Number of pictures drawn.
    pub pictures: usize,
    /// Pictures that could not be drawn.
    pub warnings: Vec<WarningSummary>,
}

/// Draws the pictures of a results folder, on all cores, and its report, for every step that has fields in `.npz`.
///
/// # Errors
///
/// [`Failure`] if the folder contains no results, the requested step has no fields, or a picture cannot be written.
pub fn draw(
    folder: &Path,
    options: &RedrawOptions<'_>,
    on_progress: OnProgress<'_>,
) -> Result<Redrawn, Failure> {
    let summary = results::read_summary(folder)?;
    let fields = |step: usize| folder.join(npz::file(step));
    let steps: Vec<_> = match options.step {
        Some(step) => vec![step],
        None => (0..summary.steps.len())
            .filter(|step| fields(*step).is_file())
            .collect(),
    };
    let of_run = if options.step.is_none() {
        Steps::All
    } else {
        Steps::None
    };
    let stresses = |step: usize| folder.join(stress::npz::file(step));
    let with_stresses: Vec<_> = (steps.iter().copied())
        .filter(|step| stresses(*step).is_file())
        .collect();
    let count = steps.len() * pictures::of_a_step(&summary).len()
        + with_stresses.len() * pictures::of_stresses(&summary).len()
        + pictures::count_of_run(&summary, of_run);
    let writer = WriteProgress::new(count, on_progress);
    let out = options.out.unwrap_or(folder);
    if options.out.is_some() && !options.replaces {
        let of_stresses = with_stresses.iter();
        let of_stresses = of_stresses.flat_map(|step| pictures::names_of_stresses(&summary, *step));
        let names = pictures::names(&summary, &steps, of_run);
        (names.into_iter().chain(of_stresses)).try_for_each(|name| keep(out, &name))?;
    }
    let shown = results::in_report(&steps);
    let parts = steps.par_iter().map(|step| {
        if *step >= summary.steps.len() {
            let reason = format!(
                "there is no step {step}, the last is {}",
                summary.steps.len() - 1
            );
            return Err(Failure::damaged(folder, &reason));
        }
        let path = fields(*step);
        if !path.exists() {
            return Err(Failure::NoFields {
                path: folder.to_owned(),
                step: *step,
            });
        }
        let stored = StoredFields::read(&path)?;
        let of_step = stored.fields(summary.grid.side);
        let mut part = pictures::step(out, &summary, *step, of_step, &options.style, &writer)?;
        if with_stresses.contains(step) {
            let view = stress::npz::read(&stresses(*step))?;
            let style = &options.style;
            let drawn = pictures::stresses(out, &summary, *step, of_step, &view, style, &writer)?;
            part.stresses = drawn.drawings;
        }
        Ok(shown.contains(step).then_some(part))
    });
    let parts = parts.collect::<Result<Vec<Option<StepDrawings>>, Failure>>()?;
    let parts: Vec<_> = parts.into_iter().flatten().collect();
    let run = pictures::run(out, &summary, of_run, &options.style, &writer)?;
    // A report with old drawings is better than one without drawings.
    let report = folder.join(report::FILE);
    let is_whole = options.out.is_none() && options.step.is_none();
    if is_whole && (!parts.is_empty() || !report.exists()) {
        results::write_page(folder, &report::html(&summary, &parts, &run))?;
    }
    let warnings = writer.warnings();
    Ok(Redrawn {
        pictures: count - warnings.len(),
        warnings,
    })
}

/// Draws the curves of several results folders as one picture into a folder, and returns the warnings.
///
/// # Errors
///
/// [`Failure`] if a folder contains no results, if only some have units, or if the picture cannot be written.
pub fn draw_curves(
    folders: &[PathBuf],
    out: &Path,
    replaces: bool,
    style: &Style,
) -> Result<Vec<WarningSummary>, Failure> {
    if !replaces {
        keep(out, CURVES)?;
    }
    let summaries = folders.iter().map(|folder| results::read_summary(folder));
    let summaries = summaries.collect::<Result<Vec<_>, Failure>>()?;
    let units = summaries
        .first()
        .map(|summary| summary.units)
        .unwrap_or_default();
    let other = summaries.iter().position(|summary| summary.units != units);
    if let Some(other) = other {
        let reason =
            "its units are not those of the first: one is in SI units, the other in case units";
        return Err(Failure::damaged(&folders[other], &reason));
    }
    let names = names(folders, &summaries);
    let curves = summaries.iter().zip(names);
    let curves = curves.map(|(summary, name)| curve::of_run(summary, name));
    let worst = curve::worst(summaries.iter().flat_map(|summary| &summary.steps));
    let writer = WriteProgress::new(1, &|_, _| ());
    writer.picture(out, CURVES, || {
        draw_several(curves.collect(), worst, units, style)
    })?;
    Ok(writer.warnings())
}

/// Fails if a picture would be replaced.
fn keep(folder: &Path, name: &str) -> Result<(), Failure> {
    let files = ["svg", "png"].map(|ending| folder.join(format!("{name}.{ending}")));
    let taken = files
        .into_iter()
        .find(|path| path.symlink_metadata().is_ok());
    taken.map_or(Ok(()), |path| Err(FileError::Exists { path }.into()))
}

/// The names of results: their titles, with their folders if titles are not unique.
fn names(folders: &[PathBuf], summaries: &[RunSummary]) -> Vec<String> {
    let is_twice = |title: &str| {
        summaries
            .iter()
            .filter(|other| other.title == title)
            .count()
            > 1
    };
    let name = |(folder, summary): (&PathBuf, &RunSummary)| {
        if is_twice(&summary.title) {
            format!("{} ({})", folder.display(), summary.title)
        } else {
            summary.title.clone()
        }
    };
    folders.iter().zip(summaries).map(name).collect()
}
