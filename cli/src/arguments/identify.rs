//! Arguments of `pellicle identify`.

use std::path::PathBuf;

use clap::Args;

/// Arguments of `identify`.
#[derive(Debug, Args)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a switch of the command line"
)]
pub struct IdentifyArguments {
    /// The fit file
    #[arg(value_name = "FIT")]
    pub path: PathBuf,
    /// Folder of the results [default: results/NAME after the fit file, with --plan results/NAME-plan, with --each
    /// results/NAME-each, numbered if that exists; none with --json]; with --simulate the file to write
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace the results in an existing folder
    #[arg(long)]
    pub force: bool,
    /// Print the intervals that the design of the fit file would give, in place of a fit; needs no data
    #[arg(long, conflicts_with_all = ["simulate", "accept_misfit"])]
    pub plan: bool,
    /// Fit each curve alone, in place of a fit of all: a table, and a map where the files state positions
    #[arg(long, conflicts_with_all = ["plan", "simulate"])]
    pub each: bool,
    /// Write measurements that the fit file would give, from the values of its model and its noise, in place of a fit
    #[arg(long, requires = "out", conflicts_with_all = ["json", "accept_misfit"])]
    pub simulate: bool,
    /// Seed of the noise of --simulate [default: that of the fit file]
    #[arg(long, value_name = "N", requires = "simulate")]
    pub seed: Option<u64>,
    /// Accept a misfit as a result: exit code 0 in place of 3
    #[arg(long)]
    pub accept_misfit: bool,
    /// Print the result as JSON to standard output and nothing else; write a folder only with --out
    #[arg(long)]
    pub json: bool,
    /// Number of threads [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Print nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}
