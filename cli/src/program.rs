//! From the command line to the exit code.

use std::ffi::OsString;
use std::process::ExitCode;

use clap::Parser;

use crate::arguments::{Arguments, Command};
use crate::command::Outcome;
use crate::failure::Failure;
use crate::{arena, command, interrupt, terminal, withdrawn};

/// Runs the program with these arguments, the first being its name.
pub fn main(arguments: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> ExitCode {
    arena::share();
    interrupt::listen();
    let arguments = arguments
        .into_iter()
        .map(|argument| marked_as_value(argument.into()));
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => return usage(&error),
    };
    match execute(arguments.command) {
        // A request to stop is reported even if everything was done by then.
        Ok(_) if interrupt::is_requested() => ExitCode::from(interrupt::EXIT_CODE),
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::NotConverged | Outcome::Refuted) => ExitCode::from(1),
        Ok(Outcome::Misfit) => ExitCode::from(3),
        Ok(Outcome::Stopped) => ExitCode::from(interrupt::EXIT_CODE),
        Err(failure) => {
            terminal::report_coloured(&failure.render());
            ExitCode::from(failure.exit_code())
        }
    }
}

/// Puts a space before a negative number such as `-1,2`, which clap would take for an option. The parsers of values
/// ignore the space, and no option begins with a digit.
fn marked_as_value(argument: OsString) -> OsString {
    let text = argument.to_string_lossy();
    let is_number =
        text.starts_with('-') && text[1..].starts_with(|c: char| c.is_ascii_digit() || c == '.');
    if is_number {
        format!(" {text}").into()
    } else {
        argument
    }
}

fn execute(command: Command) -> Result<Outcome, Failure> {
    match command {
        Command::Run(arguments) => command::run::run(&arguments),
        Command::Explore(arguments) => command::explore::explore(&arguments),
        Command::Check(arguments) => command::check::check(&arguments),
        Command::Init(arguments) => command::init::init(&arguments),
        Command::Kernel(arguments) => command::kernel::kernel(&arguments),
        Command::Influence(arguments) => command::influence::influence(&arguments),
        Command::Stress(arguments) => command::stress::stress(&arguments),
        Command::Surface(arguments) => command::surface::surface(&arguments),
        Command::Identify(arguments) if arguments.each => command::identify::each::each(&arguments),
        Command::Identify(arguments) if arguments.plan => command::identify::plan::plan(&arguments),
        Command::Identify(arguments) => command::identify::identify(&arguments),
        Command::Plot(arguments) => command::plot::plot(&arguments),
        Command::Cache(arguments) => command::cache::cache(&arguments),
        Command::Solve(arguments) => command::solve::solve(&arguments),
        Command::Study(arguments) if arguments.find.is_some() => command::find::find(&arguments),
        Command::Study(arguments) => command::study::study(&arguments),
        Command::Gather(arguments) => command::gather::gather(&arguments),
        Command::Validate(arguments) => command::validate::validate(&arguments),
        Command::Completions(arguments) => command::completions::completions(&arguments),
        Command::Man => command::completions::man(),
    }
}

/// Prints help and version to standard output, a wrong command line to standard error.
fn usage(error: &clap::Error) -> ExitCode {
    if let Some(sentence) = withdrawn::on_the_command_line(error) {
        terminal::report(&format!("Error: {sentence}"));
        return ExitCode::from(2);
    }
    // If the terminal is gone, the failure cannot be reported.
    drop(error.print());
    ExitCode::from(if error.use_stderr() { 2 } else { 0 })
}

#[cfg(test)]
mod refused_changes;
