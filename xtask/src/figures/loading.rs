//! Figures 4 and 6: two quantities against load, side by side.

use pellicle::summary::{RunSummary, StepSummary};
use pellicle_cli::drawing::accuracy::{last_change, percent};
use pellicle_plot::axes::labels::power;
use pellicle_plot::axes::panel::Axis;
use pellicle_plot::sheet::colours::{GREEN, PURPLE};
use pellicle_plot::sheet::svg::Dash::{Dashed, Solid};

use super::chart::{Chart, ChartLine, CurvePanel, Pen};
use super::figure_2::MATERIALS;
use super::figure_5::{COATING, FILMS};
use super::runner::Runner;
use super::sheet::{Caption, Picture};
use crate::XtaskError;

/// A figure of two views of the same curves.
pub(super) struct Loading {
    name: &'static str,
    title: &'static str,
    subtitle: &'static str,
    /// The coatings, and what follows in the first note.
    coatings: &'static str,
    remark: &'static str,
    /// The cases, without the name of the figure.
    cases: &'static [&'static str],
    /// The name and the pen of each case's curve.
    curves: &'static [(&'static str, Pen)],
    /// The load's axis and its unit.
    load: (&'static str, f64),
    views: [View; 2],
    /// Whether the notes give the change of the largest pressure.
    shows_peak: bool,
}

/// A panel: title, vertical axis, and the value of a step on it.
type View = (&'static str, &'static str, fn(&StepSummary) -> f64);

/// Penetration and its derivative against load: two coatings with two periods each, under the same forces.
pub(super) const FIGURE_4: Loading = Loading {
    name: "fig4",
    title: "Fig. 4: penetration of a paraboloid into a textured coating against load",
    subtitle: "paraboloid of radius R; coating H = 10⁻⁴ R; cylinders r = 5·10⁻³ R, h = 10⁻⁴ R",
    coatings: MATERIALS,
    remark: "; the same forces on both, in units of the stiff coating's E₁",
    cases: &["stiff-60", "stiff-80", "soft-60", "soft-80"],
    curves: &[
        ("stiff coating, T = R/60", (PURPLE, Dashed)),
        ("stiff coating, T = R/80", (PURPLE, Solid)),
        ("compliant coating, T = R/60", (GREEN, Dashed)),
        ("compliant coating, T = R/80", (GREEN, Solid)),
    ],
    load: ("Q, 10⁻⁵ E₁R² (E₁ of the stiff coating)", 1e-5),
    views: [
        ("penetration", "D, 10⁻³ R", |step| {
            step.penetration / 1e-3
        }),
        (
            "its derivative, the inverse of the contact stiffness",
            "dD/dQ, 1/(E₁R)",
            |step| 1.0 / step.contact_stiffness.unwrap_or(f64::NAN),
        ),
    ],
    shows_peak: false,
};

/// Largest pressure and penetration of the pyramid against load, with and without film, and with a stiffening film.
pub(super) const FIGURE_6: Loading = Loading {
    name: "fig6",
    title: "Fig. 6: Berkovich pyramid with a rounded tip, with and without film",
    subtitle: "tip radius 400 nm; coating H = 10 nm; film 5 nm thick, modulus 140 MPa, linear as printed or logarithmic",
    coatings: COATING,
    remark: ". The last load, 2.3 mN, is that of Fig. 5; the film shortens by more than its thickness, as printed.",
    cases: &["film", "stiffening", "bare"],
    curves: &FILMS,
    load: ("Q, mN", 1e-3),
    views: [
        ("(a) largest pressure", "largest p, GPa", |step| {
            step.summary.max_pressure / 1e9
        }),
        ("(b) penetration", "D, nm", |step| step.penetration / 1e-9),
    ],
    shows_peak: true,
};

impl Loading {
    pub(super) fn draw(&self, runner: &Runner) -> Result<Picture, XtaskError> {
        let case = |case| format!("cases/paper/{}-{case}", self.name);
        let runs = self
            .cases
            .iter()
            .map(|name| runner.run(&case(name), &[], "none"));
        let runs = runs.collect::<Result<Vec<_>, _>>()?;
        let mut notes = vec![format!("{}{}", self.coatings, self.remark)];
        let curves = self.curves.iter().zip(&runs);
        notes.extend(curves.map(|((name, _), run)| format!("{name}: {}", self.note(run))));
        let chart = Chart {
            name: self.name,
            caption: Caption {
                title: self.title,
                subtitle: runner.marked(self.subtitle),
                notes,
            },
            panel: (500.0, 500.0),
            margins: [44.0, 36.0, 76.0],
            legend: (2, 420.0),
            legend_from: 0,
            panels: self.views.map(|view| self.panel(&runs, view)).into(),
        };
        Ok(chart.draw())
    }

    /// The finite values of each run's steps over the load, with marks. The axes begin at 0.
    fn panel(&self, runs: &[RunSummary], (name, axis, value): View) -> CurvePanel {
        let line = |((name, pen), run): (&(&str, Pen), &RunSummary)| {
            let steps = run.steps.iter();
            let points = steps.map(|step| (step.force / self.load.1, value(step)));
            let finite = points.filter(|(_, y)| y.is_finite()).collect();
            ChartLine::new(*name, *pen, vec![finite]).marked()
        };
        let lines: Vec<_> = self.curves.iter().zip(runs).map(line).collect();
        let from_zero = |of: fn((f64, f64)) -> f64, title: &str| {
            let values = lines.iter().flat_map(ChartLine::points).map(of);
            Axis::new(0.0, 1.06 * values.fold(0.0, f64::max), title.into(), 6)
        };
        CurvePanel {
            name,
            title: name.into(),
            axes: [
                from_zero(|(x, _)| x, self.load.0),
                from_zero(|(_, y)| y, axis),
            ],
            lines,
        }
    }

    /// The note on a curve's data: its grid, its largest certificate, and the largest changes between grids.
    fn note(&self, run: &RunSummary) -> String {
        let largest = |of: fn(&StepSummary) -> f64| run.steps.iter().map(of).fold(0.0, f64::max);
        let certificate = largest(|step| step.certificate.worst);
        let penetration = largest(|step| last_change(step, |level| level.penetration).abs());
        let peak = largest(|step| last_change(step, |level| level.max_pressure).abs());
        let peak = if self.shows_peak {
            format!(", of the largest p ≤ {}", percent(peak))
        } else {
            String::new()
        };
        format!(
            "{n} × {n} elements, {} loads, certificates ≤ {}; change of D from the next coarser grid ≤ {}{peak}",
            run.steps.len(),
            power(certificate, 1),
            percent(penetration),
            n = run.grid.elements,
        )
    }
}
