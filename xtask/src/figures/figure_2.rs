//! Fig. 2: pressure under the paraboloid on the compliant (a, c) and the stiff (b, d) coating, small and large load.

use pellicle_cli::Scale;
use pellicle_cli::drawing::Style;
use pellicle_cli::drawing::Subject;
use pellicle_cli::drawing::accuracy::BRACKETS;
use pellicle_cli::drawing::labels::power;
use pellicle_cli::drawing::{colours, pressure_map, section};

use super::chart;
use super::pressures::{Pressures, Shown, reach, rounded_up};
use super::runner::{Runner, SolvedStep};
use super::sheet::{Caption, MATERIALS, Picture, TEXTURED};
use crate::XtaskError;

/// The panels and their cases.
const PANELS: [(&str, &str); 4] = [
    ("(a)", "cases/fig2a"),
    ("(b)", "cases/fig2b"),
    ("(c)", "cases/fig2c"),
    ("(d)", "cases/fig2d"),
];

/// E₁ of a panel's coating over E₁ of the stiff one: the paper's two materials change places, so the compliant
/// coating's modulus is a tenth. Axes whose ends are ten to one in units of E₁ are the same axis.
const MODULI: [f64; 4] = [0.1, 1.0, 0.1, 1.0];

/// The part of the elements in contact whose pressures the colours of a map tell apart: an edge peak would leave the
/// same dark colour to all the rest.
const TOLD_APART: f64 = 0.95;

/// The pressure as maps, and as columns over the surface; and panel (c) as the program draws it, for the README.
pub(super) fn draw(runner: &Runner) -> Result<Vec<Picture>, XtaskError> {
    let steps = PANELS.iter().map(|(_, case)| runner.step(case, 0));
    let steps = steps.collect::<Result<Vec<_>, _>>()?;
    let pressures = Pressures {
        caption: Caption {
            title: "Fig. 2: pressure on a textured coating",
            subtitle: format!("{}{TEXTURED}", runner.mark()),
            notes: notes(&steps),
        },
        metres: in_units_of("R"),
        reach: reach(&steps),
        panels: panels(&steps),
    };
    let mut pictures = Vec::from(pressures.draw("fig2-map", "fig2-surface"));
    pictures.extend(of_the_readme(&pressures, &steps[2]));
    Ok(pictures)
}

/// The map and the section of Fig. 2(c) as the program draws them.
fn of_the_readme(pressures: &Pressures<'_>, step: &SolvedStep) -> [Picture; 2] {
    let subject = Subject {
        title: &step.summary.title,
        units: step.summary.units,
        relief_height: step.summary.relief_height(),
        step: step.numbers(),
        fields: step.fields(),
        style: Style::default(),
    };
    let profile = [pressures.profile(2, colours::BLUE)];
    let csv = chart::csv([("pressure along x", profile.as_slice())]);
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

/// Heights are the same pressure in all panels, colours of the maps in those of one coating.
fn panels<'a>(steps: &'a [SolvedStep]) -> Vec<Shown<'a>> {
    let peaks = steps.iter().zip(MODULI);
    let top = rounded_up(peaks.map(|(step, modulus)| step.numbers().max_pressure * modulus));
    let brightest = [0, 1].map(|coating| {
        let panels = [&steps[coating], &steps[coating + 2]];
        rounded_up(panels.into_iter().map(common_peak))
    });
    let panel = |(i, step): (usize, &'a SolvedStep)| Shown {
        title: title(i, step),
        step,
        pascals: in_units_of("E₁"),
        top: top / MODULI[i],
        brightest: brightest[i % 2],
    };
    steps.iter().enumerate().map(panel).collect()
}

fn title(i: usize, step: &SolvedStep) -> String {
    let (name, coating, step) = (PANELS[i].0, ["compliant", "stiff"][i % 2], step.numbers());
    let (force, depth) = (power(step.force, 5), power(step.penetration, 4));
    format!("{name} {coating} coating, Q = {force} E₁R², D = {depth} R")
}

fn notes(steps: &[SolvedStep]) -> Vec<String> {
    let mut notes = vec![
        format!("{MATERIALS}. Grey: relief that carries nothing."),
        "E₁ of (a), (c) is a tenth of E₁ of (b), (d): equal heights are equal pressures in all panels. A cell has the largest of its elements."
            .into(),
        format!("Colours of the maps end where {} % of the contact lies below. {BRACKETS}.", power(100.0 * TOLD_APART, 2)),
    ];
    let data = steps.iter().zip(PANELS);
    notes.extend(data.map(|(step, (name, _))| step.note(name)));
    notes
}

/// The pressure that all but a few of the elements in contact stay below.
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
    let at = (TOLD_APART * pressures.len() as f64) as usize;
    pressures.get(at).copied().unwrap_or(0.0)
}

/// A unit of the paper's system.
fn in_units_of(label: &str) -> Scale {
    Scale {
        divisor: 1.0,
        label: label.to_owned(),
    }
}
