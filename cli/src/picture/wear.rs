//! The steps of a wear, as sections of the picture of the worn surface.

use pellicle::summary::RunSummary;
use pellicle_plot::run::wear::WornSection;

/// The section of each step with wear.
#[must_use]
pub fn of_run(run: &RunSummary) -> Vec<WornSection<'_>> {
    let steps = run.steps.iter().filter_map(|step| step.wear.as_ref());
    steps
        .map(|wear| WornSection {
            distance: wear.distance,
            heights: &wear.section,
        })
        .collect()
}
