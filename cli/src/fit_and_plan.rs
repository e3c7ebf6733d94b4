//! Fitting and planning of a fit file, shared by the command and the Python package.

use std::time::Instant;

use pellicle_identify::StopFlag;
use pellicle_identify::fit_file::FitFile;

use crate::failure::Failure;
use crate::identification::Identification;
use crate::identification::fitted_file::FittedFile;
use crate::identification::likelihood::FittedLikelihood;
use crate::identification::result::FitResult;
use crate::planning::Planning;
use crate::planning::candidate::candidates;
use crate::planning::premises::Premises;
use crate::planning::result::PlanResult;

/// The progress of a fit or a plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// The number of predictions of all curves made so far.
    Solved(usize),
    /// The number of curves of the design assessed so far.
    Planned(usize),
}

/// Fits a file whose reading began at `start`.
///
/// # Errors
///
/// [`Failure`] if a measurement gives no curve, the model has no prediction at any start, or the user stops before the
/// first prediction.
pub fn fit(
    file: FitFile,
    start: Instant,
    stop: &StopFlag,
    report: &(dyn Fn(Stage) + Sync),
) -> Result<FittedFile, Failure> {
    let identification = Identification::new(file, stop.clone())?;
    let (identification, fit) = identification.fitted(&|done| report(Stage::Solved(done)))?;
    let seconds = start.elapsed().as_secs_f64();
    let found = FitResult::new(&identification, &fit, seconds);
    Ok(FittedFile {
        identification,
        fit,
        found,
    })
}

/// Fits a file, and returns the likelihood of its data.
///
/// # Errors
///
/// Those of [`fit`].
pub fn likelihood(
    file: FitFile,
    stop: &StopFlag,
    report: &(dyn Fn(Stage) + Sync),
) -> Result<FittedLikelihood, Failure> {
    let identification = Identification::new(file, stop.clone())?;
    let (identification, fit) = identification.fitted(&|done| report(Stage::Solved(done)))?;
    FittedLikelihood::new(identification, &fit)
}

/// Assesses the design of a file whose reading began at `start`; `report` is called for each curve.
///
/// # Errors
///
/// [`Failure`] if there is no design, no curve can be solved, or the user stops.
pub fn plan(
    file: &FitFile,
    start: Instant,
    stop: &StopFlag,
    report: &dyn Fn(Stage),
) -> Result<PlanResult, Failure> {
    let candidates = candidates(file)?;
    let premises = Premises::new(file, &candidates)?;
    let planning = Planning::new(premises, &candidates, stop, &|done| {
        report(Stage::Planned(done));
    })?;
    PlanResult::new(&planning, start.elapsed().as_secs_f64())
}
