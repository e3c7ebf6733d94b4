//! The runs of one program on one problem, one at a time, within its budget.

use std::path::PathBuf;
use std::process::Command;
use std::time::{Duration, Instant};

use super::contest::Contest;
use super::entrant::Entrant;
use super::process::{Ending, run_within};
use super::{Certificate, Measurement, Outcome, Row, Solved};
use crate::XtaskError;

/// A program's runs so far.
pub(super) struct Lane {
    entrant: Entrant,
    runs: Vec<Measurement>,
    /// Time of all runs, starting the process included.
    spent: Duration,
    /// Why there is no run to come and no pressure.
    end: Option<Outcome>,
}

impl Lane {
    pub(super) fn new(entrant: Entrant) -> Self {
        Self {
            entrant,
            runs: Vec::new(),
            spent: Duration::ZERO,
            end: None,
        }
    }

    /// Runs the program once more, unless that makes no sense or would break the budget; what happened, in a line.
    ///
    /// # Errors
    /// Files or processes that the system refuses.
    pub(super) fn run_once(&mut self, contest: &Contest<'_>) -> Result<Option<String>, XtaskError> {
        if contest.threads > 1 && !self.entrant.is_threaded() {
            self.end = Some(Outcome::Serial);
        }
        if self.end.is_some() || !self.has_time(contest) {
            return Ok(None);
        }
        match self.command(contest) {
            Err(reason) => self.end = Some(Outcome::Missing(reason)),
            Ok(mut command) => {
                let clock = Instant::now();
                let log = self.pressure(contest).with_extension("log");
                let ending = run_within(&mut command, self.time_left(contest), &log)?;
                self.spent += clock.elapsed();
                self.take(ending);
            }
        }
        Ok(Some(self.line()))
    }

    fn time_left(&self, contest: &Contest<'_>) -> Duration {
        contest.arguments.budget().saturating_sub(self.spent)
    }

    /// Whether a run as long as those so far would still end within the budget.
    fn has_time(&self, contest: &Contest<'_>) -> bool {
        let runs = u32::try_from(self.runs.len()).unwrap_or(u32::MAX);
        runs == 0 || self.spent / runs <= self.time_left(contest)
    }

    fn command(&self, contest: &Contest<'_>) -> Result<Command, String> {
        let pressure = self.pressure(contest);
        let Contest {
            workshop,
            problem,
            threads,
            ..
        } = *contest;
        self.entrant.command(workshop, problem, threads, &pressure)
    }

    /// Keeps what a run brought. A later run that fails or is stopped does not undo those that were good.
    fn take(&mut self, ending: Ending) {
        let end = match ending {
            Ending::Succeeded(printed) => match Measurement::parse(&printed) {
                Some(measurement) => {
                    self.runs.push(measurement);
                    return;
                }
                None => Outcome::Failed("its driver printed no measurement".to_owned()),
            },
            Ending::Failed(complaint) => Outcome::Failed(complaint),
            Ending::Stopped => Outcome::Stopped(self.spent.as_secs()),
        };
        self.end = Some(end);
    }

    /// The last event, for people.
    fn line(&self) -> String {
        let name = format!("{} at {:e}", self.entrant.name(), self.entrant.tolerance());
        match (&self.end, self.runs.last()) {
            (Some(Outcome::Stopped(seconds)), _) => format!("{name}: stopped after {seconds} s"),
            (Some(Outcome::Missing(reason)), _) => format!("{name}: missing ({reason})"),
            (Some(Outcome::Failed(reason)), _) => format!("{name}: failed ({reason})"),
            (_, Some(run)) => format!("{name}: {:.3} s", run.total_seconds()),
            (_, None) => name,
        }
    }

    /// Where its pressure is written.
    fn pressure(&self, contest: &Contest<'_>) -> PathBuf {
        let name = format!("{}-{:e}.npy", self.entrant.name(), self.entrant.tolerance());
        contest.workshop.scratch(&name)
    }

    /// The row of the table; the pressure of the last run is judged.
    ///
    /// # Errors
    /// Files or processes that the system refuses.
    pub(super) fn finish(self, contest: &Contest<'_>) -> Result<Row, XtaskError> {
        let certificate = self.certificate(contest)?;
        let entrant = self.entrant;
        let outcome = match (Solved::of(self.runs, certificate), self.end) {
            (Some(solved), _) => Outcome::Solved(Box::new(solved)),
            (None, Some(end)) => end,
            (None, None) => Outcome::Failed("it was never run".to_owned()),
        };
        Ok(Row {
            case: contest.problem.case(),
            elements: contest.problem.elements(),
            threads: contest.threads,
            program: entrant.name(),
            tolerance: entrant.tolerance(),
            outcome,
        })
    }

    /// The certificate of the last run, or why there is none.
    fn certificate(
        &self,
        contest: &Contest<'_>,
    ) -> Result<Result<Certificate, String>, XtaskError> {
        if self.runs.is_empty() {
            return Ok(Err("it has no pressure".to_owned()));
        }
        match contest.workshop.certificate() {
            Ok(command) => Certificate::judge(command, contest.problem, &self.pressure(contest)),
            Err(reason) => Ok(Err(reason)),
        }
    }
}
