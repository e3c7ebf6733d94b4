//! One problem with one number of threads: all programs take turns, so that whatever else the machine does hits them
//! alike.

use super::entrant::Entrant;
use super::lane::Lane;
use super::row::relate;
use super::workshop::Workshop;
use super::{CompareArguments, Problem, Row};
use crate::XtaskError;

/// All programs on one problem.
pub(super) struct Contest<'a> {
    pub(super) problem: Problem,
    pub(super) threads: usize,
    pub(super) arguments: &'a CompareArguments,
    pub(super) workshop: &'a Workshop,
}

impl Contest<'_> {
    /// Runs every program in turn, as often as asked for; Pellicle's row is the first.
    ///
    /// # Errors
    /// Files or processes that the system refuses.
    pub(super) fn run(&self, tell: &mut dyn FnMut(&str)) -> Result<Vec<Row>, XtaskError> {
        let entrants = Entrant::all(&self.arguments.peers);
        let mut lanes: Vec<Lane> = entrants.into_iter().map(Lane::new).collect();
        for round in 1..=self.arguments.repeats {
            for lane in &mut lanes {
                if let Some(line) = lane.run_once(self)? {
                    tell(&format!("{}, run {round}: {line}", self.title()));
                }
            }
        }
        let rows = lanes.into_iter().map(|lane| lane.finish(self));
        let mut rows = rows.collect::<Result<Vec<_>, _>>()?;
        relate(&mut rows);
        Ok(rows)
    }

    fn title(&self) -> String {
        let (case, elements) = (self.problem.case(), self.problem.elements());
        format!("{case}, n = {elements}, threads = {}", self.threads)
    }
}
