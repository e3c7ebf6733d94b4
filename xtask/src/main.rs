//! The chores of the workspace on the command line: `cargo xtask tidy`, `cargo xtask figures`, `cargo xtask golden`.

#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for people at a terminal"
)]

use std::path::Path;
use std::process::ExitCode;

use clap::Parser;
use xtask::{
    Arguments, Chore, FiguresArguments, Golden, GoldenArguments, Runner, Tree, XtaskError,
};

fn main() -> ExitCode {
    let done = match Arguments::parse().chore {
        Chore::Tidy => tidy(),
        Chore::Figures(arguments) => figures(&arguments),
        Chore::Golden(arguments) => golden(&arguments),
        Chore::Program { arguments } => {
            let line = std::iter::once("pellicle".into()).chain(arguments);
            Ok(pellicle_cli::main(line))
        }
    };
    done.unwrap_or_else(|error| {
        eprintln!("{error}");
        ExitCode::from(2)
    })
}

/// The root of the workspace.
fn root() -> &'static Path {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.parent().unwrap_or(package)
}

/// Prints the violations of house rules; exit code 1 if there are any.
fn tidy() -> Result<ExitCode, XtaskError> {
    let found = xtask::tidy(&Tree::read(root())?);
    if found.is_empty() {
        println!("tidy");
        return Ok(ExitCode::SUCCESS);
    }
    for violation in &found {
        eprintln!("{violation}");
    }
    eprintln!("{} broken house rules", found.len());
    Ok(ExitCode::FAILURE)
}

/// Draws the paper's figures and reports progress on standard error.
fn figures(arguments: &FiguresArguments) -> Result<ExitCode, XtaskError> {
    let runner = Runner::release(root(), arguments.elements(), |line| eprintln!("{line}"));
    let out = root().join(&arguments.out);
    let small = arguments.docs.then(|| root().join("docs/figures"));
    let count = xtask::figures(&arguments.figures(), &runner, &out, small.as_deref())?;
    eprintln!("{count} pictures in {}", arguments.out.display());
    Ok(ExitCode::SUCCESS)
}

/// Writes or compares the golden numbers; exit code 1 if any moved.
fn golden(arguments: &GoldenArguments) -> Result<ExitCode, XtaskError> {
    let release = Runner::release(root(), 0, |_| {}).program;
    let program = arguments.program.clone();
    let program = program.map_or(release, |program| vec![program.into()]);
    let file = root().join(&arguments.file);
    match xtask::golden(root(), &program, &file, arguments.write)? {
        Golden::Written(count) => {
            println!("{count} values in {}", arguments.file.display());
            Ok(ExitCode::SUCCESS)
        }
        Golden::Compared(moved, count) if moved.is_empty() => {
            println!("same bits: {count} values");
            Ok(ExitCode::SUCCESS)
        }
        Golden::Compared(moved, count) => {
            moved.iter().for_each(|moved| println!("{moved}"));
            println!("{} of {count} values moved", moved.len());
            Ok(ExitCode::FAILURE)
        }
    }
}
