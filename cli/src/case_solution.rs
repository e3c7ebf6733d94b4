//! Solves a case: its loading path, and a summary with the stresses and derivatives that the case requests.

use std::time::Instant;

use pellicle_contact::{ContactError, Domain, LoadingPath, Model, Observer, Signal, solve_path};
use pellicle_influence::Cache;

use crate::case::Case;
use crate::failure::Failure;
use crate::forecast::need::Need;
use crate::memory::MemoryBudget;
use crate::output::folder::Completeness;
use crate::output::summary::{Clock, RunSummary, WarningSummary};
use crate::sensitivities;
use crate::stress_search::{self, StressSearch, Stresses};

/// The resources that the cases of a process share.
#[derive(Debug, Clone, Copy)]
pub struct Resources<'a> {
    /// The radial tables and coefficients found so far.
    pub cache: &'a Cache,
    /// The memory.
    pub memory: &'a MemoryBudget,
    /// Threads that will write the results; 0 if they are not written.
    pub writers: usize,
}

/// A solved case.
#[derive(Debug)]
pub struct SolvedCase {
    /// The path of its loads.
    pub path: LoadingPath,
    /// Its numbers, without the case itself and the warnings of the cache.
    pub summary: RunSummary,
    /// Whether every requested result is there; if not, the observer stopped the work, and a warning says so.
    pub completeness: Completeness,
}

/// Solves a case whose reading began at `start`; none if the observer stops it before it begins.
///
/// The observer is called in every iteration. `search` is called before each search for stresses, which the observer
/// does not see, and may stop the work.
///
/// # Errors
///
/// [`Failure`] if there is too little memory, or the contact cannot be computed.
pub fn solve(
    case: &Case,
    resources: Resources<'_>,
    start: Instant,
    observer: &mut dyn Observer,
    search: &dyn Fn(StressSearch) -> Signal,
) -> Result<Option<SolvedCase>, Failure> {
    let tables = Instant::now();
    let model = case.model(resources.cache)?;
    let clock = Clock {
        start,
        tables_seconds: tables.elapsed().as_secs_f64(),
        tables_origin: model.origin,
    };
    let model = model.value;
    let domain = case.domain(&model)?;
    let need = Need::new(case, &model, domain, resources.writers);
    let Some(_share) = resources.memory.take(need)? else {
        return Ok(None);
    };
    let path = path(case, &model, domain, observer)?;
    let stresses = if path.interrupted {
        None
    } else {
        unless_stopped(stress_search::find(
            case, &model, domain, &path, search, observer,
        ))?
    };
    // Warnings of the cache concern all cases, so they are not part of one summary.
    let mut summary = RunSummary::of_results(case, &path, clock, &[]);
    let completeness = complete(case, &model, &path, stresses, &mut summary)?;
    Ok(Some(SolvedCase {
        path,
        summary,
        completeness,
    }))
}

/// The loading path of a case.
///
/// # Errors
///
/// [`Failure`] if the contact cannot be computed.
pub fn path(
    case: &Case,
    model: &Model,
    domain: Domain,
    observer: &mut dyn Observer,
) -> Result<LoadingPath, Failure> {
    let (loads, options) = (case.load.loads(), case.solver_options());
    let elements = case.grid.elements;
    solve_path(model, domain, elements, &loads, &options, observer)
        .map_err(|error| case.blame(error))
}

/// Turns a search for stresses that the user stopped into none; it is not a failure.
///
/// # Errors
///
/// Any other [`Failure`] of the search.
pub fn unless_stopped(
    found: Result<Option<Stresses>, Failure>,
) -> Result<Option<Stresses>, Failure> {
    match found {
        Err(Failure::Contact(ContactError::Cancelled { .. })) => Ok(None),
        found => found,
    }
}

/// Adds the derivatives, the stresses found, and warnings about missing results to a summary.
///
/// # Errors
///
/// [`Failure`] if the coefficients of a derivative cannot be computed.
pub fn complete(
    case: &Case,
    model: &Model,
    path: &LoadingPath,
    stresses: Option<Stresses>,
    summary: &mut RunSummary,
) -> Result<Completeness, Failure> {
    let mut completeness = Completeness::Whole;
    if path.interrupted {
        let (done, steps) = (path.steps.len(), case.load.loads().len());
        let message = format!("stopped by the user after {done} of {steps} loading steps");
        summary.warnings.push(stopped(message));
        completeness = Completeness::Part;
    }
    if let Some(found) = sensitivities::find(case, model, path)? {
        summary.add_sensitivities(found);
    }
    match (&case.stress, stresses) {
        (Some(stress), Some(found)) => summary.add_stresses(stress, found),
        (Some(_), None) => {
            let message = "stopped by the user before all stresses were found: they are missing";
            summary.warnings.push(stopped(message.into()));
            completeness = Completeness::Part;
        }
        (None, _) => {}
    }
    Ok(completeness)
}

fn stopped(message: String) -> WarningSummary {
    let code = "stopped".into();
    WarningSummary { code, message }
}
