//! A fit file fitted, and its design planned, as the command and the Python package do it.

use std::time::Instant;

use pellicle_identify::{Fit, StopFlag};

use crate::failure::Failure;
use crate::fit_file::FitFile;
use crate::identification::result::FitResult;
use crate::identification::{Identification, tables};
use crate::planning::after_fit::Next;
use crate::planning::candidate::{POINTS, candidates};
use crate::planning::premises::Premises;
use crate::planning::result::PlanResult;
use crate::planning::{Planning, table};

/// How far a fit or a plan is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// So many predictions of all curves are made.
    Solved(usize),
    /// So many curves of the design are judged.
    Planned(usize),
}

/// A fit file fitted.
#[derive(Debug)]
pub struct FittedFile {
    /// The problem.
    pub identification: Identification,
    /// The fit.
    pub fit: Fit,
    /// What it found.
    pub found: FitResult,
}

impl FittedFile {
    /// Whether the user has stopped the fit, so that a part of it is missing.
    #[must_use]
    pub fn is_stopped(&self) -> bool {
        self.fit.stopped.is_some()
    }

    /// The tables of the fit with the names of their files: the points left out among them, if there are any.
    #[must_use]
    pub fn tables(&self) -> Vec<(&'static str, String)> {
        let excluded = tables::excluded(&self.identification);
        let excluded = excluded.map(|table| (tables::EXCLUDED, table));
        let all = tables::all(&self.identification, &self.fit).into_iter();
        all.chain(excluded).collect()
    }

    /// Samples of the posterior: each estimate with its name.
    #[must_use]
    pub fn samples(&self) -> Vec<(String, Vec<f64>)> {
        if self.found.samples.is_empty() {
            return Vec::new();
        }
        let estimates = self.fit.estimates.iter().enumerate();
        let column = |index: usize| self.found.samples.iter().map(move |sample| sample[index]);
        estimates
            .map(|(index, of)| (of.name.clone(), column(index).collect()))
            .collect()
    }
}

/// Makes the fit of a file that was begun to be read at `start`, and plans its design.
///
/// # Errors
///
/// [`Failure`] if a measurement gives no curve, the model has no prediction at any start, or the user stops before the
/// first.
pub fn fit(
    file: FitFile,
    start: Instant,
    stop: &StopFlag,
    tell: &(dyn Fn(Stage) + Sync),
) -> Result<FittedFile, Failure> {
    let identification = Identification::new(file, stop.clone())?;
    let (identification, fit) = identification.fitted(&|done| tell(Stage::Solved(done)))?;
    let next = Next::of(&identification, &fit, &|done| tell(Stage::Planned(done)));
    let seconds = start.elapsed().as_secs_f64();
    let found = FitResult::new(&identification, &fit, next, seconds);
    Ok(FittedFile {
        identification,
        fit,
        found,
    })
}

/// Judges the design of a file that was begun to be read at `start`; `tell` is told of each curve.
///
/// # Errors
///
/// [`Failure`] if there is no design, no curve can be solved, or the user stops.
pub fn plan(
    file: &FitFile,
    start: Instant,
    stop: &StopFlag,
    tell: &dyn Fn(Stage),
) -> Result<PlanResult, Failure> {
    let candidates = candidates(file, POINTS, None)?;
    let premises = Premises::of_file(file, &candidates)?;
    let planning = Planning::new(premises, &candidates, stop, &|done| {
        tell(Stage::Planned(done));
    })?;
    PlanResult::new(&planning, start.elapsed().as_secs_f64())
}

/// The table of a plan, as CSV.
#[must_use]
pub fn plan_table(plan: &PlanResult) -> String {
    table::csv(&plan.designs)
}
