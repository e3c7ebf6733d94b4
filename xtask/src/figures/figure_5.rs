//! Fig. 5: pressure under the Berkovich pyramid with and without film, and with a stiffening film.

use pellicle_cli::drawing::accuracy::BRACKETS;
use pellicle_cli::drawing::{Axis, Dash, colours};
use pellicle_cli::{DisplayUnit, Unit, Units, quantity};

use super::chart::{Chart, CurvePanel, Pen};
use super::pressures::{PressurePanel, Pressures, reach, rounded_up};
use super::runner::{Runner, SolvedStep};
use super::sheet::Picture;
use crate::XtaskError;

/// The coating of figures 5 and 6.
pub(super) const COATING: &str = "coating: E₁ = 70 GPa, E₁/E₂ = 10, ν₁ = 0.3, ν₂ = 0.4";

/// The films on the coating, and their lines; the last is drawn over the one before.
pub(super) const FILMS: [(&str, Pen); 3] = [
    ("with film", (colours::SKY, Dash::Solid)),
    ("film that stiffens", (colours::PURPLE, Dash::Solid)),
    ("without film", (colours::AMBER, Dash::Dashed)),
];

const CASES: [&str; 3] = [
    "cases/fig5-film",
    "cases/paper/fig5-stiffening",
    "cases/fig5-bare",
];

/// Draws the pressure as maps, as columns over the surface, and along the axis of symmetry.
pub(super) fn draw(runner: &Runner) -> Result<Vec<Picture>, XtaskError> {
    let steps = CASES.map(|case| runner.step(case, &[], 0));
    let steps = steps.into_iter().collect::<Result<Vec<_>, _>>()?;
    let pressures = pressures(runner, &steps);
    let mut pictures = Vec::from(pressures.draw("fig5-map", "fig5-surface"));
    pictures.push(profiles(pressures).draw());
    Ok(pictures)
}

/// All panels have the same limits of axes and colours.
fn pressures<'a>(runner: &Runner, steps: &'a [SolvedStep]) -> Pressures<'a> {
    let mut notes = vec![
        format!("{COATING}. Grey: film that carries nothing. {BRACKETS}."),
        "The film shortens by many times its thickness at this force, as printed: linear springs are used outside their validity.".into(),
        "The film that stiffens has logarithmic springs of the same thickness and modulus, and is never squeezed beyond its thickness.".into(),
    ];
    let peaks = || steps.iter().map(|step| step.numbers().summary.max_pressure);
    let pascals = DisplayUnit::of(peaks().fold(0.0, f64::max), Unit::Pascal, Units::Si);
    let top = rounded_up(peaks().map(|peak| peak / pascals.divisor));
    let mut panels = Vec::new();
    for (step, (name, _)) in steps.iter().zip(FILMS) {
        notes.push(step.note(name));
        let depth = quantity(step.numbers().penetration, Unit::Metre, Units::Si);
        panels.push(PressurePanel {
            title: format!("{name}, D = {depth}"),
            step,
            top,
            brightest: top,
        });
    }
    let reach = reach(steps);
    let metres = DisplayUnit::of(reach, Unit::Metre, Units::Si);
    Pressures {
        caption: runner.caption(
            "Fig. 5: pressure under a Berkovich pyramid with a rounded tip",
            "Q = 2.3 mN; tip radius 400 nm; coating H = 10 nm; film 5 nm thick, modulus 140 MPa",
            notes,
        ),
        reach: reach / metres.divisor,
        metres,
        pascals,
        panels,
    }
}

/// A chart of the pressures along x beside the axis, in one panel.
fn profiles(pressures: Pressures<'_>) -> Chart {
    let pens = FILMS.iter().enumerate();
    let lines = pens.map(|(i, (_, pen))| pressures.profile(i, *pen));
    let along = format!("x, {}", pressures.metres.label);
    let pressure = format!("p beside the axis, {}", pressures.pascals.label);
    Chart {
        name: "fig5-profile",
        panel: (1060.0, 440.0),
        margins: [10.0, 40.0, 76.0],
        legend: (3, 360.0),
        legend_from: 0,
        panels: vec![CurvePanel {
            name: "along x",
            title: String::new(),
            axes: [
                Axis::new(-pressures.reach, pressures.reach, along, 8),
                Axis::new(0.0, 1.06 * pressures.panels[0].top, pressure, 5),
            ],
            lines: lines.collect(),
        }],
        caption: pressures.caption,
    }
}
