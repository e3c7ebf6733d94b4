//! Fig. 5: pressure under the Berkovich pyramid with and without film, and with a stiffening film.

use pellicle::display::{Unit, quantity};
use pellicle::input::units::Units;
use pellicle_cli::drawing::accuracy::UNRESOLVED;
use pellicle_plot::axes::panel::Axis;
use pellicle_plot::sheet::colours::{AMBER, PURPLE, SKY};
use pellicle_plot::sheet::svg::Dash;

use super::chart::{Chart, CurvePanel, Pen};
use super::pressures::{PressurePanel, Pressures, rounded_up};
use super::runner::{Case, Runner};
use super::sheet::{Caption, Picture};
use crate::XtaskError;

/// The coating of figures 5 and 6.
pub(super) const COATING: &str = "coating: E₁ = 70 GPa, E₁/E₂ = 10, ν₁ = 0.3, ν₂ = 0.4";

/// The films on the coating, and their lines; the last is drawn over the one before.
pub(super) const FILMS: [(&str, Pen); 3] = [
    ("with film", (SKY, Dash::Solid)),
    ("film that stiffens", (PURPLE, Dash::Solid)),
    ("without film", (AMBER, Dash::Dashed)),
];

const CASES: [Case<'_>; 3] = [
    ("cases/fig5-film", &[]),
    ("cases/paper/fig5-stiffening", &[]),
    ("cases/fig5-bare", &[]),
];

/// The units of the axes.
const UNITS: [(&str, f64); 2] = [("µm", 1e-6), ("GPa", 1e9)];

/// Draws the pressure as maps, as columns over the surface, and along the axis of symmetry. All panels have the same
/// limits of axes and colours.
pub(super) fn draw(runner: &Runner) -> Result<Vec<Picture>, XtaskError> {
    let steps = runner.steps(&CASES)?;
    let named = || steps.iter().zip(FILMS.map(|(name, _)| name));
    let remarks = [
        format!("{COATING}. Grey: film that carries nothing. {UNRESOLVED}."),
        "The film shortens by many times its thickness at this force, as printed: linear springs are used outside their validity.".into(),
        "The film that stiffens has logarithmic springs of the same thickness and modulus, and is never squeezed beyond its thickness.".into(),
    ];
    let notes = named().map(|(step, name)| step.note(name));
    let top = rounded_up(
        steps
            .iter()
            .map(|step| step.numbers.summary.max_pressure / UNITS[1].1),
    );
    let panels = named().map(|(step, name)| PressurePanel {
        title: format!(
            "{name}, D = {}",
            quantity(step.numbers.penetration, Unit::Metre, Units::Si)
        ),
        step,
        top,
        brightest: top,
    });
    let pressures = Pressures {
        caption: Caption {
            title: "Fig. 5: pressure under a Berkovich pyramid with a rounded tip",
            subtitle: runner.marked("Q = 2.3 mN; tip radius 400 nm; coating H = 10 nm; film 5 nm thick, modulus 140 MPa"),
            notes: remarks.into_iter().chain(notes).collect(),
        },
        units: UNITS,
        panels: panels.collect(),
    };
    let mut pictures = pressures.draw(["fig5-map", "fig5-surface"]);
    pictures.push(profiles(pressures).draw());
    Ok(pictures)
}

/// A chart of the pressures along x beside the axis, in one panel.
fn profiles(pressures: Pressures<'_>) -> Chart {
    let pens = FILMS.iter().enumerate();
    let lines = pens.map(|(i, (_, pen))| pressures.profile(i, *pen));
    let top = 1.06 * pressures.panels[0].top;
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
                pressures.axis("x", 8),
                Axis::new(0.0, top, "p beside the axis, GPa".into(), 5),
            ],
            lines: lines.collect(),
        }],
        caption: pressures.caption,
    }
}
