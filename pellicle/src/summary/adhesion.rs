//! Adhesion in a summary: the numbers of a step with it, and those of the whole curve.

use std::f64::consts::PI;

use pellicle_contact::adhesion::{AdhesionLaw, AdhesiveContact};
use pellicle_contact::{ErrorEstimate, Load};
use serde::{Deserialize, Serialize};

use super::StepSummary;
use crate::case::adhesion::AdhesiveContacts;

/// A contact with adhesion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct AdhesivePoint {
    /// Force, N; negative where the indenter is pulled.
    pub force: f64,
    /// Penetration, m.
    pub penetration: f64,
    /// Contact radius, m.
    pub contact_radius: f64,
}

/// The curve with adhesion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AdhesionSummary {
    /// Where adhesion acts.
    pub law: AdhesionLaw,
    /// Tabor's number; none for a tip without curvature.
    pub tabor_number: Option<f64>,
    /// The contact under no force.
    pub zero_load: AdhesivePoint,
    /// The contact into which the indenter jumps at no penetration, if it is prescribed.
    pub jump_in: AdhesivePoint,
    /// The contact at the least penetration, out of which it jumps.
    pub last_contact: AdhesivePoint,
    /// Work lost between both, J.
    pub work_lost: f64,
}

impl From<AdhesiveContact> for AdhesivePoint {
    fn from(contact: AdhesiveContact) -> Self {
        Self {
            force: contact.force,
            penetration: contact.penetration,
            contact_radius: contact.radius,
        }
    }
}

impl From<&AdhesiveContacts> for AdhesionSummary {
    fn from(found: &AdhesiveContacts) -> Self {
        Self {
            law: found.law,
            tabor_number: found.tabor_number,
            zero_load: found.zero_load.into(),
            jump_in: found.jump_in.into(),
            last_contact: found.last_contact.into(),
            work_lost: found.work_lost,
        }
    }
}

/// Replaces the numbers of a step without adhesion by those of the contact with it, under the load of the case.
///
/// The largest pressure by JKR is not known, and NaN: the tension of a flat punch is taken from that of the grid.
pub(super) fn add_to(
    step: &mut StepSummary,
    adhesion: &AdhesiveContacts,
    index: usize,
    given: Load,
) {
    let Some(contact) = adhesion.steps.get(index).copied().flatten() else {
        return;
    };
    let area = PI * contact.radius * contact.radius;
    let [mut force, mut penetration] = contact.errors();
    let relative = force / (contact.force_without + contact.force.abs()).max(f64::MIN_POSITIVE);
    (step.force, step.penetration) = (contact.force, contact.penetration);
    match given {
        Load::Force(prescribed) => (step.force, force) = (prescribed, 0.0),
        Load::Penetration(prescribed) => (step.penetration, penetration) = (prescribed, 0.0),
    }
    step.contact_stiffness = Some(contact.stiffness).filter(|stiffness| *stiffness > 0.0);
    step.summary.contact_radius = contact.radius;
    step.summary.contact_area = area;
    if step.summary.contact_area_on_relief > 0.0 {
        step.summary.contact_area_on_relief = area;
    } else {
        step.summary.contact_area_between = area;
    }
    step.summary.mean_pressure = if area > 0.0 {
        contact.force / area
    } else {
        0.0
    };
    let estimated = |estimate| {
        Some(ErrorEstimate {
            estimate,
            order: None,
            resolved: true,
        })
    };
    step.grid_error.force = estimated(force);
    step.grid_error.penetration = estimated(penetration);
    // The radius is as accurate as both.
    step.grid_error.contact_area = estimated(2.0 * relative * area);
    if adhesion.law == AdhesionLaw::Jkr {
        step.summary.max_pressure = f64::NAN;
        step.summary.max_pressure_at = [f64::NAN; 2];
        step.grid_error.max_pressure = None;
    }
}
