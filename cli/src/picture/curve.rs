//! The curve of a run, as numbers of its picture.

use pellicle::summary::{RunSummary, StepSummary};
use pellicle_plot::run::curve::{CurveStep, NamedCurve};

/// The curve of a run under this name.
#[must_use]
pub fn of_run(run: &RunSummary, name: String) -> NamedCurve {
    let step = |step: &StepSummary| CurveStep {
        force: step.force,
        penetration: step.penetration,
        max_pressure: step.summary.max_pressure,
        mark: step.mark(),
    };
    NamedCurve {
        name,
        steps: run.steps.iter().map(step).collect(),
    }
}

/// The words that mark the worst of all steps; none if all are certified.
#[must_use]
pub fn worst<'a>(steps: impl Iterator<Item = &'a StepSummary>) -> Option<&'static str> {
    let worst = steps.max_by_key(|step| step.verdict());
    worst.and_then(StepSummary::mark)
}
