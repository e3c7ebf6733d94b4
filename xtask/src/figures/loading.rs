//! Figures 4 and 6: curves over the load.

use pellicle_cli::case::units::Units;
use pellicle_cli::display::{Unit, quantity};
use pellicle_cli::output::summary::StepSummary;
use pellicle_cli::picture::colours::{self, Colour};
use pellicle_cli::picture::svg::{Dash, Place};

use super::line::{self, Line};
use super::parameters::{Parameters, short};
use super::picture::Picture;
use super::sheet::Sheet;
use super::studio::{PEAK, PENETRATION, Studio};
use super::{chart, note};
use crate::{PaperCase, PaperRun, XtaskError};

/// In pixels.
const LEFT: f64 = 112.0;
const SIDE: f64 = 500.0;
const COLUMN: f64 = LEFT + SIDE + 36.0;
const LEGEND: f64 = 66.0;
const HEIGHT: f64 = LEGEND + 44.0 + SIDE + 76.0;

/// The coating with and without film.
pub(super) const FILM: Colour = colours::SKY;
pub(super) const BARE: Colour = colours::AMBER;

/// A curve of a figure: the run, its name, how it is drawn.
struct Curve {
    run: PaperRun,
    name: &'static str,
    colour: Colour,
    dash: Dash,
}

/// One panel: what is shown of each step, in what unit.
struct View {
    title: &'static str,
    y: &'static str,
    value: fn(&StepSummary) -> f64,
}

/// The load's axis: its title and what a force is divided by.
struct LoadAxis {
    title: &'static str,
    divisor: f64,
}

/// Fig. 4: penetration, and its derivative, over the load.
pub(super) fn figure_4(studio: &mut Studio<'_>) -> Result<Vec<Picture>, XtaskError> {
    let mut curve = |case, name, colour, dash| -> Result<Curve, XtaskError> {
        let run = studio.path(case, &[PENETRATION])?;
        Ok(Curve {
            run,
            name,
            colour,
            dash,
        })
    };
    let (compliant, stiff) = (colours::GREEN, colours::PURPLE);
    let curves = [
        curve(
            PaperCase::Fig4Stiff60,
            "stiff coating, T = R/60",
            stiff,
            Dash::Dashed,
        )?,
        curve(
            PaperCase::Fig4Stiff80,
            "stiff coating, T = R/80",
            stiff,
            Dash::Solid,
        )?,
        curve(
            PaperCase::Fig4Soft60,
            "compliant coating, T = R/60",
            compliant,
            Dash::Dashed,
        )?,
        curve(
            PaperCase::Fig4Soft80,
            "compliant coating, T = R/80",
            compliant,
            Dash::Solid,
        )?,
    ];
    let views = [
        View {
            title: "penetration",
            y: "D, 10⁻³ R",
            value: |step| step.penetration / 1e-3,
        },
        View {
            title: "its derivative, the inverse of the contact stiffness",
            y: "dD/dQ, 1/(E₁R)",
            value: |step| 1.0 / step.contact_stiffness.unwrap_or(f64::NAN),
        },
    ];
    let load = LoadAxis {
        title: "Q, 10⁻⁵ E₁R² (E₁ of the stiff coating)",
        divisor: 1e-5,
    };
    let [stiff, compliant] = [1, 3].map(|i: usize| Parameters::of(&curves[i].run));
    let subtitle = format!(
        "{}paraboloid of radius R; coating {}; cylinders {}",
        studio.quality.mark(),
        stiff.thickness(),
        stiff.cylinders()
    );
    let materials = format!(
        "compliant coating: {}; stiff coating: {}; the same forces on both, in units of the stiff coating's E₁",
        compliant.materials(),
        stiff.materials()
    );
    let notes = notes(materials, &curves, false);
    let title = "Fig. 4: penetration of a paraboloid into a textured coating against load";
    let sheet = Sheet::new((2.0 * COLUMN, HEIGHT), title, &subtitle, &notes);
    Ok(vec![draw("fig4", sheet, &curves, &load, &views)])
}

