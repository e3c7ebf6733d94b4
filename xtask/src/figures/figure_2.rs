//! Fig. 2: pressure under the paraboloid on the compliant (a, c) and the stiff (b, d) coating, small and large load.

use pellicle_cli::Scale;
use pellicle_cli::drawing::Dash;
use pellicle_cli::drawing::Style;
use pellicle_cli::drawing::Subject;
use pellicle_cli::drawing::labels::power;
use pellicle_cli::drawing::{colours, pressure_map, section};

use super::line::{self, Line};
use super::note;
use super::parameters::Parameters;
use super::picture::Picture;
use super::pressure_sheet::{Common, Shown, maps, surfaces};
use super::pressures::{Loaded, TOLD_APART, reach, rounded_up};
use super::studio::Studio;
use crate::XtaskError;

/// Names of the panels.
const PANELS: [&str; 4] = ["(a)", "(b)", "(c)", "(d)"];

/// E₁ of a panel's coating over E₁ of the stiff one: the paper's two materials change places, so the compliant
/// coating's modulus is a tenth. Axes whose ends are ten to one in units of E₁ are the same axis.
const MODULI: [f64; 4] = [0.1, 1.0, 0.1, 1.0];

/// The pressure as maps, and as columns over the surface.
pub(super) fn draw(studio: &mut Studio<'_>) -> Result<Vec<Picture>, XtaskError> {
    let cases = ["cases/fig2a", "cases/fig2b", "cases/fig2c", "cases/fig2d"];
    let loaded = Loaded::all(studio, cases)?;
    let case = Parameters::of(&loaded[0].run).textured_coating();
    let subtitle = format!("{}{case}", studio.quality.mark());
    let notes = notes(&loaded);
    let common = Common {
        title: "Fig. 2: pressure on a textured coating",
        subtitle: &subtitle,
        notes: &notes,
        metres: in_units_of("R"),
        reach: reach(&loaded),
    };
    let panels = panels(&loaded);
    let [map, section] = of_the_readme(&common, &loaded[2], &panels[2]);
    Ok(vec![
        maps("fig2-map", &common, &panels),
        surfaces("fig2-surface", &common, &panels),
        map,
        section,
    ])
}

/// The map and the section of Fig. 2(c) as the program draws them.
fn of_the_readme(common: &Common<'_>, loaded: &Loaded, shown: &Shown<'_>) -> [Picture; 2] {
    let summary = &loaded.run.summary;
    let subject = Subject {
        title: &summary.title,
        units: summary.units,
        relief_height: summary.relief_height(),
        step: loaded.run.last(),
        fields: shown.fields,
        style: Style::default(),
    };
    let profile = Line {
        name: shown.title.clone(),
        colour: colours::BLUE,
        dash: Dash::Solid,
        width: Line::WIDTH,
        is_marked: false,
        parts: vec![common.profile(shown)],
    };
    let csv = line::csv([("pressure along x", [profile].as_slice())]);
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
fn panels<'a>(loaded: &'a [Loaded]) -> Vec<Shown<'a>> {
    let peaks = loaded
        .iter()
        .zip(MODULI)
        .map(|(loaded, modulus)| loaded.peak() * modulus);
    let top = rounded_up(peaks);
    let brightest = [0, 1].map(|coating| {
        let panels = [&loaded[coating], &loaded[coating + 2]];
        rounded_up(panels.into_iter().map(Loaded::common_peak))
    });
    let panel = |(i, loaded): (usize, &'a Loaded)| Shown {
        title: title(i, loaded),
        fields: loaded.stored.fields(loaded.run.side()),
        pascals: in_units_of("E₁"),
        top: top / MODULI[i],
        brightest: brightest[i % 2],
    };
    loaded.iter().enumerate().map(panel).collect()
}

fn title(i: usize, loaded: &Loaded) -> String {
    let step = loaded.run.last();
    let coating = ["compliant", "stiff"][i % 2];
    let (name, force, depth) = (PANELS[i], power(step.force, 5), power(step.penetration, 4));
    format!("{name} {coating} coating, Q = {force} E₁R², D = {depth} R")
}

fn notes(loaded: &[Loaded]) -> Vec<String> {
    let [compliant, stiff] = [0, 1].map(|i: usize| Parameters::of(&loaded[i].run).materials());
    let fixed = [
        format!("compliant coating: {compliant}; stiff coating: {stiff}. Grey: relief that carries nothing."),
        "E₁ of (a), (c) is a tenth of E₁ of (b), (d): equal heights are equal pressures in all panels. A cell has the largest of its elements."
            .into(),
        format!("Colours of the maps end where {} % of the contact lies below. {}.", power(100.0 * TOLD_APART, 2), note::BRACKETS),
    ];
    let data = loaded
        .iter()
        .zip(PANELS)
        .map(|(loaded, name)| loaded.note(name));
    fixed.into_iter().chain(data).collect()
}

/// A unit of the paper's system.
fn in_units_of(label: &str) -> Scale {
    Scale {
        divisor: 1.0,
        label: label.to_owned(),
    }
}
