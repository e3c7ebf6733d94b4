//! The chores of the workspace on the command line: `cargo xtask tidy`.

#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for people at a terminal"
)]

use std::path::Path;
use std::process::ExitCode;

use xtask::{Tree, Violation, XtaskError};

const USAGE: &str = "usage: cargo xtask tidy    check the house rules of the workspace";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.as_slice() {
        [command] if command == "tidy" => tidy(),
        _ => {
            eprintln!("{USAGE}");
            ExitCode::from(2)
        }
    }
}

/// Prints what breaks a house rule; exit code 1 if anything does, 2 if the workspace cannot be read.
fn tidy() -> ExitCode {
    match violations() {
        Ok(found) if found.is_empty() => {
            println!("tidy");
            ExitCode::SUCCESS
        }
        Ok(found) => {
            for violation in &found {
                eprintln!("{violation}");
            }
            eprintln!("{} broken house rules", found.len());
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

fn violations() -> Result<Vec<Violation>, XtaskError> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    Ok(xtask::tidy(&Tree::read(&root)?))
}
