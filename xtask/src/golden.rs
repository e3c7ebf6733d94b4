//! Golden values: every number and every sentence that the program gives for fixed inputs, kept in one file, so that a
//! change of the code shows which of them it moves.
//!
//! The program is run as a user runs it, with its command line in a folder: all files of `cases`, the commands and the
//! faulty texts of `xtask/golden/runs.toml`, and random cases. Equal bits are expected on one kind of processor only,
//! so the file serves to compare two builds and is not part of the repository.

mod collection;
mod difference;
mod files;
mod input_list;
mod leaves;
mod outcome;
mod random_case;
mod run;
mod steady;

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Args;
use rayon::prelude::*;
use tempfile::TempDir;

pub use difference::{Comparison, Difference};
use outcome::Outcome;
use run::{Run, Starter};

use crate::XtaskError;

/// What to do with the golden values.
#[derive(Debug, Clone, Args)]
pub struct GoldenArguments {
    /// The file of golden values.
    #[arg(default_value = "target/golden.json")]
    pub file: PathBuf,
    /// Write the file anew instead of comparing with it.
    #[arg(long)]
    pub write: bool,
    /// The program to run [default: the release build of this workspace, made first].
    #[arg(long)]
    pub program: Option<PathBuf>,
    /// Run only what has a name that begins so, such as `cases/` or `random/01`.
    #[arg(long, value_name = "NAME", default_value = "")]
    pub only: String,
    /// Number of threads of each run; the values do not depend on it.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub threads: usize,
    /// Number of differences that are listed, the largest first.
    #[arg(long, value_name = "N", default_value_t = 100)]
    pub most: usize,
}

/// The result of all runs.
#[derive(Debug)]
pub enum Golden {
    /// The file was written with so many values.
    Written(usize),
    /// What moved from the values in the file.
    Compared(Comparison),
}

/// Starts `program` for every run, then writes the file or compares with it.
///
/// # Errors
/// If the program cannot be run, or a file cannot be read or written.
pub fn golden(
    root: &Path,
    program: &[OsString],
    arguments: &GoldenArguments,
) -> Result<Golden, XtaskError> {
    let file = root.join(&arguments.file);
    let known = if arguments.write {
        None
    } else {
        Some(read(&file, &arguments.only)?)
    };
    let mut runs = collection::all(root)?;
    runs.retain(|run| run.name.starts_with(&arguments.only));
    let outcomes = outcomes(&runs, program, arguments.threads)?;
    let Some(known) = known else {
        let text = outcome::to_text(&outcomes);
        fs::write(&file, text).map_err(|cause| XtaskError::write(&file, cause))?;
        return Ok(Golden::Written(outcomes.values().map(BTreeMap::len).sum()));
    };
    Ok(Golden::Compared(Comparison::of(&known, &outcomes)))
}

/// The outcome of every run, by its name.
fn outcomes(
    runs: &[Run],
    program: &[OsString],
    threads: usize,
) -> Result<BTreeMap<String, Outcome>, XtaskError> {
    let scratch = TempDir::new().map_err(|cause| XtaskError::read(&std::env::temp_dir(), cause))?;
    let starter = Starter {
        program,
        threads,
        scratch: scratch.path(),
    };
    let outcome_of = |run: &Run| Ok((run.name.clone(), starter.outcome(run)?));
    runs.par_iter().map(outcome_of).collect()
}

fn read(file: &Path, only: &str) -> Result<BTreeMap<String, Outcome>, XtaskError> {
    let text = fs::read_to_string(file).map_err(|cause| XtaskError::read(file, cause))?;
    let known = outcome::from_text(&text).map_err(|cause| XtaskError::read(file, cause.into()));
    let mut known = known?;
    known.retain(|name, _| name.starts_with(only));
    Ok(known)
}

/// Builds the program of the workspace in release and returns its path.
///
/// # Errors
/// If cargo cannot be run, or the build fails; cargo has then said why on standard error.
pub fn release_program(root: &Path) -> Result<PathBuf, XtaskError> {
    const BUILD: &str =
        "build --release --quiet --bin pellicle --message-format json-render-diagnostics";
    let cargo = PathBuf::from("cargo");
    let mut command = Command::new(&cargo);
    command.current_dir(root).args(BUILD.split(' '));
    command.stderr(std::process::Stdio::inherit());
    let built = command
        .output()
        .map_err(|cause| XtaskError::start(&cargo, cause))?;
    let messages = String::from_utf8_lossy(&built.stdout);
    let executable = |line: &str| {
        let message: serde_json::Value = serde_json::from_str(line).ok()?;
        message["executable"].as_str().map(PathBuf::from)
    };
    let made = messages.lines().filter_map(executable).next_back();
    made.filter(|_| built.status.success())
        .ok_or(XtaskError::NotBuilt)
}
