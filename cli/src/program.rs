//! From the command line to the exit code.

use std::ffi::OsString;
use std::process::ExitCode;

use clap::Parser;

use crate::arguments::{Arguments, Command};
use crate::failure::Failure;
use crate::{command, interrupt, terminal};

/// How a command ended that did not fail.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// Everything asked for is there, and certified where it is a solution.
    Done,
    /// The result is there, and marked as not converged or cut off; in a study, a case has no certified result.
    NotConverged,
    /// The program disagrees with what is known: a row of its validation fails.
    Refuted,
    /// The user asked to stop; what was finished is there.
    Stopped,
}

/// Runs the program with these arguments, the first being its name.
pub fn main(arguments: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> ExitCode {
    interrupt::listen();
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => return usage(&error),
    };
    match execute(arguments.command) {
        // Who asks to stop is told so, even if all was done when it was heard.
        Ok(_) if interrupt::is_requested() => ExitCode::from(interrupt::EXIT_CODE),
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::NotConverged | Outcome::Refuted) => ExitCode::from(1),
        Ok(Outcome::Stopped) => ExitCode::from(interrupt::EXIT_CODE),
        Err(failure) => {
            terminal::tell_drawn(&failure.render());
            ExitCode::from(failure.exit_code())
        }
    }
}

fn execute(command: Command) -> Result<Outcome, Failure> {
    match command {
        Command::Run(arguments) => command::run::run(&arguments),
        Command::Check(arguments) => command::check::check(&arguments),
        Command::Init(arguments) => command::init::init(&arguments),
        Command::Kernel(arguments) => command::kernel::kernel(&arguments),
        Command::Influence(arguments) => command::influence::influence(&arguments),
        Command::Plot(arguments) => command::plot::plot(&arguments),
        Command::Cache(arguments) => command::cache::cache(&arguments),
        Command::Study(arguments) => command::study::study(&arguments),
        Command::Gather(arguments) => command::gather::gather(&arguments),
        Command::Validate(arguments) => command::validate::validate(&arguments),
        Command::Completions(arguments) => command::completions::completions(&arguments),
        Command::Man => command::completions::man(),
    }
}

/// Help and version go to standard output, a wrong command line to standard error.
fn usage(error: &clap::Error) -> ExitCode {
    // Nobody is left to tell if the terminal is gone.
    drop(error.print());
    ExitCode::from(if error.use_stderr() { 2 } else { 0 })
}
