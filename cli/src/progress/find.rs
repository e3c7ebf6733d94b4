//! The progress of a search on the terminal: a line for the case being solved, and one for every case tried.

use indicatif::ProgressBar;
use pellicle::Monitor;
use pellicle_contact::SolverOptions;
use pellicle_study::find::SearchMonitor;

use super::ProgressLine;
use crate::terminal;

/// The progress lines of a search.
#[derive(Debug)]
pub struct SearchProgress<'a> {
    /// The key that is searched.
    key: &'a str,
    is_shown: bool,
}

impl<'a> SearchProgress<'a> {
    /// Returns the lines of a search for a value of this key; they are hidden unless `is_shown`.
    #[must_use]
    pub fn new(key: &'a str, is_shown: bool) -> Self {
        Self { key, is_shown }
    }
}

impl SearchMonitor for SearchProgress<'_> {
    fn case<'a>(&'a self, number: usize, value: &str) -> Box<dyn Monitor + 'a> {
        if !self.is_shown {
            return Box::new(ProgressLine::hidden());
        }
        let around = [
            format!("case {}: ", number + 1),
            format!("; {} = {value}", self.key),
        ];
        let tolerance = SolverOptions::default().tolerance;
        Box::new(ProgressLine::on(
            ProgressBar::new_spinner(),
            around,
            tolerance,
        ))
    }

    fn ended(&self, number: usize, value: &str, outcome: &str) {
        if self.is_shown {
            let case = number + 1;
            terminal::report(&format!("case {case}: {} = {value}: {outcome}", self.key));
        }
    }
}
