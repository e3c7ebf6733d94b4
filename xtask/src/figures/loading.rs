//! Figures 4 and 6: two numbers of a curve over its load, side by side.

use pellicle_cli::drawing::Axis;
use pellicle_cli::drawing::accuracy::{last_change, percent};
use pellicle_cli::drawing::colours::{self, Colour};
use pellicle_cli::drawing::labels::power;
use pellicle_cli::drawing::{Dash, Rect};
use pellicle_cli::results::StepSummary;
use pellicle_cli::results::Summary;

use super::chart::{self, AXIS, ChartLine, LEFT};
use super::pressures;
use super::runner::Runner;
use super::sheet::{Caption, MATERIALS, Picture, Sheet};
use crate::XtaskError;

/// In pixels.
const SIDE: f64 = 500.0;
const COLUMN: f64 = LEFT + SIDE + 36.0;
const LEGEND: f64 = 66.0 + 44.0;

/// One curve: its case, its name, how it is drawn.
type CurveSpec = (&'static str, &'static str, Colour, Dash);

/// One panel: a number of each step.
struct View {
    title: &'static str,
    axis: &'static str,
    value: fn(&StepSummary) -> f64,
}

/// A figure of two views of the same curves.
struct Loading {
    name: &'static str,
    title: &'static str,
    subtitle: &'static str,
    /// The first note.
    remark: String,
    curves: Vec<CurveSpec>,
    /// The load's axis and its unit.
    load: (&'static str, f64),
    views: [View; 2],
    /// Whether the notes tell the change of the largest pressure.
    shows_peak: bool,
}

/// Fig. 4: penetration, and its derivative, over the load: two coatings with two periods each, under the same forces.
pub(super) fn figure_4(runner: &Runner) -> Result<Picture, XtaskError> {
    let (stiff, compliant) = (colours::PURPLE, colours::GREEN);
    let (wide, narrow) = (Dash::Dashed, Dash::Solid);
    let figure = Loading {
        name: "fig4",
        title: "Fig. 4: penetration of a paraboloid into a textured coating against load",
        subtitle: "paraboloid of radius R; coating H = 10⁻⁴ R; cylinders r = 5·10⁻³ R, h = 10⁻⁴ R",
        remark: format!("{MATERIALS}; the same forces on both, in units of the stiff coating's E₁"),
        curves: vec![
            (
                "cases/paper/fig4-stiff-60",
                "stiff coating, T = R/60",
                stiff,
                wide,
            ),
            (
                "cases/paper/fig4-stiff-80",
                "stiff coating, T = R/80",
                stiff,
                narrow,
            ),
            (
                "cases/paper/fig4-soft-60",
                "compliant coating, T = R/60",
                compliant,
                wide,
            ),
            (
                "cases/paper/fig4-soft-80",
                "compliant coating, T = R/80",
                compliant,
                narrow,
            ),
        ],
        load: ("Q, 10⁻⁵ E₁R² (E₁ of the stiff coating)", 1e-5),
        views: [
            View {
                title: "penetration",
                axis: "D, 10⁻³ R",
                value: |step| step.penetration / 1e-3,
            },
            View {
                title: "its derivative, the inverse of the contact stiffness",
                axis: "dD/dQ, 1/(E₁R)",
                value: |step| 1.0 / step.contact_stiffness.unwrap_or(f64::NAN),
            },
        ],
        shows_peak: false,
    };
    figure.draw(runner)
}

/// Fig. 6: largest pressure and penetration of the pyramid over the load, with and without film, and with one that
/// stiffens.
pub(super) fn figure_6(runner: &Runner) -> Result<Picture, XtaskError> {
    let [film, stiffening, bare] = pressures::FILMS_AND_BARE;
    let figure = Loading {
        name: "fig6",
        title: "Fig. 6: Berkovich pyramid with a rounded tip, with and without film",
        subtitle: "tip radius 400 nm; coating H = 10 nm; film 5 nm thick, modulus 140 MPa, linear as printed or logarithmic",
        remark: "coating: E₁ = 70 GPa, E₁/E₂ = 10, ν₁ = 0.3, ν₂ = 0.4. The last load, 2.3 mN, is that of Fig. 5; the film shortens by more than its thickness, as printed.".into(),
        curves: vec![
            ("cases/paper/fig6-film", "with film", film.0, film.1),
            (
                "cases/paper/fig6-stiffening",
                "film that stiffens",
                stiffening.0,
                stiffening.1,
            ),
            ("cases/paper/fig6-bare", "without film", bare.0, bare.1),
        ],
        load: ("Q, mN", 1e-3),
        views: [
            View {
                title: "(a) largest pressure",
                axis: "largest p, GPa",
                value: |step| step.max_pressure / 1e9,
            },
            View {
                title: "(b) penetration",
                axis: "D, nm",
                value: |step| step.penetration / 1e-9,
            },
        ],
        shows_peak: true,
    };
    figure.draw(runner)
}

impl Loading {
    fn draw(&self, runner: &Runner) -> Result<Picture, XtaskError> {
        let summaries = self.curves.iter().map(|curve| runner.run(curve.0, &[]));
        let summaries = summaries.collect::<Result<Vec<Summary>, _>>()?;
        let notes = self.curves.iter().zip(&summaries);
        let notes = notes.map(|(curve, summary)| format!("{}: {}", curve.1, self.note(summary)));
        let caption = Caption {
            title: self.title,
            subtitle: format!("{}{}", runner.mark(), self.subtitle),
            notes: std::iter::once(self.remark.clone()).chain(notes).collect(),
        };
        let mut sheet = Sheet::new((2.0 * COLUMN, LEGEND + SIDE + AXIS), &caption);
        let lines = self
            .views
            .each_ref()
            .map(|view| self.lines(view, &summaries));
        for (i, (view, lines)) in self.views.iter().zip(&lines).enumerate() {
            let place = Rect {
                left: COLUMN * i as f64 + LEFT,
                top: Sheet::TOP + LEGEND,
                width: SIDE,
                height: SIDE,
            };
            let points = || lines.iter().flat_map(ChartLine::points);
            let axes = [
                from_zero(points().map(|(x, _)| x), self.load.0),
                from_zero(points().map(|(_, y)| y), view.axis),
            ];
            chart::draw(&mut sheet.svg, view.title, place, axes, lines);
        }
        chart::legend(&mut sheet.svg, (2, 420.0), &lines[0]);
        let tables = self.views.iter().zip(&lines);
        let csv = chart::csv(tables.map(|(view, lines)| (view.title, lines.as_slice())));
        Ok(sheet.finish(self.name, csv))
    }