/// Fig. 6: largest pressure and penetration of the pyramid over the load, with and without film.
pub(super) fn figure_6(studio: &mut Studio<'_>) -> Result<Vec<Picture>, XtaskError> {
    let mut curve = |case, name, colour| -> Result<Curve, XtaskError> {
        let (run, dash) = (studio.path(case, &[PENETRATION, PEAK])?, Dash::Solid);
        Ok(Curve {
            run,
            name,
            colour,
            dash,
        })
    };
    let curves = [
        curve(PaperCase::Fig6Film, "with film", FILM)?,
        curve(PaperCase::Fig6Bare, "without film", BARE)?,
    ];
    let views = [
        View {
            title: "(a) largest pressure",
            y: "largest p, GPa",
            value: |step| step.max_pressure / 1e9,
        },
        View {
            title: "(b) penetration",
            y: "D, nm",
            value: |step| step.penetration / 1e-9,
        },
    ];
    let load = LoadAxis {
        title: "Q, mN",
        divisor: 1e-3,
    };
    let film = Parameters::of(&curves[0].run);
    let subtitle = format!(
        "{}tip radius {}; coating {}; film {}",
        studio.quality.mark(),
        film.tip_radius(),
        film.thickness(),
        film.film()
    );
    let force = quantity(curves[0].run.last().force, Unit::Newton, Units::Si);
    let remark = format!(
        "coating: {}, {}. The last load, {}, is that of Fig. 5; the film shortens by more than its thickness, as printed.",
        film.modulus(),
        film.materials(),
        short(&force)
    );
    let notes = notes(remark, &curves, true);
    let title = "Fig. 6: Berkovich pyramid with a rounded tip, with and without film";
    let sheet = Sheet::new((2.0 * COLUMN, HEIGHT), title, &subtitle, &notes);
    Ok(vec![draw("fig6", sheet, &curves, &load, &views)])
}

fn notes(first: String, curves: &[Curve], with_peak: bool) -> Vec<String> {
    let data = curves
        .iter()
        .map(|curve| format!("{}: {}", curve.name, note::of_path(&curve.run, with_peak)));
    std::iter::once(first).chain(data).collect()
}

/// Draws every view of the curves side by side, and the legend above.
fn draw(
    name: &'static str,
    mut sheet: Sheet,
    curves: &[Curve],
    load: &LoadAxis,
    views: &[View; 2],
) -> Picture {
    let drawn = views
        .each_ref()
        .map(|view| (view.title, lines(curves, load, view)));
    for (i, (view, (title, lines))) in views.iter().zip(&drawn).enumerate() {
        let place = Place {
            left: COLUMN * i as f64 + LEFT,
            top: Sheet::TOP + LEGEND + 44.0,
            width: SIDE,
            height: SIDE,
        };
        let points = || lines.iter().flat_map(Line::points);
        let axes = (
            chart::from_zero(points().map(|(x, _)| x), load.title),
            chart::from_zero(points().map(|(_, y)| y), view.y),
        );
        chart::draw(&mut sheet.svg, title, place, axes, lines);
    }
    let entries: Vec<&Line> = drawn[0].1.iter().collect();
    let rows: Vec<_> = entries.chunks(2).collect();
    chart::legend(&mut sheet.svg, (LEFT, Sheet::TOP + 12.0), 420.0, &rows);
    let csv = line::csv(
        drawn
            .iter()
            .map(|(title, lines)| (*title, lines.as_slice())),
    );
    sheet.finish(name, csv)
}

fn lines(curves: &[Curve], load: &LoadAxis, view: &View) -> Vec<Line> {
    let line = |curve: &Curve| Line {
        name: curve.name.to_owned(),
        colour: curve.colour,
        dash: curve.dash,
        width: Line::WIDTH,
        is_marked: true,
        parts: vec![points(&curve.run, load, view)],
    };
    curves.iter().map(line).collect()
}

fn points(run: &PaperRun, load: &LoadAxis, view: &View) -> Vec<(f64, f64)> {
    let point = |step: &StepSummary| (step.force / load.divisor, (view.value)(step));
    run.steps()
        .iter()
        .map(point)
        .filter(|(_, y)| y.is_finite())
        .collect()
}
