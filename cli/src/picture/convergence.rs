//! The numbers of a run on its grids, for their picture.

use pellicle::display::Unit;
use pellicle::summary::{RunSummary, StepSummary};
use pellicle_contact::{ErrorEstimate, GridError, LevelValues};
use pellicle_plot::run::convergence::{GridErrorNote, GridNumber, GridValues};

/// Penetration, contact area and largest pressure of a run.
#[must_use]
pub fn of_run(run: &RunSummary) -> [GridNumber; 3] {
    let number = |name, unit, value: fn(&StepSummary) -> f64, estimate: Estimate, level: Level| {
        let steps = run.steps.iter().map(|step| GridValues {
            value: value(step),
            error: estimate(&step.grid_error).map(note),
            levels: (step.grid_error.levels.iter())
                .map(|of| (of.elements, level(of)))
                .collect(),
        });
        GridNumber {
            name,
            unit,
            steps: steps.collect(),
        }
    };
    [
        number(
            "penetration D",
            Unit::Metre,
            |step| step.penetration,
            |error| error.penetration,
            |level| level.penetration,
        ),
        number(
            "contact area",
            Unit::SquareMetre,
            |step| step.summary.contact_area,
            |error| error.contact_area,
            |level| level.contact_area,
        ),
        number(
            "largest pressure",
            Unit::Pascal,
            |step| step.summary.max_pressure,
            |error| error.max_pressure,
            |level| level.max_pressure,
        ),
    ]
}

type Estimate = fn(&GridError) -> Option<ErrorEstimate>;
type Level = fn(&LevelValues) -> f64;

fn note(of: ErrorEstimate) -> GridErrorNote {
    if of.resolved {
        GridErrorNote::Resolved(of.estimate)
    } else {
        GridErrorNote::NotResolved
    }
}
