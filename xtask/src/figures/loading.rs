//! Figures 4 and 6: two quantities against load, side by side.

use pellicle_cli::drawing::accuracy::{last_change, percent};
use pellicle_cli::drawing::colours::{GREEN, PURPLE};
use pellicle_cli::drawing::labels::power;
use pellicle_cli::drawing::{Axis, Dash};
use pellicle_cli::results::{RunSummary, StepSummary};

use super::chart::{Chart, ChartLine, CurvePanel, Pen};
use super::figure_2::MATERIALS;
use super::figure_5::{COATING, FILMS};
use super::runner::Runner;
use super::sheet::Picture;
use crate::XtaskError;

/// A figure of two views of the same curves.
pub(super) struct Loading {
    name: &'static str,
    title: &'static str,
    subtitle: &'static str,
    /// The first note.
    remark: [&'static str; 2],
    cases: &'static [&'static str],
    /// The name and the pen of each case's curve.
    curves: &'static [(&'static str, Pen)],
    /// The load's axis and its unit.
    load: (&'static str, f64),
    views: [View; 2],
    /// Whether the notes give the change of the largest pressure.
    shows_peak: bool,
}

/// One panel: a number of each step.
struct View {
    title: &'static str,
    axis: &'static str,
    value: fn(&StepSummary) -> f64,
}

/// Penetration and its derivative against load: two coatings with two periods each, under the same forces.
pub(super) const FIGURE_4: Loading = Loading {
    name: "fig4",
    title: "Fig. 4: penetration of a paraboloid into a textured coating against load",
    subtitle: "paraboloid of radius R; coating H = 10⁻⁴ R; cylinders r = 5·10⁻³ R, h = 10⁻⁴ R",
    remark: [
        MATERIALS,
        "; the same forces on both, in units of the stiff coating's E₁",
    ],
    cases: &[
        "fig4-stiff-60",
        "fig4-stiff-80",
        "fig4-soft-60",
        "fig4-soft-80",
    ],
    curves: &[
        ("stiff coating, T = R/60", (PURPLE, Dash::Dashed)),
        ("stiff coating, T = R/80", (PURPLE, Dash::Solid)),
        ("compliant coating, T = R/60", (GREEN, Dash::Dashed)),
        ("compliant coating, T = R/80", (GREEN, Dash::Solid)),
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

/// Largest pressure and penetration of the pyramid against load, with and without film, and with a stiffening film.
pub(super) const FIGURE_6: Loading = Loading {
    name: "fig6",
    title: "Fig. 6: Berkovich pyramid with a rounded tip, with and without film",
    subtitle: "tip radius 400 nm; coating H = 10 nm; film 5 nm thick, modulus 140 MPa, linear as printed or logarithmic",
    remark: [
        COATING,
        ". The last load, 2.3 mN, is that of Fig. 5; the film shortens by more than its thickness, as printed.",
    ],
    cases: &["fig6-film", "fig6-stiffening", "fig6-bare"],
    curves: &FILMS,
    load: ("Q, mN", 1e-3),
    views: [
        View {
            title: "(a) largest pressure",
            axis: "largest p, GPa",
            value: |step| step.summary.max_pressure / 1e9,
        },
        View {
            title: "(b) penetration",
            axis: "D, nm",
            value: |step| step.penetration / 1e-9,
        },
    ],
    shows_peak: true,
};

impl Loading {
    pub(super) fn draw(&self, runner: &Runner) -> Result<Picture, XtaskError> {
        let runs = self.cases.iter();
        let runs = runs.map(|case| runner.run(&format!("cases/paper/{case}"), &[]));
        let runs = runs.collect::<Result<Vec<_>, _>>()?;
        let mut notes = vec![self.remark.concat()];
        let curves = self.curves.iter().zip(&runs);
        notes.extend(curves.map(|((name, _), run)| format!("{name}: {}", self.note(run))));
        let panels = self.views.iter().map(|view| self.panel(view, &runs));
        let chart = Chart {
            name: self.name,
            caption: runner.caption(self.title, self.subtitle, notes),
            panel: (500.0, 500.0),
            margins: [44.0, 36.0, 76.0],
            legend: (2, 420.0),
            legend_from: 0,
            panels: panels.collect(),
        };
        Ok(chart.draw())
    }

    fn panel(&self, view: &View, runs: &[RunSummary]) -> CurvePanel {
        let point = |step: &StepSummary| (step.force / self.load.1, (view.value)(step));
        let curves = self.curves.iter().zip(runs);
        let lines = curves.map(|((name, pen), run)| {
            let points = run.steps.iter().map(point);
            let points = points.filter(|(_, y)| y.is_finite()).collect();
            ChartLine {
                is_marked: true,
                ..ChartLine::new(*name, *pen, vec![points])
            }
        });
        let lines: Vec<_> = lines.collect();
        let points = || lines.iter().flat_map(ChartLine::points);
        CurvePanel {
            name: view.title,
            title: view.title.into(),
            axes: [
                from_zero(points().map(|(x, _)| x), self.load.0),
                from_zero(points().map(|(_, y)| y), view.axis),
            ],
            lines,
        }
    }

    /// The note on a curve's data: its grid, its largest certificate, and the largest changes between grids.
    fn note(&self, run: &RunSummary) -> String {
        let largest = |of: fn(&StepSummary) -> f64| run.steps.iter().map(of).fold(0.0, f64::max);
        let certificate = largest(|step| step.certificate.worst);
        let penetration = largest(|step| last_change(step, |level| level.penetration).abs());
        let peak = if self.shows_peak {
            let peak = largest(|step| last_change(step, |level| level.max_pressure).abs());
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

/// An axis from 0 to slightly above the largest of these values.
fn from_zero(values: impl Iterator<Item = f64>, title: &str) -> Axis {
    let largest = values.fold(0.0, f64::max);
    Axis::new(0.0, 1.06 * largest, title.into(), 6)
}
