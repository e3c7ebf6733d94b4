//! What figures 4 and 6 share: curves over the load, side by side.

use pellicle_cli::drawing::colours::{self, Colour};
use pellicle_cli::drawing::{Dash, Rect};
use pellicle_cli::results::StepSummary;

use super::line::{self, Line};
use super::picture::Picture;
use super::run::PaperRun;
use super::sheet::Sheet;
use super::studio::{Drawn, Studio};
use super::{chart, note};
use crate::XtaskError;

/// In pixels.
const LEFT: f64 = 112.0;
const SIDE: f64 = 500.0;
const COLUMN: f64 = LEFT + SIDE + 36.0;
const LEGEND: f64 = 66.0;
const HEIGHT: f64 = LEGEND + 44.0 + SIDE + 76.0;

/// Curves in a row of the legend.
const IN_A_ROW: usize = 2;

/// The coating with and without film.
pub(super) const FILM: Colour = colours::SKY;
pub(super) const BARE: Colour = colours::AMBER;

/// A curve of a figure: the run, its name, how it is drawn.
pub(super) struct Curve {
    pub run: PaperRun,
    pub name: &'static str,
    pub colour: Colour,
    pub dash: Dash,
}

/// A curve that is still to be computed: its case, name, colour and dash.
pub(super) type Planned = (&'static str, &'static str, Colour, Dash);

/// The curves, computed or taken from an earlier run, as fine as what is drawn of them needs.
pub(super) fn curves(
    studio: &mut Studio<'_>,
    planned: &[Planned],
    drawn: &[Drawn],
) -> Result<Vec<Curve>, XtaskError> {
    let computed = planned.iter().map(|(case, name, colour, dash)| {
        Ok(Curve {
            run: studio.path(case, drawn)?,
            name,
            colour: *colour,
            dash: *dash,
        })
    });
    computed.collect()
}

/// One panel: what is shown of each step, in what unit.
pub(super) struct View {
    pub title: &'static str,
    pub y: &'static str,
    pub value: fn(&StepSummary) -> f64,
}

/// The load's axis: its title and what a force is divided by.
pub(super) struct LoadAxis {
    pub title: &'static str,
    pub divisor: f64,
}

/// A figure of two views of the same curves.
pub(super) struct Loading<'a> {
    pub curves: &'a [Curve],
    pub load: LoadAxis,
    pub views: [View; 2],
}

impl Loading<'_> {
    /// Its sheet: heading, first note, and a note on the data of every curve, with its largest pressure if that is
    /// shown.
    pub(super) fn sheet(
        &self,
        title: &str,
        subtitle: &str,
        note: String,
        with_peak: bool,
    ) -> Sheet {
        let data =
            |curve: &Curve| format!("{}: {}", curve.name, note::of_path(&curve.run, with_peak));
        let notes: Vec<_> = std::iter::once(note)
            .chain(self.curves.iter().map(data))
            .collect();
        Sheet::new((2.0 * COLUMN, HEIGHT), title, subtitle, &notes)
    }

    /// Draws both views side by side, and the legend above.
    pub(super) fn draw(&self, name: &'static str, mut sheet: Sheet) -> Picture {
        let drawn = self
            .views
            .each_ref()
            .map(|view| (view.title, self.lines(view)));
        for (i, (view, (_, lines))) in self.views.iter().zip(&drawn).enumerate() {
            self.draw_view(&mut sheet, i, view, lines);
        }
        let entries: Vec<&Line> = drawn[0].1.iter().collect();
        let rows: Vec<_> = entries.chunks(IN_A_ROW).collect();
        chart::legend(&mut sheet.svg, (LEFT, Sheet::TOP + 12.0), 420.0, &rows);
        let tables = drawn
            .iter()
            .map(|(title, lines)| (*title, lines.as_slice()));
        let csv = line::csv(tables);
        sheet.finish(name, csv)
    }

    fn draw_view(&self, sheet: &mut Sheet, i: usize, view: &View, lines: &[Line]) {
        let place = Rect {
            left: COLUMN * i as f64 + LEFT,
            top: Sheet::TOP + LEGEND + 44.0,
            width: SIDE,
            height: SIDE,
        };
        let points = || lines.iter().flat_map(Line::points);
        let axes = (
            chart::from_zero(points().map(|(x, _)| x), self.load.title),
            chart::from_zero(points().map(|(_, y)| y), view.y),
        );
        chart::draw(&mut sheet.svg, view.title, place, axes, lines);
    }

    fn lines(&self, view: &View) -> Vec<Line> {
        let line = |curve: &Curve| Line {
            name: curve.name.to_owned(),
            colour: curve.colour,
            dash: curve.dash,
            width: Line::WIDTH,
            is_marked: true,
            parts: vec![self.points(&curve.run, view)],
        };
        self.curves.iter().map(line).collect()
    }

    fn points(&self, run: &PaperRun, view: &View) -> Vec<(f64, f64)> {
        let point = |step: &StepSummary| (step.force / self.load.divisor, (view.value)(step));
        let points = run.steps().iter().map(point);
        points.filter(|(_, y)| y.is_finite()).collect()
    }
}
