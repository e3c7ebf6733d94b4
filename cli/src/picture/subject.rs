//! A loading step as the subject of pictures.

use pellicle::display::{Unit, quantity};
use pellicle::summary::{RunSummary, StepSummary};
use pellicle_plot::sheet::style::{Cut, Style};
use pellicle_plot::step::subject::Subject;

use super::accuracy;
use pellicle::result::fields::Fields;

/// Where the section of a run is, if not through its axis: a plane has none.
fn cut_of(run: &RunSummary) -> Option<Cut> {
    run.presses_a_plane().then_some(Cut::Peak)
}

/// A step of a run with its fields.
#[must_use]
pub fn of_step<'a>(
    run: &'a RunSummary,
    step: &StepSummary,
    fields: &Fields<'a>,
    style: Style,
) -> Subject<'a> {
    let quantity = |value, unit| quantity(value, unit, run.units);
    let mark = step.mark();
    let mark = mark.map_or(String::new(), |mark| format!("{mark}:  "));
    Subject {
        title: &run.title,
        numbers: format!(
            "{mark}Q = {},  D = {},  largest p = {}",
            quantity(step.force, Unit::Newton),
            quantity(step.penetration, Unit::Metre),
            quantity(step.summary.max_pressure, Unit::Pascal),
        ),
        accuracy: accuracy::of_step(&run.grid, step),
        units: run.units,
        relief_height: run.relief_height(),
        fields: *fields,
        style: Style {
            cut: style.cut.or_else(|| cut_of(run)),
            ..style
        },
    }
}
