//! What a study tells while its cases are solved, and what it asks.

use std::fmt::Debug;

use pellicle::Monitor;

use crate::Study;
use crate::case_solver::CaseResult;

/// The monitor of a study, told by all threads that solve its cases.
pub trait StudyMonitor: Debug + Sync {
    /// Returns the monitor of a case, counted from 0, that is about to be solved.
    fn case<'a>(&'a self, study: &Study, case: usize) -> Box<dyn Monitor + 'a>;

    /// Takes note of the result of a case.
    fn ended(&self, study: &Study, case: usize, done: &CaseResult);

    /// Whether no more cases may begin; those that have begun are finished, unless their monitors stop them.
    fn is_finishing(&self) -> bool;
}
