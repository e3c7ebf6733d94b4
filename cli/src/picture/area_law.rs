//! The steps of a rough contact, as points of the picture of its area.

use pellicle::summary::RunSummary;

/// Reduced pressure and contact fraction of each step that has them.
#[must_use]
pub fn of_run(run: &RunSummary) -> Vec<(f64, f64)> {
    let steps = run.steps.iter();
    let points = steps.filter_map(|step| {
        let fraction = step.rough_contact.as_ref()?.contact_fraction;
        Some((step.area_law?.reduced_pressure, fraction))
    });
    points.collect()
}
