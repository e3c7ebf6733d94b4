//! The program that solves the cases: the release build of `pellicle`.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::XtaskError;

/// The package and the name of the executable.
const PACKAGE: &str = "pellicle-cli";
const NAME: &str = "pellicle";

/// A program that takes the command line of `pellicle`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Program {
    executable: PathBuf,
    first_arguments: Vec<String>,
    digest: String,
}

impl Program {
    /// An executable, with the arguments that stand before those of `pellicle`.
    ///
    /// # Errors
    /// [`XtaskError::Read`] if the executable cannot be read: its digest tells its results from those of another.
    pub fn at(executable: &Path, first_arguments: &[&str]) -> Result<Self, XtaskError> {
        let bytes = fs::read(executable).map_err(|source| XtaskError::Read {
            path: executable.into(),
            source,
        })?;
        Ok(Self {
            executable: executable.into(),
            first_arguments: first_arguments.iter().map(ToString::to_string).collect(),
            digest: blake3::hash(&bytes).to_hex().to_string(),
        })
    }

    /// Builds `pellicle` of the workspace at `root` in release; cargo puts it where its settings say.
    ///
    /// # Errors
    /// [`XtaskError::Start`] without cargo, [`XtaskError::Build`] if the build fails.
    pub fn build(root: &Path) -> Result<Self, XtaskError> {
        let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let built = Command::new(&cargo)
            .current_dir(root)
            .args(["build", "--release", "--package", PACKAGE])
            .args(["--bin", NAME, "--message-format=json-render-diagnostics"])
            .stderr(Stdio::inherit())
            .output()
            .map_err(|source| XtaskError::Start {
                program: cargo.into(),
                source,
            })?;
        let messages = String::from_utf8_lossy(&built.stdout);
        match executable(&messages) {
            Some(executable) if built.status.success() => Self::at(&executable, &[]),
            _ => Err(XtaskError::Build {
                package: PACKAGE,
                status: built.status,
            }),
        }
    }

    /// A command of this program, its arguments yet to be added.
    #[must_use]
    pub fn command(&self) -> Command {
        let mut command = Command::new(&self.executable);
        command.args(&self.first_arguments);
        command
    }

    /// A digest of the executable.
    #[must_use]
    pub fn digest(&self) -> &str {
        &self.digest
    }

    /// The executable, for messages.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.executable
    }
}

/// The executable that cargo's messages name, one JSON object a line.
fn executable(messages: &str) -> Option<PathBuf> {
    let messages = messages.lines().rev();
    let mut messages = messages.filter_map(|line| serde_json::from_str::<Value>(line).ok());
    messages.find_map(|message| {
        let is_program = message["target"]["name"] == NAME;
        let executable = message["executable"].as_str().filter(|_| is_program)?;
        Some(executable.into())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_executable_is_the_one_that_cargo_names() {
        let messages = "{\"target\":{\"name\":\"pellicle_cli\"},\"executable\":null}\n\
                        {\"target\":{\"name\":\"pellicle\"},\"executable\":\"there/pellicle\"}\n\
                        {\"reason\":\"build-finished\"}\n";
        assert_eq!(executable(messages), Some("there/pellicle".into()));
        assert_eq!(executable("{\"reason\":\"build-finished\"}"), None);
    }

    #[test]
    fn another_executable_has_another_digest() {
        let folder = tempfile::tempdir().unwrap();
        let program = |bytes: &[u8]| {
            let path = folder.path().join("program");
            fs::write(&path, bytes).unwrap();
            Program::at(&path, &[]).unwrap()
        };
        assert_ne!(program(b"1").digest(), program(b"2").digest());
    }

    #[test]
    fn an_executable_that_is_not_there_is_an_error() {
        let missing = Program::at(Path::new("nowhere/pellicle"), &[]);
        assert!(matches!(missing, Err(XtaskError::Read { .. })));
    }
}
