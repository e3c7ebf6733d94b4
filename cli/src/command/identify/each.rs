//! `pellicle identify --each`: every curve of the fit file fitted alone.

use pellicle::run::Completeness;
use pellicle_files::json;
use pellicle_identify::fit_file::Measurements;
use pellicle_identify::fit_file::evaluation_file::Task;
use pellicle_identify::measured::data_table::DataTable;

use super::claim;
use crate::arguments::IdentifyArguments;
use crate::command::Outcome;
use crate::each::{EachResult, FAILED, files, text};
use crate::failure::Failure;
use crate::results_folder::ResultsFolder;
use crate::{interrupt, terminal, threads};

/// Suffix of the folder, after the name of the fit file, so that the joint fit keeps its own folder.
const FOLDER: &str = "-each";

/// Fits each curve, then writes and reports the table.
///
/// # Errors
///
/// [`Failure`] if the fit file is wrong or the results cannot be written; not if a curve is wrong.
pub fn each(arguments: &IdentifyArguments) -> Result<Outcome, Failure> {
    threads::set(arguments.threads)?;
    let file = match Task::read(&arguments.path, Measurements::Required)? {
        Task::Fit(file) => *file,
        // An evaluation is one of each curve alone.
        Task::Evaluation(file) => return super::evaluation::evaluate(arguments, &file),
    };
    if let Some(diagnosis) = file.data.iter().find_map(DataTable::without_files) {
        return Err(diagnosis.into());
    }
    let folder = claim(arguments, FOLDER)?;
    threads::begin();
    let total = file
        .data
        .iter()
        .map(|table| table.files.len())
        .sum::<usize>();
    let line = super::progress(arguments);
    let report = |done: usize| {
        line.set_message(format!("{done} of {total} curves fitted"));
        line.tick();
    };
    let result = EachResult::new(&file, &interrupt::flag(), &report);
    line.finish_and_clear();
    if result.curves.is_empty() {
        terminal::report("stopped before the first curve was fitted; nothing is written");
        return Ok(Outcome::Stopped);
    }
    interrupt::hold();
    let mut warnings = Vec::new();
    let write = |folder: ResultsFolder| {
        folder.write(|folder| {
            warnings = files::write(folder, &result)?;
            let is_part = result.not_begun > 0;
            Ok(if is_part {
                Completeness::Part
            } else {
                Completeness::Whole
            })
        })
    };
    let written = folder.map(write).transpose()?;
    if !(arguments.quiet || arguments.json) {
        terminal::report(text::text(&result).trim_end());
        if let Some(folder) = &written {
            terminal::report(&format!("written to {}", folder.display()));
        }
    }
    if !arguments.quiet {
        warnings.extend(text::warnings(&result));
        warnings
            .iter()
            .for_each(|warning| terminal::report(&format!("warning: {warning}")));
    }
    if arguments.json {
        terminal::print(&json(&result)?)?;
    }
    outcome(arguments, &result)
}

/// The outcome of the worst curve.
fn outcome(arguments: &IdentifyArguments, result: &EachResult) -> Result<Outcome, Failure> {
    let failed = result.count(FAILED);
    if result.not_begun > 0 {
        Ok(Outcome::Stopped)
    } else if failed > 0 {
        let total = result.curves.len();
        Err(Failure::CurvesFailed { failed, total })
    } else if result.count("outside-model") + result.count("not-converged") > 0 {
        Ok(Outcome::NotConverged)
    } else if result.count("misfit") > 0 && !arguments.accept_misfit {
        Ok(Outcome::Misfit)
    } else {
        Ok(Outcome::Done)
    }
}
