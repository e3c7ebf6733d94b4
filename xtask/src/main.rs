//! The chores of the workspace on the command line: `cargo xtask tidy`, `cargo xtask figures`, `cargo xtask golden`,
//! `cargo xtask site`.

#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for people at a terminal"
)]

use std::path::Path;
use std::process::ExitCode;

use clap::Parser;
use xtask::{
    Arguments, Chore, FiguresArguments, Golden, GoldenArguments, Runner, Site, SiteArguments, Tree,
    XtaskError,
};

fn main() -> ExitCode {
    let done = match Arguments::parse().chore {
        Chore::Tidy => tidy(),
        Chore::Figures(arguments) => figures(&arguments),
        Chore::Golden(arguments) => golden(&arguments),
        Chore::Site(arguments) => site(&arguments),
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
    let runner = Runner::release(root(), arguments.elements(), |line| eprintln!("{line}"))?;
    let out = root().join(&arguments.out);
    let small = arguments.docs.then(|| root().join("docs/figures"));
    let count = xtask::figures(&arguments.figures(), &runner, &out, small.as_deref())?;
    eprintln!("{count} pictures in {}", arguments.out.display());
    Ok(ExitCode::SUCCESS)
}

/// Writes or compares the golden values; exit code 1 if any moved.
fn golden(arguments: &GoldenArguments) -> Result<ExitCode, XtaskError> {
    let program = match &arguments.program {
        Some(program) => {
            std::path::absolute(program).map_err(|cause| XtaskError::start(program, cause))?
        }
        None => xtask::release_program(root())?,
    };
    match xtask::golden(root(), &[program.into()], arguments)? {
        Golden::Written(count) => println!("{count} values in {}", arguments.file.display()),
        Golden::Compared(moved) => {
            println!("{}", moved.report(arguments.most));
            if !moved.is_same() {
                return Ok(ExitCode::FAILURE);
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// Builds the site; exit code 1 if a link of it leads nowhere.
fn site(arguments: &SiteArguments) -> Result<ExitCode, XtaskError> {
    let out = arguments.out.display();
    match xtask::site(root(), arguments)? {
        Site::Built(pages, broken) if broken.is_empty() => {
            println!("{pages} pages in {out}/book, every link leads somewhere");
        }
        Site::Built(_, broken) => {
            broken.iter().for_each(|link| eprintln!("{link}"));
            return Ok(ExitCode::FAILURE);
        }
        Site::Gathered(pages) => println!(
            "the sources of {pages} pages in {out}/source; found no mdBook to build them: cargo install mdbook"
        ),
    }
    Ok(ExitCode::SUCCESS)
}
