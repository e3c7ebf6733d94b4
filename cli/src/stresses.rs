//! The stresses that a summary tells: the extremes of each step, and the critical loads.

use pellicle_contact::{
    ContactError, CriticalLoad, Domain, LoadingPath, Model, Observer, StressExtremes,
    critical_loads, stress_extremes,
};

use crate::case::Case;
use crate::failure::Failure;
use crate::interrupt;

/// The extremes of the steps, and the critical loads.
#[derive(Debug, Clone, Default)]
pub struct Stresses {
    /// Of the steps in their order; fewer than there are if the user has stopped.
    pub steps: Vec<StressExtremes>,
    /// Of every strength given; none if no strength is, or if the user has stopped.
    pub critical: Option<Vec<CriticalLoad>>,
    /// Whether the user has stopped before all were found.
    pub is_stopped: bool,
}

/// What is looked for, for the user to see.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Search {
    /// The extremes of a step, counted from 0, of so many.
    Step(usize, usize),
    /// The critical loads.
    Critical,
}

/// Finds the stresses of a solved path, unless the case asks for none; `tell` is told what is being looked for.
///
/// # Errors
///
/// [`Failure`] if a stress cannot be computed or a critical load not be solved for.
pub fn find(
    case: &Case,
    model: &Model,
    domain: Domain,
    path: &LoadingPath,
    tell: &dyn Fn(Search),
    observer: &mut dyn Observer,
) -> Result<Option<Stresses>, Failure> {
    let Some(stress) = &case.stress else {
        return Ok(None);
    };
    let stress = stress.model(&case.foundation, path.tables.foundation());
    let count = path.steps.len();
    let mut found = Stresses::default();
    for step in 0..count {
        if interrupt::is_requested() {
            found.is_stopped = true;
            return Ok(Some(found));
        }
        tell(Search::Step(step, count));
        let extremes = stress_extremes(path, step, &stress);
        found
            .steps
            .push(extremes.map_err(|error| case.blame(error))?);
    }
    if !case.foundation.has_strengths() {
        return Ok(Some(found));
    }
    tell(Search::Critical);
    let (steps, options) = (&found.steps, case.solver_options());
    match critical_loads(model, path, steps, domain, &options, &stress, observer) {
        Ok(critical) => found.critical = Some(critical),
        Err(ContactError::Cancelled { .. }) => found.is_stopped = true,
        Err(error) => return Err(case.blame(error)),
    }
    Ok(Some(found))
}
