//! `report.html`: a run on one page that needs no network. Drawings can be moved and zoomed, the pressure view can be
//! rotated. The page is `cli/templates/report.html`; this module supplies its text.

mod case_table;
mod grid_error;
mod step;
mod stress;

use askama::Template;
use pellicle::Run;
use pellicle::display::{Unit, quantity, significant};
use pellicle::result::fields::Fields;
use pellicle::result::quantities::of_a_curve;
use pellicle::result::quantity::Quantity;
use pellicle::summary::{RunSummary, StepSummary};
use pellicle_contact::Status;

use self::grid_error::GridErrorNote;
use self::step::StepSection;

use super::pictures::{self, RunDrawings, StepDrawings, StepPicture, StressPicture};
use super::summary_text;

/// Name of the file in a results folder.
pub const FILE: &str = "report.html";

/// The contents of the page, with numbers in words.
#[derive(Template)]
#[template(path = "report.html")]
struct RunPage<'a> {
    summary: &'a RunSummary,
    run: &'a RunDrawings,
    /// The domain in words, with its sides.
    domain: String,
    element_side: String,
    /// The worst status of a step.
    worst: Status,
    /// The names of the numbers in the table of the curve.
    columns: Vec<String>,
    curve: Vec<CurveRow>,
    steps: Vec<StepSection<'a>>,
    /// Sentences on the critical loads, the smallest load first.
    critical: Vec<String>,
    /// The curve with adhesion, in lines; empty without adhesion.
    adhesion: String,
    /// Keys of the case and their values.
    case: Vec<(String, String)>,
    coefficients_seconds: String,
    solve_seconds: String,
}

/// A loading step in the table of the curve.
struct CurveRow {
    cells: Vec<String>,
    status: Status,
}

/// Renders the page as HTML.
#[must_use]
pub fn html(summary: &RunSummary, steps: &[StepDrawings], run: &RunDrawings) -> String {
    let last = summary.steps.len().checked_sub(1);
    let section = |drawings| StepSection::new(summary, drawings);
    // The numbers of the last step are shown whether it is drawn or not.
    let without_drawings = StepDrawings {
        step: last.unwrap_or_default(),
        ..StepDrawings::default()
    };
    let is_drawn = last.is_none() || steps.last().map(|drawings| drawings.step) == last;
    let without_drawings = (!is_drawn).then_some(&without_drawings);
    let metres = |value| quantity(value, Unit::Metre, summary.units);
    let seconds = |value| significant(value, 3);
    let page = RunPage {
        summary,
        run,
        domain: domain(summary),
        element_side: metres(summary.grid.element_side),
        worst: (summary.steps.iter().map(StepSummary::verdict).max()).unwrap_or_default(),
        columns: (of_a_curve(summary).into_iter().map(Quantity::title)).collect(),
        curve: summary
            .steps
            .iter()
            .map(|step| row(summary, step))
            .collect(),
        steps: steps.iter().chain(without_drawings).map(section).collect(),
        critical: (summary_text::stress::critical(summary).lines())
            .map(str::to_owned)
            .collect(),
        adhesion: summary_text::adhesion::curve(summary),
        case: case_table::rows(&summary.case, summary.units),
        coefficients_seconds: seconds(summary.timing.coefficients_seconds),
        solve_seconds: seconds(summary.timing.solve_seconds),
    };
    page.to_string()
}

/// The domain in words, with its sides.
fn domain(summary: &RunSummary) -> String {
    let sides = summary.grid.sides_in_words(summary.units);
    match summary.grid.lengths {
        None => format!("a square of {sides}"),
        Some(_) => format!("an oblong cell of {sides}"),
    }
}

/// Renders the page of a run whose files are not written, with the pictures of its last step.
#[must_use]
pub fn of_run(run: &Run) -> String {
    let (summary, path) = (&run.summary, &run.path);
    let geometry = path.geometry();
    let drawn = |step| {
        let surface = path.surface(&geometry, step)?;
        let fields = Fields::of(path, &geometry, step, &surface);
        Some(pictures::drawn_step(summary, step, fields))
    };
    let last = path.steps.len().checked_sub(1).and_then(drawn);
    html(summary, last.as_slice(), &pictures::drawn_run(summary))
}

fn row(summary: &RunSummary, step: &StepSummary) -> CurveRow {
    CurveRow {
        cells: (of_a_curve(summary).iter())
            .map(|of| of.words(step, summary).unwrap_or_default())
            .collect(),
        status: step.verdict(),
    }
}
