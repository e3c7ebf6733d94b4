//! The command line of `cargo xtask`.

use std::ffi::OsString;

use clap::{Parser, Subcommand};

use crate::FiguresArguments;

/// The chores of the workspace.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
pub struct Arguments {
    /// The chore to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The chores.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Check the house rules of the workspace.
    Tidy,
    /// Draw the figures of the paper from its cases: SVG, PNG and CSV.
    Figures(FiguresArguments),
    /// The program `pellicle` itself, with its own command line; tests run it instead of a release build.
    #[command(hide = true, disable_help_flag = true)]
    Program {
        /// Its command line.
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<OsString>,
    },
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }
}
