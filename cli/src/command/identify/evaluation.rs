//! `pellicle identify` of a file with an `[evaluation]` alone: evaluates unloadings by Oliver and Pharr.

use pellicle::run::Completeness;
use pellicle_files::json;
use pellicle_identify::fit_file::evaluation_file::EvaluationFile;

use super::claim;
use crate::arguments::IdentifyArguments;
use crate::command::Outcome;
use crate::evaluation::{Evaluation, files, text};
use crate::failure::Failure;
use crate::{terminal, threads};

/// Evaluates the curves, writes the results and reports them.
///
/// # Errors
///
/// [`Failure`] if a measurement is wrong or the results cannot be written.
pub fn evaluate(arguments: &IdentifyArguments, file: &EvaluationFile) -> Result<Outcome, Failure> {
    if arguments.simulate {
        let reason = "an [evaluation] alone has no [model] to simulate";
        return Err(Failure::NotSimulated(reason.into()));
    }
    let folder = claim(arguments, "")?;
    threads::begin();
    let mut evaluation = Evaluation::new(file)?;
    let write = |folder: crate::results_folder::ResultsFolder| {
        folder.write(|folder| {
            files::write(folder, &mut evaluation)?;
            Ok(Completeness::Whole)
        })
    };
    let written = folder.map(write).transpose()?;
    let found = &evaluation.found;
    if !(arguments.quiet || arguments.json) {
        terminal::report(text::text(found).trim_end());
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
        terminal::print(&json(found)?)?;
    }
    let without = evaluation.curves.iter();
    let without = without.filter(|file| file.evaluated.is_err()).count();
    if without == 0 {
        return Ok(Outcome::Done);
    }
    let all = evaluation.curves.len();
    terminal::report(&format!(
        "Error: {without} of {all} curves could not be evaluated; the warnings say why"
    ));
    Ok(Outcome::NotConverged)
}
