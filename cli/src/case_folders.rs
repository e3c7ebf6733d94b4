//! Results folders of a study's cases, as `pellicle study --folders` writes them.

use std::fs;
use std::io;
use std::path::Path;
use std::time::Instant;

use pellicle::Completeness;
use pellicle::case::Case;
use pellicle::case::output::OutputCase;
use pellicle::summary::RunSummary;
use pellicle_contact::LoadingPath;
use pellicle_files::whole::Existing;
use pellicle_study::StudyError;
use pellicle_study::case_folder::{CaseFolder, CaseFolders};
use serde_json::Value;

use crate::failure::Failure;
use crate::output::results;
use crate::results_folder::ResultsFolder;
use crate::results_folder::own_files;

/// The results folders of the cases.
#[derive(Debug, Clone, Copy)]
pub struct ResultsFolders;

impl CaseFolders for ResultsFolders {
    fn claim(&self, folder: &Path, case: &Case) -> Result<Box<dyn CaseFolder>, StudyError> {
        if own_files::case_in(folder).is_some_and(|written| !is_of(&written, case)) {
            let path = folder.to_owned();
            return Err(StudyError::OtherCase { path });
        }
        let claimed = ResultsFolder::claim(folder, Existing::Replace);
        Ok(Box::new(claimed.map_err(of_study)?))
    }
}

impl CaseFolder for ResultsFolder {
    fn write(
        self: Box<Self>,
        path: &LoadingPath,
        summary: &mut RunSummary,
        case: &Case,
        start: Instant,
    ) -> Result<Completeness, StudyError> {
        let mut completeness = Completeness::Whole;
        let written = ResultsFolder::write(*self, |folder| {
            completeness = results::write(folder, path, summary, case, start, &|_, _| ())?;
            Ok(completeness)
        });
        written.map_err(of_study)?;
        Ok(completeness)
    }
}

/// The failure as an error of the study.
fn of_study(failure: Failure) -> StudyError {
    match failure {
        Failure::Case(error) => StudyError::Case(error),
        Failure::File(error) => StudyError::File(error),
        Failure::Study(error) => error,
        other => StudyError::CaseFolder(Box::new(other)),
    }
}

/// Removes the results of another study's cases from their folder, and nothing else.
///
/// # Errors
///
/// An error of the system if a file cannot be removed.
pub fn discard_cases(cases: &Path) -> io::Result<()> {
    let entries = fs::read_dir(cases).into_iter().flatten().flatten();
    for case in entries.map(|entry| entry.path()) {
        if own_files::case_in(&case).is_some()
            && own_files::not_written(&case).is_none()
            && !case.is_symlink()
        {
            own_files::remove(&case)?;
        }
    }
    Ok(())
}

/// Whether the case of a summary is this one. The summary always has a domain side, even if the case leaves it open;
/// the choice of files is ignored.
fn is_of(written: &Value, case: &Case) -> bool {
    let mut case = case.clone();
    if let Some(side) = written["grid"]["side"].as_f64() {
        case.grid.take_side(side);
    }
    let without_output = |mut case: Value| {
        OutputCase::leave_out_files(&mut case);
        case
    };
    let case = serde_json::to_value(case).map(without_output);
    case.is_ok_and(|case| case == without_output(written.clone()))
}
