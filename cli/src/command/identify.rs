//! `pellicle identify`: fits a model to measured curves and reports the result.

pub mod each;
pub mod evaluation;
pub mod plan;

use std::path::Path;
use std::time::Instant;

use indicatif::ProgressBar;
use pellicle::input::source_file;
use pellicle::run::Completeness;
use pellicle_files::json;
use pellicle_files::whole::{self, Existing};
use pellicle_identify::fit_file::evaluation_file::Task;
use pellicle_identify::fit_file::{FitFile, Measurements};
use pellicle_identify::{Fit, FitVerdict, IdentifyError};

use crate::arguments::IdentifyArguments;
use crate::command::Outcome;
use crate::failure::Failure;
use crate::fit_and_plan::{self, Stage};
use crate::identification::fitted_file::FittedFile;
use crate::identification::{files, simulation, text};
use crate::results_folder::ResultsFolder;
use crate::{interrupt, terminal, threads};

/// Fits the model, writes the results and reports them.
///
/// # Errors
///
/// [`Failure`] if the fit file or a measurement is wrong, the results cannot be written, or the model has no
/// prediction at all.
pub fn identify(arguments: &IdentifyArguments) -> Result<Outcome, Failure> {
    threads::set(arguments.threads)?;
    let start = Instant::now();
    let file = match Task::read(&arguments.path, Measurements::Required)? {
        Task::Evaluation(file) => return evaluation::evaluate(arguments, &file),
        Task::Fit(file) => *file,
    };
    if let (true, Some(out)) = (arguments.simulate, &arguments.out) {
        return simulate(arguments, &file, out);
    }
    let folder = claim(arguments, "")?;
    threads::begin();
    let line = progress(arguments);
    let report = |stage| {
        line.set_message(match stage {
            Stage::Solved(predictions) => format!("{predictions} curves solved"),
            Stage::Planned(done) => format!("{done} curves of the design planned"),
        });
        line.tick();
    };
    let mut fitted = match fit_and_plan::fit(file, start, &interrupt::flag(), &report) {
        Err(Failure::Identify(IdentifyError::Stopped { .. })) => {
            line.finish_and_clear();
            terminal::report("stopped before the first curve was solved; nothing is written");
            return Ok(Outcome::Stopped);
        }
        found => found?,
    };
    line.finish_and_clear();
    let write = |folder: ResultsFolder| {
        folder.write(|folder| {
            files::write(folder, &mut fitted)?;
            Ok(if fitted.is_stopped() {
                Completeness::Part
            } else {
                Completeness::Whole
            })
        })
    };
    let written = folder.map(write).transpose()?;
    let FittedFile { fit, found, .. } = fitted;
    if !(arguments.quiet || arguments.json) {
        terminal::report(text::text(&found).trim_end());
        if let Some(folder) = &written {
            terminal::report(&format!("written to {}", folder.display()));
        }
    }
    if !arguments.quiet {
        for warning in &found.warnings {
            terminal::report(&format!("warning: {}", warning.message));
        }
    }
    if arguments.json {
        terminal::print(&json(&found)?)?;
    }
    Ok(outcome(arguments, &fit))
}

/// Writes measurements simulated from the fit file; for several tables, one numbered file each.
fn simulate(arguments: &IdentifyArguments, file: &FitFile, out: &Path) -> Result<Outcome, Failure> {
    let seed = arguments.seed.unwrap_or(file.report.seed);
    for table in 0..file.data.len() {
        let found = simulation::measurement(file, table, seed)?;
        for warning in &found.warnings {
            terminal::report(&format!("warning: {warning}"));
        }
        let path = simulation::path(out, table, file.data.len());
        let write = if arguments.force {
            whole::write_bytes
        } else {
            whole::write_new
        };
        write(&path, found.text.as_bytes())?;
        if !arguments.quiet {
            terminal::report(&format!("written to {}", path.display()));
        }
    }
    Ok(Outcome::Done)
}

/// The progress line.
fn progress(arguments: &IdentifyArguments) -> ProgressBar {
    if arguments.quiet || arguments.json {
        ProgressBar::hidden()
    } else {
        ProgressBar::new_spinner()
    }
}

/// Claims the results folder, by default named after the fit file with this suffix; none with `--json` alone.
fn claim(arguments: &IdentifyArguments, ending: &str) -> Result<Option<ResultsFolder>, Failure> {
    let existing = if arguments.force {
        Existing::Replace
    } else {
        Existing::Keep
    };
    let name = source_file::stem(&arguments.path);
    match &arguments.out {
        Some(path) => ResultsFolder::claim(path, existing).map(Some),
        None if arguments.json => Ok(None),
        None => ResultsFolder::claim_default(&(name + ending), existing).map(Some),
    }
}

fn outcome(arguments: &IdentifyArguments, fit: &Fit) -> Outcome {
    if fit.stopped.is_some() {
        return Outcome::Stopped;
    }
    match fit.verdict {
        FitVerdict::Fitted => Outcome::Done,
        FitVerdict::Misfit if arguments.accept_misfit => Outcome::Done,
        FitVerdict::Misfit => {
            terminal::report(
                "Error: misfit: the model does not fit the measurements; do not use these numbers \
                 (--accept-misfit accepts them)",
            );
            Outcome::Misfit
        }
        FitVerdict::OutsideModel => {
            terminal::report(
                "Error: outside the model: the fit has converged, but its model holds at too few of the points; the \
                 warnings above say why and what to change",
            );
            Outcome::NotConverged
        }
        FitVerdict::NotConverged => {
            terminal::report("Error: not converged: do not use these numbers");
            Outcome::NotConverged
        }
    }
}
