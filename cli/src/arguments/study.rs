//! Arguments of `pellicle study`, and of `pellicle gather`, which merges its parts.

use std::path::PathBuf;

use clap::Args;
use pellicle_study::find::WITHIN;

use super::values::part;
use super::wanted_shard::WantedShard;

/// Arguments of `study`.
#[derive(Debug, Args)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a switch of the command line"
)]
pub struct StudyArguments {
    /// The study file; with --find a case file
    #[arg(value_name = "STUDY")]
    pub path: PathBuf,
    /// Find the largest value of the key --by up to which a condition holds, or the smallest from which it holds:
    /// --find "max pressure < 2 GPa". The number is that of the last loading step, by its key in docs/results.md or its
    /// name in tables; a file of a case stands in place of the study
    #[arg(long, value_name = "CONDITION", requires = "by",
        conflicts_with_all = ["shard", "tolerate_failures", "status", "report", "folders"])]
    pub find: Option<String>,
    /// The key that --find varies, such as surface.period
    #[arg(long, value_name = "KEY", requires = "find")]
    pub by: Option<String>,
    /// The range of its values [default: a decade down and up from that of the case, as far as the case allows]
    #[arg(long, value_names = ["LOW", "HIGH"], num_args = 2, requires = "find", allow_hyphen_values = true)]
    pub between: Vec<String>,
    /// Bracket the answer to this part of it
    #[arg(long, value_name = "PART", requires = "find", value_parser = part,
        default_value_t = WITHIN, hide_default_value = false)]
    pub within: f64,
    /// Replace one value of the base case: --set grid.elements=64 (repeatable)
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub sets: Vec<String>,
    /// Results folder [default: results/NAME after the study]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Start afresh and discard the results in the folder, of this study or another
    #[arg(long)]
    pub fresh: bool,
    /// Solve only part I of N, from 1, or `auto`, the part of this Slurm task; `pellicle gather` merges the parts
    #[arg(
        long,
        value_name = "I/N",
        default_value = "1/1",
        hide_default_value = true
    )]
    pub shard: WantedShard,
    /// Exit with 0 even if some cases are not certified or fail
    #[arg(long)]
    pub tolerate_failures: bool,
    /// Print the cases and solve none
    #[arg(long)]
    pub list: bool,
    /// Print the progress of the study over all its parts, with the rate and the time left, and solve nothing
    #[arg(long, conflicts_with_all = ["list", "fresh", "folders"])]
    pub status: bool,
    /// Write report.html of the cases done so far, over all parts, and solve nothing
    #[arg(long, conflicts_with_all = ["list", "status", "fresh", "folders"])]
    pub report: bool,
    /// Also write a results folder for every case, in cases/
    #[arg(long)]
    pub folders: bool,
    /// Print the number of cases by status as JSON to standard output
    #[arg(long)]
    pub json: bool,
    /// Number of threads, and of cases solved at a time [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Print nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

/// Arguments of `gather`.
#[derive(Debug, Args)]
pub struct GatherArguments {
    /// The folder of the study
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Replace the merged table of another study
    #[arg(long)]
    pub force: bool,
}
