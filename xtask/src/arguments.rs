//! The command line of `cargo xtask`.

use std::ffi::OsString;

use clap::{Parser, Subcommand};

use crate::{ClaimsArguments, CompareArguments, FiguresArguments, PellicleArguments};

/// The chores of the workspace.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The chores.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Check the house rules of the workspace.
    Tidy,
    /// Compute what becomes of each claim of the paper and compare it with what is recorded; exit code 1 if one changed.
    Claims(ClaimsArguments),
    /// Run Pellicle and its rivals on the same problems and print the table.
    Compare(CompareArguments),
    /// Draw the figures of the paper from its cases: SVG, PNG and CSV.
    Figures(FiguresArguments),
    /// One run of Pellicle for `compare`, which times it in a process of its own.
    #[command(hide = true)]
    Pellicle(PellicleArguments),
    /// The program `pellicle` itself, with its own command line: what the tests run instead of a release build.
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
    use crate::Case;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn pellicles_run_takes_what_every_driver_takes() {
        let line = "xtask pellicle pillars 512 2 1e-8 out.npy";
        let Command::Pellicle(run) = Arguments::parse_from(line.split(' ')).command else {
            panic!("another command");
        };
        assert_eq!(
            (run.case, run.elements, run.threads),
            (Case::Pillars, 512, 2)
        );
        assert_eq!(run.tolerance.to_string(), "0.00000001");
    }
}
