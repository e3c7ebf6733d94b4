//! The command line of `cargo xtask`.

use std::ffi::OsString;

use clap::{Parser, Subcommand};

use crate::{FiguresArguments, GoldenArguments, SiteArguments};

/// The chores of the workspace.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
pub struct Arguments {
    /// The chore to do.
    #[command(subcommand)]
    pub chore: Chore,
}

/// The chores.
#[derive(Debug, Subcommand)]
pub enum Chore {
    /// Check the house rules of the workspace.
    Tidy,
    /// Draw the figures of the paper from its cases: SVG, PNG and CSV.
    Figures(FiguresArguments),
    /// Run everything and compare what it gives with what an earlier build gave.
    Golden(GoldenArguments),
    /// Build the documents as a site with mdBook, and check its links.
    Site(SiteArguments),
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
    use std::path::Path;

    use clap::{CommandFactory, ValueEnum};

    use super::*;
    use crate::Figure;

    fn figures(line: &str) -> Result<FiguresArguments, clap::Error> {
        let words = format!("xtask figures {line}");
        let parsed = Arguments::try_parse_from(words.split_whitespace())?;
        let Chore::Figures(arguments) = parsed.chore else {
            panic!("{line}: not read as figures");
        };
        Ok(arguments)
    }

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn without_options_all_figures_are_drawn_at_full_resolution() {
        let arguments = figures("").unwrap();
        assert_eq!(arguments.figures(), Figure::value_variants());
        assert_eq!(arguments.elements(), 1024);
    }

    #[test]
    fn figures_can_be_chosen_and_come_in_order() {
        let arguments = figures("--only 6,4 --only 4 --quick").unwrap();
        assert_eq!(arguments.figures(), [Figure::Four, Figure::Six]);
        assert_eq!(arguments.elements(), 256);
        assert_eq!(arguments.out, Path::new("target/paper/quick"));
        let elsewhere = figures("--quick --out here").unwrap();
        assert_eq!(elsewhere.out, Path::new("here"));
    }

    #[test]
    fn coarse_pictures_never_replace_those_of_the_documents() {
        assert!(figures("--quick --docs").is_err());
    }
}
