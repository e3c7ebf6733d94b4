//! Fig. 2: pressure under the paraboloid on the compliant (a, c) and the stiff (b, d) coating, small and large load.

use pellicle_cli::drawing::accuracy::UNRESOLVED;
use pellicle_plot::axes::labels::power;
use pellicle_plot::sheet::colours::BLUE;
use pellicle_plot::sheet::svg::Dash;
use pellicle_plot::step::{pressure_map, section};

use super::chart::COLUMNS;
use super::pressures::{PressurePanel, Pressures, rounded_up};
use super::runner::{Case, Runner, SolvedStep};
use super::sheet::{Caption, Picture, csv};
use crate::XtaskError;

/// The two coatings of figures 2 to 4.
pub(super) const MATERIALS: &str = "compliant coating: E₁/E₂ = 0.1, ν₁ = 0.4, ν₂ = 0.3; stiff coating: E₁/E₂ = 10, ν₁ = 0.3, ν₂ = 0.4";

/// Body and indenter of figures 2 and 3.
pub(super) const TEXTURED: &str =
    "paraboloid of radius R; coating H = 10⁻⁴ R; cylinders r = 5·10⁻³ R, h = 10⁻⁴ R, T = R/80";

/// Panels (a) to (d): the axes of all have the same length, so the small domains are widened to that of (c).
pub(super) const CASES: [Case<'_>; 4] = [
    ("cases/fig2a", &["grid.side=0.12"]),
    ("cases/fig2b", &["grid.side=0.12"]),
    ("cases/fig2c", &[]),
    ("cases/fig2d", &[]),
];

/// The coatings of alternate panels, and E₁ over that of the stiff one. The paper's two materials change places, so the
/// compliant coating's modulus is a tenth. Axes whose ends differ by a factor of ten in units of E₁ are the same axis.
const COATINGS: [(&str, f64); 2] = [("compliant", 0.1), ("stiff", 1.0)];

/// The percentage of the elements in contact whose pressures a map's colours distinguish: an edge peak would give all
/// the others the same dark colour.
const COLOURED: usize = 95;

/// Draws the pressure as maps and as columns over the surface, and panel (c) in the program's style for the README.
/// Equal heights are equal pressures in all panels; equal map colours are equal pressures for the same coating.
pub(super) fn draw(runner: &Runner) -> Result<Vec<Picture>, XtaskError> {
    let steps = runner.steps(&CASES)?;
    let named = || steps.iter().zip(["(a)", "(b)", "(c)", "(d)"]);
    let remarks = [
        format!("{MATERIALS}. Grey: relief that carries nothing."),
        "E₁ of (a), (c) is a tenth of E₁ of (b), (d): equal heights are equal pressures in all panels. A cell has the largest of its elements."
            .into(),
        format!("Colours of the maps end where {COLOURED} % of the contact lies below. {UNRESOLVED}."),
    ];
    let notes = named().map(|(step, name)| step.note(name));
    let peaks = steps.iter().zip(COATINGS.iter().cycle());
    let top =
        rounded_up(peaks.map(|(step, (_, modulus))| step.numbers.summary.max_pressure * modulus));
    let panels = named().enumerate().map(|(i, (step, name))| {
        let (coating, modulus) = COATINGS[i % 2];
        let force = power(step.numbers.force, 5);
        let depth = power(step.numbers.penetration, 4);
        PressurePanel {
            title: format!("{name} {coating} coating, Q = {force} E₁R², D = {depth} R"),
            step,
            top: top / modulus,
            brightest: rounded_up(steps.iter().skip(i % 2).step_by(2).map(common_peak)),
        }
    });
    let pressures = Pressures {
        caption: Caption {
            title: "Fig. 2: pressure on a textured coating",
            subtitle: runner.marked(TEXTURED),
            notes: remarks.into_iter().chain(notes).collect(),
        },
        units: [("R", 1.0), ("E₁", 1.0)],
        panels: panels.collect(),
    };
    let mut pictures = pressures.draw(["fig2-map", "fig2-surface"]);
    let profile = pressures.profile(2, (BLUE, Dash::Solid));
    let csv = csv(COLUMNS, profile.rows("pressure along x"));
    let subject = steps[2].subject();
    for (name, svg) in [
        ("fig2c", pressure_map::draw(&subject)),
        ("fig2c-section", section::draw(&subject)),
    ] {
        let csv = csv.clone();
        pictures.push(Picture {
            name: name.into(),
            svg,
            csv,
        });
    }
    Ok(pictures)
}

/// The pressure below which all but a few of the elements in contact lie.
fn common_peak(step: &SolvedStep) -> f64 {
    let pressures = step.fields().pressure.iter().copied();
    let mut in_contact: Vec<f64> = pressures.filter(|p| *p > 0.0).collect();
    in_contact.sort_by(f64::total_cmp);
    let at = in_contact.len() * COLOURED / 100;
    in_contact.get(at).copied().unwrap_or(0.0)
}