    fn lines(&self, view: &View, summaries: &[Summary]) -> Vec<ChartLine> {
        let point = |step: &StepSummary| (step.force / self.load.1, (view.value)(step));
        let lines = self.curves.iter().zip(summaries);
        let lines = lines.map(|(&(_, name, colour, dash), summary)| {
            let points = summary
                .steps
                .iter()
                .map(point)
                .filter(|(_, y)| y.is_finite());
            ChartLine {
                dash,
                is_marked: true,
                ..ChartLine::new(name.into(), colour, vec![points.collect()])
            }
        });
        lines.collect()
    }

    /// The note on the data of a curve: its grid, and the largest of its certificates and of the changes between grids.
    fn note(&self, summary: &Summary) -> String {
        let largest =
            |of: fn(&StepSummary) -> f64| summary.steps.iter().map(of).fold(0.0, f64::max);
        let certificate = largest(|step| step.certificate.worst);
        let penetration = largest(|step| last_change(step, |level| level.penetration).abs());
        let peak = largest(|step| last_change(step, |level| level.max_pressure).abs());
        let peak = format!(", of the largest p ≤ {}", percent(peak));
        format!(
            "{n} × {n} elements, {} loads, certificates ≤ {}; change of D from the next coarser grid ≤ {}{}",
            summary.steps.len(),
            power(certificate, 1),
            percent(penetration),
            if self.shows_peak { &peak } else { "" },
            n = summary.grid.elements,
        )
    }
}

/// An axis from 0 to a little above the largest of these values.
fn from_zero(values: impl Iterator<Item = f64>, title: &str) -> Axis {
    let largest = values.fold(0.0, f64::max);
    Axis::new(0.0, 1.06 * largest, title.into(), 6)
}
