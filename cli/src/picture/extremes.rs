//! The largest stresses of a step, as numbers of the pictures of stresses.

use pellicle::summary::StepSummary;
use pellicle_plot::stress::extremes::{BodyExtremes, Extreme, Extremes, InterfaceExtremes};

/// The largest stresses of a step; empty if none were sought.
#[must_use]
pub fn of_step(step: &StepSummary) -> Extremes {
    let Some(found) = step.stress.as_ref().map(|stress| &stress.extremes) else {
        return Extremes::default();
    };
    let bodies = found.bodies.iter().map(|body| BodyExtremes {
        name: body.name.clone(),
        von_mises: extreme(body.max_von_mises),
        max_principal: extreme(body.max_principal),
    });
    let interfaces = found.interfaces.iter().map(|interface| InterfaceExtremes {
        index: interface.index,
        shear: extreme(interface.max_shear_traction),
        tension: extreme(interface.max_tension),
        compression: extreme(interface.max_compression),
    });
    Extremes {
        bodies: bodies.collect(),
        interfaces: interfaces.collect(),
    }
}

fn extreme<const AXES: usize>(
    of: Option<pellicle_contact::Extreme<AXES>>,
) -> Option<Extreme<AXES>> {
    of.map(|of| Extreme {
        value: of.value,
        at: of.at,
    })
}
