//! The stresses in a summary: the extremes of each step, and the critical loads.

use pellicle_contact::{
    ContactError, CriticalLoad, Domain, LoadingPath, Model, Signal, StressExtremes, critical_loads,
    stress_extremes,
};

use crate::case::Case;
use crate::error::Error;
use crate::monitor::{Event, Monitor, Watching};

/// The extremes of the steps, and the critical loads.
#[derive(Debug, Clone)]
pub struct Stresses {
    /// Extremes of the steps, in their order.
    pub steps: Vec<StressExtremes>,
    /// The critical load of each given strength; none if no strength is given.
    pub critical: Option<Vec<CriticalLoad>>,
}

/// Finds the stresses of a solved path if the case requests any.
///
/// # Errors
///
/// [`ContactError::Cancelled`] if the monitor stops it; [`Error`] if a stress or a critical load cannot
/// be computed.
pub fn find(
    case: &Case,
    model: &Model,
    domain: Domain,
    path: &LoadingPath,
    monitor: &mut dyn Monitor,
) -> Result<Option<Stresses>, Error> {
    let Some(stress) = &case.stress else {
        return Ok(None);
    };
    let (body, of) = (case.stressed(), stress.body.into());
    // The pressure is the same on both bodies.
    let (model, path) = (&model.seen_from(of), &path.seen_from(of));
    let stress = stress.model(&body, path.tables.foundation());
    let count = path.steps.len();
    let mut of_step = |step| {
        if monitor.told(Event::StressesOf(step, count)) == Signal::Cancel {
            return Err(ContactError::Cancelled { step });
        }
        stress_extremes(path, step, &stress)
    };
    let steps: Result<Vec<_>, _> = (0..count).map(&mut of_step).collect();
    let steps = steps.map_err(|error| case.blame(error))?;
    if !body.has_strengths() {
        let critical = None;
        return Ok(Some(Stresses { steps, critical }));
    }
    if monitor.told(Event::CriticalLoads) == Signal::Cancel {
        return Err(ContactError::Cancelled { step: count }.into());
    }
    let options = case.solver_options();
    let critical = critical_loads(
        model,
        path,
        &steps,
        domain,
        &options,
        &stress,
        &mut Watching(monitor),
    )
    .map_err(|error| case.blame(error))?;
    Ok(Some(Stresses {
        steps,
        critical: Some(critical),
    }))
}
