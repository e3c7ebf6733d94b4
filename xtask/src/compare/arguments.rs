//! What `cargo xtask compare` is asked for.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use super::{Case, Problem, Rival};
use crate::XtaskError;

/// Pellicle beside its rivals on the same problems.
#[derive(Debug, Clone, Args)]
pub struct CompareArguments {
    /// Elements per side.
    #[arg(
        long,
        value_name = "N,…",
        value_delimiter = ',',
        default_value = "512,1024,2048"
    )]
    pub sizes: Vec<usize>,
    /// Problems.
    #[arg(
        long,
        value_name = "CASE,…",
        value_delimiter = ',',
        default_value = "hertz,pillars"
    )]
    pub cases: Vec<Case>,
    /// Numbers of threads; programs that are serial run with one only.
    #[arg(long, value_name = "T,…", value_delimiter = ',', default_value = "1,2",
        value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..=1024))]
    pub threads: Vec<usize>,
    /// Rivals.
    #[arg(
        long,
        value_name = "RIVAL,…",
        value_delimiter = ',',
        default_value = "aspher,slippy,tamaas,contactmechanics"
    )]
    pub peers: Vec<Rival>,
    /// Seconds that all runs of one program on one problem may take together; then it is stopped.
    #[arg(long, value_name = "SECONDS", default_value_t = 600,
        value_parser = clap::value_parser!(u64).range(1..))]
    pub budget: u64,
    /// Runs of each program on each problem, as far as the budget goes; the median counts.
    #[arg(long, value_name = "COUNT", default_value_t = 5,
        value_parser = clap::builder::RangedU64ValueParser::<usize>::new().range(1..))]
    pub repeats: usize,
    /// Folder of the results, relative to the workspace.
    #[arg(long, value_name = "DIR", default_value = "target/compare")]
    pub out: PathBuf,
    /// Folder of the rivals' virtual environments, relative to the workspace; kept between runs.
    #[arg(
        long,
        value_name = "DIR",
        default_value = "target/compare/environments"
    )]
    pub environments: PathBuf,
    /// The Python with which environments are made.
    #[arg(long, value_name = "PROGRAM", default_value = "python3")]
    pub python: PathBuf,
}

impl CompareArguments {
    /// Every case at every size.
    ///
    /// # Errors
    /// A size that the pillars do not fit.
    pub fn problems(&self) -> Result<Vec<Problem>, XtaskError> {
        let pairs = self
            .cases
            .iter()
            .flat_map(|case| self.sizes.iter().map(|size| (*case, *size)));
        pairs.map(|(case, size)| Problem::new(case, size)).collect()
    }

    /// The budget as a duration.
    #[must_use]
    pub fn budget(&self) -> Duration {
        Duration::from_secs(self.budget)
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        compare: CompareArguments,
    }

    fn parsed(line: &str) -> Result<CompareArguments, clap::Error> {
        let words = std::iter::once("compare").chain(line.split_whitespace());
        Line::try_parse_from(words).map(|line| line.compare)
    }

    #[test]
    fn without_options_everything_is_compared() {
        let arguments = parsed("").unwrap();
        assert_eq!(arguments.sizes, [512, 1024, 2048]);
        assert_eq!(arguments.cases, [Case::Hertz, Case::Pillars]);
        assert_eq!(arguments.threads, [1, 2]);
        assert_eq!(arguments.peers, Rival::ALL);
        assert_eq!(arguments.problems().unwrap().len(), 6);
    }

    #[test]
    fn lists_are_separated_by_commas() {
        let line =
            "--sizes 64,256 --cases pillars --threads 2 --peers tamaas,aspher --budget 9 --out x";
        let arguments = parsed(line).unwrap();
        assert_eq!(arguments.sizes, [64, 256]);
        assert_eq!(arguments.peers, [Rival::Tamaas, Rival::Aspher]);
        assert_eq!(arguments.budget(), Duration::from_secs(9));
        assert_eq!(arguments.out, PathBuf::from("x"));
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        for line in [
            "--cases cone",
            "--peers nobody",
            "--threads 0",
            "--budget 0",
            "--repeats 0",
            "--sizes many",
        ] {
            assert!(parsed(line).is_err(), "{line}");
        }
        let crooked = parsed("--sizes 100").unwrap().problems();
        assert!(matches!(crooked, Err(XtaskError::Size { found: 100, .. })));
    }
}
