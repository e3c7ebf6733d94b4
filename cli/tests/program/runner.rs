//! Runs the binary in its own folder.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;

/// A small valid case; every test of an invalid one changes one thing in it.
pub const CASE: &str = r#"title = "Test"

[foundation]
substrate = { young_modulus = "7 GPa", poisson_ratio = 0.4 }

[[foundation.layer]]
thickness = "10 nm"
young_modulus = "70 GPa"
poisson_ratio = 0.3

[surface]
kind = "cylinders"
radius = "20 nm"
height = "2 nm"
period = "50 nm"

[indenter]
kind = "paraboloid"
radius = "4 um"

[load]
force = "1 uN"

[grid]
side = "400 nm"
elements = 32
"#;

/// A folder to run the program in.
pub struct TestFolder(TempDir);

/// Exit code and output of the program.
pub struct ProgramOutput {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl From<Output> for ProgramOutput {
    fn from(output: Output) -> Self {
        let Output {
            status,
            stdout,
            stderr,
        } = output;
        Self {
            code: status.code(),
            stdout: String::from_utf8(stdout).unwrap(),
            stderr: String::from_utf8(stderr).unwrap(),
        }
    }
}

impl ProgramOutput {
    /// Returns the standard output of a run that succeeded, as JSON.
    pub fn json(&self) -> Value {
        assert_eq!(self.code, Some(0), "{}", self.stderr);
        self.printed()
    }

    /// Returns the standard output as JSON, whatever the exit code.
    pub fn printed(&self) -> Value {
        let found = serde_json::from_str(&self.stdout);
        found.unwrap_or_else(|error| panic!("{error}: {}", self.stderr))
    }
}

impl TestFolder {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// Returns a folder with this text as `case.toml`.
    pub fn with_case(text: impl AsRef<[u8]>) -> Self {
        let folder = Self::new();
        fs::write(folder.path("case.toml"), text).unwrap();
        folder
    }

    /// Returns such a folder with this text as `many.toml`.
    pub fn with_study(case: impl AsRef<[u8]>, study: &str) -> Self {
        let folder = Self::with_case(case);
        fs::write(folder.path("many.toml"), study).unwrap();
        folder
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Returns the summary of the run in this results folder.
    pub fn summary(&self, results: &str) -> Value {
        let text = fs::read_to_string(self.path(results).join("summary.json")).unwrap();
        serde_json::from_str(&text).unwrap()
    }

    /// Returns the names of everything in the folder, hidden or not.
    pub fn names(&self) -> Vec<String> {
        names(self.0.path())
    }

    /// Returns a command for the program without a cache on disk.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_pellicle"));
        command
            .args(arguments)
            .current_dir(self.0.path())
            .env("PELLICLE_CACHE", "")
            .stdin(Stdio::null());
        command
    }

    pub fn run(&self, arguments: &[&str]) -> ProgramOutput {
        Self::ran(&mut self.command(arguments))
    }

    /// Runs the study `many.toml`.
    pub fn study(&self, more: &[&str]) -> ProgramOutput {
        self.run(&[&["study", "many.toml", "--quiet"], more].concat())
    }

    pub fn ran(command: &mut Command) -> ProgramOutput {
        command.output().unwrap().into()
    }

    /// The same with standard output redirected.
    #[cfg(target_os = "linux")]
    pub fn ran_with_stdout(command: &mut Command, stdout: impl Into<Stdio>) -> ProgramOutput {
        let child = command.stdout(stdout).stderr(Stdio::piped()).spawn();
        child.unwrap().wait_with_output().unwrap().into()
    }
}

/// Names of everything in a folder, in order.
pub fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// The keys of a table, in order.
pub fn keys(value: &Value) -> Vec<&str> {
    let table = value.as_object().unwrap();
    table.keys().map(String::as_str).collect()
}
