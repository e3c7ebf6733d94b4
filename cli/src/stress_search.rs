//! The stresses in a summary: the extremes of each step, and the critical loads.

use pellicle_contact::{
    ContactError, CriticalLoad, Domain, LoadingPath, Model, Observer, Signal, StressExtremes,
    critical_loads, stress_extremes,
};

use crate::case::Case;
use crate::failure::Failure;

/// The extremes of the steps, and the critical loads.
#[derive(Debug, Clone)]
pub struct Stresses {
    /// Extremes of the steps, in their order.
    pub steps: Vec<StressExtremes>,
    /// The critical load of each given strength; none if no strength is given.
    pub critical: Option<Vec<CriticalLoad>>,
}

/// The search in progress, as shown to the user.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StressSearch {
    /// The extremes of a step: its index, from 0, and the number of steps.
    Step(usize, usize),
    /// The critical loads.
    Critical,
}

/// Finds the stresses of a solved path if the case requests any; `report` is called before each search and may cancel
/// it.
///
/// # Errors
///
/// [`ContactError::Cancelled`] if `report` or the observer stops it; [`Failure`] if a stress or a critical load cannot
/// be computed.
pub fn find(
    case: &Case,
    model: &Model,
    domain: Domain,
    path: &LoadingPath,
    report: &dyn Fn(StressSearch) -> Signal,
    observer: &mut dyn Observer,
) -> Result<Option<Stresses>, Failure> {
    let Some(stress) = &case.stress else {
        return Ok(None);
    };
    let stress = stress.model(&case.foundation, path.tables.foundation());
    let count = path.steps.len();
    let of_step = |step| {
        if report(StressSearch::Step(step, count)) == Signal::Cancel {
            return Err(ContactError::Cancelled { step });
        }
        stress_extremes(path, step, &stress)
    };
    let steps: Result<Vec<_>, _> = (0..count).map(of_step).collect();
    let steps = steps.map_err(|error| case.blame(error))?;
    if !case.foundation.has_strengths() {
        let critical = None;
        return Ok(Some(Stresses { steps, critical }));
    }
    if report(StressSearch::Critical) == Signal::Cancel {
        return Err(ContactError::Cancelled { step: count }.into());
    }
    let options = case.solver_options();
    let critical = critical_loads(model, path, &steps, domain, &options, &stress, observer)
        .map_err(|error| case.blame(error))?;
    Ok(Some(Stresses {
        steps,
        critical: Some(critical),
    }))
}
