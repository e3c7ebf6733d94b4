//! Fig. 5: pressure under the Berkovich pyramid with and without film, and with a film that stiffens.

use pellicle_cli::Units;
use pellicle_cli::drawing::Axis;
use pellicle_cli::drawing::Rect;
use pellicle_cli::drawing::accuracy::BRACKETS;
use pellicle_cli::{Scale, Unit, quantity};

use super::chart::{self, AXIS, ChartLine, LEFT};
use super::pressures::{FILMS_AND_BARE, Pressures, Shown, reach, rounded_up};
use super::runner::{Runner, SolvedStep};
use super::sheet::{Caption, Picture, Sheet};
use crate::XtaskError;

/// The panels and their cases.
const PANELS: [(&str, &str); 3] = [
    ("with film", "cases/fig5-film"),
    ("film that stiffens", "cases/paper/fig5-stiffening"),
    ("without film", "cases/fig5-bare"),
];

/// Of the profiles, in pixels.
const LEGEND: f64 = 50.0;
const PLACE: Rect = Rect {
    left: LEFT,
    top: Sheet::TOP + LEGEND,
    width: 1060.0,
    height: 440.0,
};

/// The pressure as maps, as columns over the surface, and along the axis of symmetry.
pub(super) fn draw(runner: &Runner) -> Result<Vec<Picture>, XtaskError> {
    let steps = PANELS.iter().map(|(_, case)| runner.step(case, 0));
    let steps = steps.collect::<Result<Vec<_>, _>>()?;
    let reach = reach(&steps);
    let metres = Scale::of(reach, Unit::Metre, Units::Si);
    let pressures = Pressures {
        caption: Caption {
            title: "Fig. 5: pressure under a Berkovich pyramid with a rounded tip",
            subtitle: format!(
                "{}Q = 2.3 mN; tip radius 400 nm; coating H = 10 nm; film 5 nm thick, modulus 140 MPa",
                runner.mark()
            ),
            notes: notes(&steps),
        },
        reach: reach / metres.divisor,
        metres,
        panels: panels(&steps),
    };
    let mut pictures = Vec::from(pressures.draw("fig5-map", "fig5-surface"));
    pictures.push(profiles(&pressures));
    Ok(pictures)
}

/// The same ends of axes and colours in all panels.
fn panels<'a>(steps: &'a [SolvedStep]) -> Vec<Shown<'a>> {
    let peaks = || steps.iter().map(|step| step.numbers().max_pressure);
    let pascals = Scale::of(peaks().fold(0.0, f64::max), Unit::Pascal, Units::Si);
    let top = rounded_up(peaks().map(|peak| peak / pascals.divisor));
    let panel = |(step, (name, _)): (&'a SolvedStep, (&str, &str))| {
        let depth = quantity(step.numbers().penetration, Unit::Metre, Units::Si);
        Shown {
            title: format!("{name}, D = {depth}"),
            step,
            pascals: pascals.clone(),
            top,
            brightest: top,
        }
    };
    steps.iter().zip(PANELS).map(panel).collect()
}

fn notes(steps: &[SolvedStep]) -> Vec<String> {
    let mut notes = vec![
        format!("coating: E₁ = 70 GPa, E₁/E₂ = 10, ν₁ = 0.3, ν₂ = 0.4. Grey: film that carries nothing. {BRACKETS}."),
        "The film shortens by many times its thickness at this force, as printed: linear springs are used outside their validity.".into(),
        "The film that stiffens has logarithmic springs of the same thickness and modulus, and is never squeezed beyond its thickness.".into(),
    ];
    let data = steps.iter().zip(PANELS);
    notes.extend(data.map(|(step, (name, _))| step.note(name)));
    notes
}

/// The pressures along x beside the axis, in one panel.
fn profiles(pressures: &Pressures<'_>) -> Picture {
    let size = (PLACE.right() + 40.0, LEGEND + PLACE.height + AXIS);
    let mut sheet = Sheet::new(size, &pressures.caption);
    let drawn = FILMS_AND_BARE.into_iter().enumerate();
    let lines = drawn.map(|(i, (colour, dash))| ChartLine {
        dash,
        ..pressures.profile(i, colour)
    });
    let lines: Vec<ChartLine> = lines.collect();
    let (reach, panel) = (pressures.reach, &pressures.panels[0]);
    let along = format!("x, {}", pressures.metres.label);
    let pressure = format!("p beside the axis, {}", panel.pascals.label);
    let axes = [
        Axis::new(-reach, reach, along, 8),
        Axis::new(0.0, 1.06 * panel.top, pressure, 5),
    ];
    chart::draw(&mut sheet.svg, "", PLACE, axes, &lines);
    chart::legend(&mut sheet.svg, (3, 360.0), &lines);
    sheet.finish("fig5-profile", chart::csv([("along x", lines.as_slice())]))
}
