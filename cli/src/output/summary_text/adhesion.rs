//! The curve with adhesion in words.

use pellicle::display::{Unit, quantity, significant};
use pellicle::summary::{AdhesivePoint, RunSummary};
use pellicle_contact::adhesion::AdhesionLaw;

use super::columns::TextColumns;

/// Describes pull-off, jumps and the contact under no force; empty without adhesion.
#[must_use]
pub fn curve(summary: &RunSummary) -> String {
    let (Some(pull_off), Some(adhesion)) = (&summary.pull_off, &summary.adhesion) else {
        return String::new();
    };
    let law = match adhesion.law {
        AdhesionLaw::Jkr => "JKR",
        AdhesionLaw::Dmt => "DMT",
    };
    let mut lines = TextColumns {
        units: summary.units,
        element_side: summary.grid.element_side,
        text: format!("adhesion by {law}, without a grid\n"),
    };
    let of = |value, unit| quantity(value, unit, summary.units);
    let mut point = |name: &str, at: &AdhesivePoint| {
        let depth = of(at.penetration, Unit::Metre);
        let note = format!(
            "D {depth}, contact radius {}",
            of(at.contact_radius, Unit::Metre)
        );
        lines.push(name, &of(at.force, Unit::Newton), &note);
    };
    point("pull-off", pull_off);
    point("least penetration", &adhesion.last_contact);
    point("no penetration, jump-in", &adhesion.jump_in);
    point("no force", &adhesion.zero_load);
    let joules = summary.units.name("J");
    let lost = format!("{} {joules}", significant(adhesion.work_lost, 5));
    lines.push(
        "work lost",
        &lost,
        "in and out under a prescribed penetration",
    );
    if let Some(number) = adhesion.tabor_number {
        lines.push("Tabor's number", &significant(number, 3), "");
    }
    lines.text
}
