//! A case solved: its loading path, and a summary with the stresses and derivatives that it asks for.

mod sensitivities;
pub mod stress_search;

use std::time::Instant;

use pellicle_contact::wear::solve_wear;
use pellicle_contact::{ContactError, Domain, LoadingPath, Model, solve_path};
use pellicle_influence::Cache;

pub use self::stress_search::Stresses;
use crate::case::Case;
use crate::error::Error;
use crate::forecast::need::Need;
use crate::memory::MemoryBudget;
use crate::monitor::{Monitor, Watching};
use crate::summary::{Clock, RunSummary, WarningSummary};

/// Whether the results are all there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Completeness {
    /// Everything that was asked for.
    Whole,
    /// The work was stopped before everything was done.
    Part,
}

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
pub struct Run {
    /// The path of its loads: pressures, certificates, errors.
    pub path: LoadingPath,
    /// Its numbers, without the case itself and the warnings of the cache.
    pub summary: RunSummary,
    /// Whether every requested result is there; if not, the monitor stopped the work, and a warning says so.
    pub completeness: Completeness,
}

impl Case {
    /// Solves the case; its steps solved so far are kept if the monitor stops it.
    ///
    /// Coefficients are kept in memory only and dropped afterwards; [`solve`] shares them among cases.
    ///
    /// # Errors
    ///
    /// [`Error`] if there is too little memory, the contact cannot be computed, or the monitor stops the work before it
    /// begins ([`ContactError::Cancelled`]).
    pub fn solve(&self, monitor: &mut dyn Monitor) -> Result<Run, Error> {
        let resources = Resources {
            cache: &Cache::in_memory(),
            memory: &MemoryBudget::default(),
            writers: 0,
        };
        let run = solve(self, resources, Instant::now(), monitor)?;
        let mut run = run.ok_or(ContactError::Cancelled { step: 0 })?;
        run.summary.add_case(self)?;
        Ok(run)
    }
}

/// Solves a case whose reading began at `start`; none if the monitor stops it before it begins.
///
/// # Errors
///
/// [`Error`] if there is too little memory, or the contact cannot be computed.
pub fn solve(
    case: &Case,
    resources: Resources<'_>,
    start: Instant,
    monitor: &mut dyn Monitor,
) -> Result<Option<Run>, Error> {
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
    let Some(_share) = resources.memory.take(need, monitor)? else {
        return Ok(None);
    };
    let path = path(case, &model, domain, monitor)?;
    let stresses = if path.interrupted {
        None
    } else {
        unless_stopped(stress_search::find(case, &model, domain, &path, monitor))?
    };
    // Warnings of the cache concern all cases, so they are not part of one summary.
    let mut summary = RunSummary::of_results(case, &path, clock, &[]);
    let completeness = complete(case, &model, &path, stresses, &mut summary)?;
    Ok(Some(Run {
        path,
        summary,
        completeness,
    }))
}

/// The loading path of a case.
///
/// # Errors
///
/// [`Error`] if the contact cannot be computed.
pub fn path(
    case: &Case,
    model: &Model,
    domain: Domain,
    monitor: &mut dyn Monitor,
) -> Result<LoadingPath, Error> {
    let (loads, options) = (case.loads(), case.solver_options());
    let (elements, watching) = (case.grid.elements, &mut Watching(monitor));
    let solved = match (&case.wear, &loads[..]) {
        (Some(wear), [load]) => solve_wear(
            model,
            domain,
            elements,
            *load,
            &wear.build(),
            &options,
            watching,
        ),
        _ => solve_path(model, domain, elements, &loads, &options, watching),
    };
    solved.map_err(|error| case.blame(error))
}

/// Turns a search for stresses that the user stopped into none; it is not a failure.
///
/// # Errors
///
/// Any other [`Error`] of the search.
pub fn unless_stopped(found: Result<Option<Stresses>, Error>) -> Result<Option<Stresses>, Error> {
    match found {
        Err(Error::Contact(ContactError::Cancelled { .. })) => Ok(None),
        found => found,
    }
}

/// Adds the derivatives, the stresses found, and warnings about missing results to a summary.
///
/// # Errors
///
/// [`Error`] if the coefficients of a derivative cannot be computed.
pub fn complete(
    case: &Case,
    model: &Model,
    path: &LoadingPath,
    stresses: Option<Stresses>,
    summary: &mut RunSummary,
) -> Result<Completeness, Error> {
    let mut completeness = Completeness::Whole;
    if path.interrupted {
        let (done, steps) = (path.steps.len(), case.steps());
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
