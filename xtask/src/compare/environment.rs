//! A virtual environment of Python for one program, since the rivals' requirements exclude each other.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use super::process::{Ending, run_within};
use crate::XtaskError;

/// Whether a program could be installed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Environment {
    /// Yes: its Python.
    Ready(PathBuf),
    /// No: why.
    Missing(String),
}

/// The longest that one installation may take; those built from source need minutes.
const PATIENCE: Duration = Duration::from_mins(30);
/// Kept in an environment that is complete: what was asked for.
const MARK: &str = "requirements.txt";

impl Environment {
    /// The environment `folder`, made with `python` and filled by one `pip install` for each list of `requirements`;
    /// one that is complete already is used as it is.
    ///
    /// # Errors
    /// A folder or log that cannot be written. What cannot be installed is [`Environment::Missing`].
    pub(super) fn prepare(
        folder: &Path,
        python: &Path,
        requirements: &[&[&str]],
    ) -> Result<Self, XtaskError> {
        let inside = folder
            .join(if cfg!(windows) { "Scripts" } else { "bin" })
            .join("python");
        let wanted = listed(requirements);
        if fs::read_to_string(folder.join(MARK)).is_ok_and(|found| found == wanted) {
            return Ok(Self::Ready(inside));
        }
        let log = folder.with_extension("log");
        let name = folder.file_stem().unwrap_or_default().display();
        create_folder(folder.parent().unwrap_or(folder))?;
        for command in &mut commands(folder, python, &inside, requirements) {
            if let Some(reason) = failure(command, &log)? {
                return Ok(Self::Missing(format!("{reason} (whole log: {name}.err)")));
            }
        }
        write(&folder.join(MARK), &wanted)?;
        Ok(Self::Ready(inside))
    }
}

/// One line for each invocation of pip.
fn listed(requirements: &[&[&str]]) -> String {
    let lines = requirements.iter().map(|list| list.join(" ") + "\n");
    lines.collect()
}

/// A new environment, then the installations in it.
fn commands(folder: &Path, python: &Path, inside: &Path, requirements: &[&[&str]]) -> Vec<Command> {
    let mut create = Command::new(python);
    create.args(["-m", "venv", "--clear"]).arg(folder);
    let install = |list: &&[&str]| {
        let mut install = Command::new(inside);
        install
            .args(["-m", "pip", "install", "--no-input"])
            .args(*list);
        install
    };
    std::iter::once(create)
        .chain(requirements.iter().map(install))
        .collect()
}

/// Why a command of an installation failed; none if it did not.
fn failure(command: &mut Command, log: &Path) -> Result<Option<String>, XtaskError> {
    match run_within(command, PATIENCE, log) {
        Ok(Ending::Succeeded(_)) => Ok(None),
        Ok(Ending::Failed(complaint)) => Ok(Some(complaint)),
        Ok(Ending::Stopped) => Ok(Some(format!(
            "not installed after {} s",
            PATIENCE.as_secs()
        ))),
        Err(error @ XtaskError::Start { .. }) => Ok(Some(error.to_string())),
        Err(error) => Err(error),
    }
}

/// Creates a folder and those above it.
pub(super) fn create_folder(folder: &Path) -> Result<(), XtaskError> {
    fs::create_dir_all(folder).map_err(|source| XtaskError::Write {
        path: folder.into(),
        source,
    })
}

/// Writes a file whole or not at all.
pub(super) fn write(path: &Path, text: &str) -> Result<(), XtaskError> {
    let unwritable = |source| XtaskError::Write {
        path: path.into(),
        source,
    };
    let draft = path.with_extension("part");
    fs::write(&draft, text).map_err(unwritable)?;
    fs::rename(&draft, path).map_err(unwritable)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_environment_without_python_is_missing_and_says_why() {
        let folder = tempfile::tempdir().unwrap();
        let python = folder.path().join("no-python");
        let prepared = Environment::prepare(&folder.path().join("env"), &python, &[]).unwrap();
        let Environment::Missing(reason) = prepared else {
            panic!("{prepared:?}");
        };
        assert!(reason.contains("no-python"), "{reason}");
    }

    #[test]
    fn a_complete_environment_is_used_again_and_one_for_other_requirements_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let no_python = folder.path().join("no-python");
        write(&folder.path().join(MARK), "numpy==1 scipy\n--no-deps x\n").unwrap();
        let prepare =
            |lists: &[&[&str]]| Environment::prepare(folder.path(), &no_python, lists).unwrap();
        let same = prepare(&[&["numpy==1", "scipy"], &["--no-deps", "x"]]);
        assert!(matches!(same, Environment::Ready(_)));
        let other = prepare(&[&["numpy==2"]]);
        assert!(matches!(other, Environment::Missing(_)));
    }
}
