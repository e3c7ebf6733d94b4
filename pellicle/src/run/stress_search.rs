//! The stresses in a summary: the extremes of each step, and the critical loads.

use pellicle_contact::{
    ContactError, CriticalLoad, Domain, LoadingPath, Model, Signal, StressExtremes, critical_loads,
    stress_extremes,
};

use crate::case::Case;
use crate::case::stress::StressCase;
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
    let mut found: Option<Stresses> = None;
    for body in stress.body.each() {
        let of = inside(case, &stress.inside(*body), model, domain, path, monitor)?;
        found = Some(match found {
            None => of,
            Some(before) => before.and(of),
        });
    }
    Ok(found)
}

impl Stresses {
    /// The stresses in one body and then those in the other.
    fn and(mut self, other: Self) -> Self {
        for (step, other) in self.steps.iter_mut().zip(other.steps) {
            step.bodies.extend(other.bodies);
            step.interfaces.extend(other.interfaces);
        }
        if let Some(critical) = other.critical {
            self.critical.get_or_insert_default().extend(critical);
        }
        self
    }
}

/// Finds the stresses in one body.
fn inside(
    case: &Case,
    stress: &StressCase,
    model: &Model,
    domain: Domain,
    path: &LoadingPath,
    monitor: &mut dyn Monitor,
) -> Result<Stresses, Error> {
    let body = stress.body.of(&case.foundation, Some(&case.indenter));
    let of = stress.body.into();
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
    // Those of a surface without wear would not be critical here.
    if !body.has_strengths() || case.wear.is_some() {
        let critical = None;
        return Ok(Stresses { steps, critical });
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
    Ok(Stresses {
        steps,
        critical: Some(critical),
    })
}
