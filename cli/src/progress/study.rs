//! The progress of a study on the terminal: a line for each case being solved, and one for every finished case.

use std::sync::Mutex;
use std::time::{Duration, Instant};

use indicatif::{MultiProgress, ProgressBar};
use pellicle::Monitor;
use pellicle::display::significant;
use pellicle_contact::SolverOptions;
use pellicle_study::Study;
use pellicle_study::case_solver::CaseResult;
use pellicle_study::monitor::StudyMonitor;

use super::{ProgressLine, in_words};
use crate::{interrupt, terminal};

/// The progress lines of a study.
#[derive(Debug)]
pub struct StudyProgress {
    terminal: Option<MultiProgress>,
    total: usize,
    start: Instant,
    /// Cases done before this run, and during it.
    done: Mutex<(usize, usize)>,
}

impl StudyProgress {
    /// Returns lines for a part of `total` cases, of which `before` are done; they are hidden unless `shown`.
    #[must_use]
    pub fn new(total: usize, before: usize, shown: bool) -> Self {
        Self {
            terminal: shown.then(MultiProgress::new),
            total,
            start: Instant::now(),
            done: Mutex::new((before, 0)),
        }
    }

    /// Counts one more case. Returns the number done, the rate per second, and the time left at this rate.
    fn count(&self) -> (usize, f64, Option<Duration>) {
        let mut done = self
            .done
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        done.1 += 1;
        let (before, since) = *done;
        let to_do = self.total - before - since;
        let each = self.start.elapsed().div_f64(since as f64);
        let left = (to_do > 0).then(|| each.mul_f64(to_do as f64));
        (before + since, 1.0 / each.as_secs_f64(), left)
    }
}

impl StudyMonitor for StudyProgress {
    /// Returns the line of a case being solved.
    fn case<'a>(&'a self, study: &Study, case: usize) -> Box<dyn Monitor + 'a> {
        let line = match &self.terminal {
            Some(lines) => {
                let before = format!("case {}: ", case + 1);
                let around = [before, format!("; {}", study.words(case))];
                let tolerance = SolverOptions::default().tolerance;
                ProgressLine::on(lines.add(ProgressBar::new_spinner()), around, tolerance)
            }
            None => ProgressLine::hidden(),
        };
        Box::new(line)
    }

    /// Prints that a case has ended.
    fn ended(&self, study: &Study, case: usize, done: &CaseResult) {
        let (count, rate, left) = self.count();
        let Some(lines) = &self.terminal else {
            return;
        };
        let left = left.map_or_else(String::new, |left| {
            format!("; {}, {} left", rate_in_words(rate), in_words(left))
        });
        let (total, case_number, words) = (self.total, case + 1, study.words(case));
        let line = format!(
            "{count}/{total}  case {case_number}: {words}: {}{left}",
            done.words()
        );
        if lines.is_hidden() {
            terminal::report(&line);
        } else {
            // If the terminal is gone, the message is dropped.
            drop(lines.println(line));
        }
    }

    fn is_finishing(&self) -> bool {
        interrupt::is_finishing()
    }
}

/// Writes a number of cases per second, or per minute or hour if the rate is small.
#[must_use]
pub fn rate_in_words(rate: f64) -> String {
    let (number, time) = if rate >= 1.0 {
        (rate, "a second")
    } else if rate * 60.0 >= 1.0 {
        (rate * 60.0, "a minute")
    } else {
        (rate * 3600.0, "an hour")
    };
    format!("{} cases {time}", significant(number, 2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slow_rates_are_printed_per_minute_or_hour() {
        let words = [123.4, 1.0, 0.5, 0.001].map(rate_in_words);
        let wanted = [
            "123 cases a second",
            "1.0 cases a second",
            "30 cases a minute",
            "3.6 cases an hour",
        ];
        assert_eq!(words, wanted);
    }
}
