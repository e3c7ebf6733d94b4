//! Runs the program, without a cache, in its own folder.

use std::fs;
use std::process::{Command, Stdio};

use serde_json::Value;

/// The exit code and the outputs of a run.
pub struct Ran {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl Ran {
    /// The standard output, as JSON.
    pub fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap()
    }
}

/// Runs the program with these arguments, beside `case.toml` with this text.
pub fn run(case: &str, arguments: &[&str]) -> Ran {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("case.toml"), case).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_pellicle-under-test"))
        .args(arguments)
        .current_dir(folder.path())
        .env("PELLICLE_CACHE", "")
        .stdin(Stdio::null())
        .output()
        .unwrap();
    Ran {
        code: output.status.code(),
        stdout: String::from_utf8(output.stdout).unwrap(),
        stderr: String::from_utf8(output.stderr).unwrap(),
    }
}
