//! Fig. 2: pressure under the paraboloid on the compliant (a, c) and the stiff (b, d) coating, small and large load.

use pellicle_cli::DisplayUnit;
use pellicle_cli::drawing::accuracy::BRACKETS;
use pellicle_cli::drawing::labels::power;
use pellicle_cli::drawing::{Dash, colours, pressure_map, section};

use super::chart;
use super::pressures::{PressurePanel, Pressures, reach, rounded_up};
use super::runner::{Runner, SolvedStep};
use super::sheet::Picture;
use crate::XtaskError;

/// The two coatings of figures 2 to 4.
pub(super) const MATERIALS: &str = "compliant coating: E₁/E₂ = 0.1, ν₁ = 0.4, ν₂ = 0.3; stiff coating: E₁/E₂ = 10, ν₁ = 0.3, ν₂ = 0.4";

/// Body and indenter of figures 2 and 3.
pub(super) const TEXTURED: &str =
    "paraboloid of radius R; coating H = 10⁻⁴ R; cylinders r = 5·10⁻³ R, h = 10⁻⁴ R, T = R/80";

/// The panels and their cases.
const PANELS: [(&str, &str); 4] = [
    ("(a)", "cases/fig2a"),
    ("(b)", "cases/fig2b"),
    ("(c)", "cases/fig2c"),
    ("(d)", "cases/fig2d"),
];

/// The coatings of alternate panels, and E₁ over that of the stiff one. The paper's two materials change places, so the
/// compliant coating's modulus is a tenth. Axes whose ends differ by a factor of ten in units of E₁ are the same axis.
const COATINGS: [(&str, f64); 2] = [("compliant", 0.1), ("stiff", 1.0)];

/// The fraction of the elements in contact whose pressures a map's colours distinguish: an edge peak would give all the
/// others the same dark colour.
const COLOURED_SHARE: f64 = 0.95;

/// Draws the pressure as maps and as columns over the surface, and panel (c) in the program's style for the README.
pub(super) fn draw(runner: &Runner) -> Result<Vec<Picture>, XtaskError> {
    let steps = PANELS.map(|(_, case)| runner.step(case, sets(case), 0));
    let steps = steps.into_iter().collect::<Result<Vec<_>, _>>()?;
    let pressures = pressures(runner, &steps);
    let mut pictures = Vec::from(pressures.draw("fig2-map", "fig2-surface"));
    pictures.extend(of_the_readme(&steps[2], &pressures));
    Ok(pictures)
}

/// The values replaced in a case: the axes of all panels have the same length, so the small domains are widened to that
/// of (c).
pub(super) fn sets(case: &str) -> &'static [&'static str] {
    match case {
        "cases/fig2a" | "cases/fig2b" => &["grid.side=0.12"],
        _ => &[],
    }
}

/// Equal heights are equal pressures in all panels; equal map colours are equal pressures for the same coating.
fn pressures<'a>(runner: &Runner, steps: &'a [SolvedStep]) -> Pressures<'a> {
    let mut notes = vec![
        format!("{MATERIALS}. Grey: relief that carries nothing."),
        "E₁ of (a), (c) is a tenth of E₁ of (b), (d): equal heights are equal pressures in all panels. A cell has the largest of its elements."
            .into(),
        format!("Colours of the maps end where {} % of the contact lies below. {BRACKETS}.", power(100.0 * COLOURED_SHARE, 2)),
    ];
    let peaks = steps.iter().zip(COATINGS.iter().cycle());
    let top =
        rounded_up(peaks.map(|(step, (_, modulus))| step.numbers().summary.max_pressure * modulus));
    let mut panels = Vec::new();
    for (i, (step, (name, _))) in steps.iter().zip(PANELS).enumerate() {
        notes.push(step.note(name));
        let (coating, modulus) = COATINGS[i % 2];
        let force = power(step.numbers().force, 5);
        let depth = power(step.numbers().penetration, 4);
        panels.push(PressurePanel {
            title: format!("{name} {coating} coating, Q = {force} E₁R², D = {depth} R"),
            step,
            top: top / modulus,
            brightest: rounded_up(steps.iter().skip(i % 2).step_by(2).map(common_peak)),
        });
    }
    let in_units_of = |label: &str| DisplayUnit {
        divisor: 1.0,
        label: label.into(),
    };
    Pressures {
        caption: runner.caption("Fig. 2: pressure on a textured coating", TEXTURED, notes),
        metres: in_units_of("R"),
        pascals: in_units_of("E₁"),
        reach: reach(steps),
        panels,
    }
}

/// The map and the section of Fig. 2(c) in the program's style.
fn of_the_readme(step: &SolvedStep, pressures: &Pressures<'_>) -> [Picture; 2] {
    let profile = [pressures.profile(2, (colours::BLUE, Dash::Solid))];
    let csv = chart::csv([("pressure along x", profile.as_slice())]);
    let subject = step.subject(&step.summary.title);
    let picture = |name, svg, width| Picture {
        name,
        svg,
        width,
        csv: csv.clone(),
    };
    [
        picture("fig2c", pressure_map::draw(&subject), pressure_map::WIDTH),
        picture("fig2c-section", section::draw(&subject), section::WIDTH),
    ]
}

/// The pressure below which all but a few of the elements in contact lie.
fn common_peak(step: &SolvedStep) -> f64 {
    let fields = step.fields();
    let in_contact = fields.pressure.iter().copied().filter(|p| *p > 0.0);
    let mut pressures: Vec<f64> = in_contact.collect();
    pressures.sort_by(f64::total_cmp);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a part of a length"
    )]
    let at = (COLOURED_SHARE * pressures.len() as f64) as usize;
    pressures.get(at).copied().unwrap_or(0.0)
}
