//! Golden numbers: everything that the program computes from fixed inputs, kept in one file, so that a change of the
//! code shows which numbers it moves.
//!
//! The program is run as a user would run it: all files of `cases`, the validation, the fits and the study of
//! `xtask/golden`, and random cases. Equal bits are expected on one kind of processor only, so the file serves to
//! compare two builds, not as a test.

mod difference;
mod outcome;
mod random_case;
mod run;

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;
use rayon::prelude::*;
use tempfile::TempDir;

pub use difference::Difference;
use outcome::Outcome;
use run::Run;

use crate::XtaskError;

/// Number of random cases.
const RANDOM_CASES: u64 = 300;

/// What to do with the golden numbers.
#[derive(Debug, Args)]
pub struct GoldenArguments {
    /// The file of golden numbers.
    #[arg(default_value = "target/golden.json")]
    pub file: PathBuf,
    /// Write the file anew instead of comparing with it.
    #[arg(long)]
    pub write: bool,
    /// The program to run [default: the release build, made first].
    #[arg(long)]
    pub program: Option<PathBuf>,
}

/// The result of a run over everything.
#[derive(Debug)]
pub enum Golden {
    /// The file was written with so many numbers.
    Written(usize),
    /// The differences from the file, and how many numbers were compared.
    Compared(Vec<Difference>, usize),
}

/// Runs everything with `program`, then writes the file or compares with it.
///
/// # Errors
/// If the program cannot be run, or the file cannot be read or written.
pub fn golden(
    root: &Path,
    program: &[OsString],
    file: &Path,
    write: bool,
) -> Result<Golden, XtaskError> {
    let scratch = TempDir::new().map_err(|cause| XtaskError::read(&std::env::temp_dir(), cause))?;
    let runs = run::all(root, scratch.path(), RANDOM_CASES)?;
    let outcome_of = |run: &Run| Ok((run.name.clone(), run.outcome(root, program)?));
    let outcomes: Result<BTreeMap<String, Outcome>, XtaskError> =
        runs.par_iter().map(outcome_of).collect();
    let outcomes = outcomes?;
    let count = outcomes.values().map(Outcome::count).sum();
    if write {
        fs::write(file, outcome::to_text(&outcomes))
            .map_err(|cause| XtaskError::write(file, cause))?;
        return Ok(Golden::Written(count));
    }
    let text = fs::read_to_string(file).map_err(|cause| XtaskError::read(file, cause))?;
    let known = outcome::from_text(&text).map_err(|cause| XtaskError::read(file, cause.into()))?;
    Ok(Golden::Compared(
        difference::differences(&known, &outcomes),
        count,
    ))
}
