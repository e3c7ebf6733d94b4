//! `pellicle plot`: redraws the pictures of results, in any style, or draws the curves of several results in one
//! picture.

pub mod paper;

use std::path::Path;

use pellicle::summary::WarningSummary;
use pellicle_files::disk;
use pellicle_plot::sheet::style::{Heading, Style};
use pellicle_study::identity::StudyIdentity;
use pellicle_study::shard::Shard;

use crate::arguments::PlotArguments;
use crate::command::Outcome;
use crate::failure::Failure;
use crate::output::redraw::{self, RedrawOptions};
use crate::picture::found;
use crate::progress::ProgressLine;
use crate::terminal;

/// Draws the pictures, using only the files of the folders.
///
/// # Errors
///
/// [`Failure`] if a folder holds no results, the options do not fit them, or a picture cannot be written.
pub fn plot(arguments: &PlotArguments) -> Result<Outcome, Failure> {
    if let Some(out) = &arguments.out {
        disk::create_dir_all(out).map_err(|cause| Failure::write(out, cause))?;
    }
    if let [folder] = &arguments.folders[..]
        && (found::is_in(folder) || is_study(folder))
    {
        let name = paper::draw(arguments, folder)?;
        let out = arguments.out.as_deref().unwrap_or(folder);
        terminal::report(&format!("{name} drawn in {}", out.display()));
        return Ok(Outcome::Done);
    }
    refuse_options_of_studies(arguments)?;
    let (count, out, warnings) = match &arguments.folders[..] {
        [folder] => one(arguments, folder)?,
        _ => several(arguments)?,
    };
    for warning in &warnings {
        terminal::report(&format!("warning: {}", warning.message));
    }
    let pictures = if count == 1 { "picture" } else { "pictures" };
    terminal::report(&format!("{count} {pictures} drawn in {}", out.display()));
    Ok(Outcome::Done)
}

/// Whether a folder holds the table of a study.
fn is_study(folder: &Path) -> bool {
    StudyIdentity::path(folder, Shard::WHOLE).is_file()
}

/// Refuses options that apply to a study or a search alone.
fn refuse_options_of_studies(arguments: &PlotArguments) -> Result<(), Failure> {
    let given = [
        !arguments.results.is_empty(),
        !arguments.over.is_empty(),
        arguments.form.is_some(),
        !arguments.formats.is_empty(),
        arguments.width.is_some(),
        arguments.dpi.is_some(),
    ];
    if given.contains(&true) {
        return Err(Failure::OneStudy);
    }
    Ok(())
}

/// The number of pictures drawn, their folder, and the warnings.
type Drawn<'a> = (usize, &'a Path, Vec<WarningSummary>);

fn one<'a>(arguments: &'a PlotArguments, folder: &'a Path) -> Result<Drawn<'a>, Failure> {
    let options = RedrawOptions {
        style: style(arguments),
        step: arguments.step,
        out: arguments.out.as_deref(),
        replaces: arguments.force,
    };
    let line = ProgressLine::new(1.0);
    let redrawn = redraw::draw(folder, &options, &line.writing())?;
    let out = options.out.unwrap_or(folder);
    Ok((redrawn.pictures, out, redrawn.warnings))
}

fn several(arguments: &PlotArguments) -> Result<Drawn<'_>, Failure> {
    let of_fields = [
        arguments.step.is_some(),
        arguments.section.is_some(),
        arguments.range.is_some(),
        arguments.colour_map.is_some(),
    ];
    if of_fields.contains(&true) {
        return Err(Failure::OneResult);
    }
    let out = arguments.out.as_deref().unwrap_or(Path::new("."));
    let style = style(arguments);
    let warnings = redraw::draw_curves(&arguments.folders, out, arguments.force, &style)?;
    Ok((1 - warnings.len(), out, warnings))
}

fn style(arguments: &PlotArguments) -> Style {
    Style {
        width: arguments.size.map(f64::from),
        paper_mm: None,
        heading: if arguments.no_title {
            Heading::Hidden
        } else {
            Heading::Shown
        },
        colours: arguments.colour_map.unwrap_or_default(),
        pressures: arguments.range,
        cut: arguments.section,
    }
}
