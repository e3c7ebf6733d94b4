//! The notes below a figure on the data in it.

use pellicle_cli::drawing::accuracy::{self, last_change, percent};
use pellicle_cli::drawing::labels::power;
use pellicle_cli::results::StepSummary;

pub(super) use pellicle_cli::drawing::accuracy::BRACKETS;

use super::run::PaperRun;

/// The note of one loading step.
pub(super) fn of_step(run: &PaperRun, step: &StepSummary) -> String {
    accuracy::of_step(run.summary.grid.elements, step)
}

/// The note of a loading path of which penetration and perhaps largest pressure are of interest.
pub(super) fn of_path(run: &PaperRun, with_peak: bool) -> String {
    let worst = |of: fn(&StepSummary) -> f64| run.steps().iter().map(of).fold(0.0, f64::max);
    let penetration = worst(|step| last_change(step, |level| level.penetration).abs());
    let peak = worst(|step| last_change(step, |level| level.max_pressure).abs());
    let peak = if with_peak {
        format!(", of the largest p ≤ {}", percent(peak))
    } else {
        String::new()
    };
    let n = run.summary.grid.elements;
    format!(
        "{n} × {n} elements, {} loads, certificates ≤ {}; change of D from the next coarser grid ≤ {}{peak}",
        run.steps().len(),
        power(run.worst(), 1),
        percent(penetration),
    )
}
