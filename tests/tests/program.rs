//! The command line across the crates: its numbers are those of the libraries, its validation passes and detects
//! errors. The behaviour of the program by itself is tested in `cli/tests/program`.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod library;
mod refused_allocations;
mod validate;

use std::fs;
use std::process::{Command, Stdio};

use serde_json::Value;

/// The exit code and the outputs of a run.
struct Ran {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

impl Ran {
    /// The standard output, as JSON.
    fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap()
    }
}

/// Runs the program with these arguments, beside `case.toml` with this text.
fn run(case: &str, arguments: &[&str]) -> Ran {
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
