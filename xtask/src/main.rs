//! The chores of the workspace on the command line: `cargo xtask tidy`, `cargo xtask compare`.

#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for people at a terminal"
)]

use std::path::Path;
use std::process::ExitCode;

use clap::Parser;
use xtask::{
    Arguments, ClaimsArguments, Command, CompareArguments, FiguresArguments, PellicleArguments,
    Tree, XtaskError,
};

fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Tidy => tidy(),
        Command::Claims(arguments) => claims(&arguments),
        Command::Compare(arguments) => compare(&arguments),
        Command::Figures(arguments) => figures(&arguments),
        Command::Pellicle(arguments) => pellicle(&arguments),
        Command::Program { arguments } => {
            let line = std::iter::once("pellicle".into()).chain(arguments);
            Ok(pellicle_cli::program::main(line))
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

/// Prints what breaks a house rule; exit code 1 if anything does.
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

/// Prints every verdict, and on standard error what is solved and what changed; exit code 1 if a verdict changed.
fn claims(arguments: &ClaimsArguments) -> Result<ExitCode, XtaskError> {
    let report = xtask::claims(arguments, root(), &mut |line| eprintln!("{line}"))?;
    print!("{report}");
    eprint!("{}", report.complaints());
    Ok(report.exit_code())
}

/// Prints the table of Pellicle beside its rivals, and on standard error what is going on.
fn compare(arguments: &CompareArguments) -> Result<ExitCode, XtaskError> {
    let report = xtask::compare(arguments, root(), &mut |line| eprintln!("{line}"))?;
    print!("{report}");
    Ok(ExitCode::SUCCESS)
}

/// Draws the paper's figures, and says on standard error what is going on.
fn figures(arguments: &FiguresArguments) -> Result<ExitCode, XtaskError> {
    let count = xtask::figures(arguments, root(), &mut |line| eprintln!("{line}"))?;
    eprintln!("{count} pictures in {}", arguments.folder().display());
    Ok(ExitCode::SUCCESS)
}

/// Prints the measurement of one run of Pellicle as one line of JSON.
fn pellicle(arguments: &PellicleArguments) -> Result<ExitCode, XtaskError> {
    let measurement = xtask::run_pellicle(arguments)?;
    println!("{}", serde_json::to_string(&measurement)?);
    Ok(ExitCode::SUCCESS)
}
