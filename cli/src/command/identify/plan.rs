//! `pellicle identify --plan`: what to measure, before any measurement.

use std::time::Instant;

use pellicle::run::Completeness;
use pellicle_files::json;
use pellicle_identify::IdentifyError;
use pellicle_identify::fit_file::Measurements;
use pellicle_identify::fit_file::evaluation_file::Task;

use super::{claim, progress};
use crate::arguments::IdentifyArguments;
use crate::command::Outcome;
use crate::failure::Failure;
use crate::fit_and_plan::{self, Stage};
use crate::planning::{files, text};
use crate::results_folder::ResultsFolder;
use crate::{interrupt, terminal, threads};

/// Suffix of the folder of a plan, after the name of the fit file, so that the fit keeps its own folder.
const FOLDER: &str = "-plan";

/// Assesses the design of the fit file, then writes and reports the plan.
///
/// # Errors
///
/// [`Failure`] if the fit file is wrong, no curve can be solved, or the results cannot be written.
pub fn plan(arguments: &IdentifyArguments) -> Result<Outcome, Failure> {
    let start = Instant::now();
    let Task::Fit(file) = Task::read(&arguments.path, Measurements::Optional)? else {
        let reason = "an [evaluation] alone has no [model] to plan for";
        return Err(Failure::NotPlanned(reason.into()));
    };
    let folder = claim(arguments, FOLDER)?;
    threads::set(arguments.threads)?;
    threads::begin();
    let line = progress(arguments);
    let planned = fit_and_plan::plan(&file, start, &interrupt::flag(), &|stage| {
        if let Stage::Planned(done) = stage {
            line.set_message(format!("{done} curves planned"));
            line.tick();
        }
    });
    line.finish_and_clear();
    let mut plan = match planned {
        Err(Failure::Identify(IdentifyError::Stopped { predictions })) => {
            let message = format!("stopped after {predictions} curves solved; nothing is written");
            terminal::report(&message);
            return Ok(Outcome::Stopped);
        }
        planned => planned?,
    };
    interrupt::hold();
    let write = |folder: ResultsFolder| {
        folder.write(|folder| {
            files::write(folder, &mut plan)?;
            Ok(Completeness::Whole)
        })
    };
    let written = folder.map(write).transpose()?;
    if !(arguments.quiet || arguments.json) {
        terminal::report(text::text(&plan).trim_end());
        if let Some(folder) = &written {
            terminal::report(&format!("written to {}", folder.display()));
        }
    }
    if !arguments.quiet {
        for warning in &plan.warnings {
            terminal::report(&format!("warning: {}", warning.message));
        }
    }
    if arguments.json {
        terminal::print(&json(&plan)?)?;
    }
    Ok(Outcome::Done)
}
