//! Fig. 2: pressure under the paraboloid on the compliant (a, c) and the stiff (b, d) coating, small and large load.

use pellicle_cli::display::Scale;

use super::note;
use super::number::power;
use super::parameters::Parameters;
use super::picture::Picture;
use super::pressure_sheet::{Common, Shown, maps, surfaces};
use super::pressures::{Loaded, reach, rounded_up};
use super::studio::Studio;
use crate::{PaperCase, XtaskError};

/// Names of the panels.
const PANELS: [&str; 4] = ["(a)", "(b)", "(c)", "(d)"];

/// E₁ of a panel's coating over E₁ of the stiff one: the paper's two materials change places, so the compliant coating's
/// modulus is a tenth. Axes whose ends are ten to one in units of E₁ are the same axis.
const MODULI: [f64; 4] = [0.1, 1.0, 0.1, 1.0];

/// The pressure as maps, and as columns over the surface.
pub(super) fn draw(studio: &mut Studio<'_>) -> Result<Vec<Picture>, XtaskError> {
    let cases = [
        PaperCase::Fig2a,
        PaperCase::Fig2b,
        PaperCase::Fig2c,
        PaperCase::Fig2d,
    ];
    let loaded = Loaded::all(studio, cases)?;
    let (subtitle, notes) = (subtitle(studio, &loaded), notes(&loaded));
    let common = Common {
        title: "Fig. 2: pressure on a textured coating",
        subtitle: &subtitle,
        notes: &notes,
        metres: in_units_of("R"),
        reach: reach(&loaded),
    };
    let panels = panels(&loaded);
    Ok(vec![
        maps("fig2-map", &common, &panels),
        surfaces("fig2-surface", &common, &panels),
    ])
}

/// Heights are the same pressure in all panels, colours of the maps in those of one coating.
fn panels(loaded: &[Loaded]) -> Vec<Shown<'_>> {
    let peaks = loaded
        .iter()
        .zip(MODULI)
        .map(|(loaded, modulus)| loaded.peak() * modulus);
    let top = rounded_up(peaks);
    let brightest = [0, 1].map(|coating| {
        let panels = [&loaded[coating], &loaded[coating + 2]];
        rounded_up(panels.into_iter().map(Loaded::common_peak))
    });
    let panel =
        |(i, loaded): (usize, &'_ Loaded)| (title(i, loaded), top / MODULI[i], brightest[i % 2]);
    let panels = loaded
        .iter()
        .enumerate()
        .map(|(i, loaded)| (loaded, panel((i, loaded))));
    panels
        .map(|(loaded, (title, top, brightest))| Shown {
            title,
            fields: loaded.stored.fields(loaded.run.side()),
            pascals: in_units_of("E₁"),
            top,
            brightest,
        })
        .collect()
}

fn title(i: usize, loaded: &Loaded) -> String {
    let step = loaded.run.last();
    let coating = ["compliant", "stiff"][i % 2];
    let (name, force, depth) = (PANELS[i], power(step.force, 5), power(step.penetration, 4));
    format!("{name} {coating} coating, Q = {force} E₁R², D = {depth} R")
}

fn subtitle(studio: &Studio<'_>, loaded: &[Loaded]) -> String {
    let case = Parameters::of(&loaded[0].run);
    format!(
        "{}paraboloid of radius R; coating {}; cylinders {}, {}",
        studio.quality.mark(),
        case.thickness(),
        case.cylinders(),
        case.period()
    )
}

fn notes(loaded: &[Loaded]) -> Vec<String> {
    let [compliant, stiff] = [0, 1].map(|i: usize| Parameters::of(&loaded[i].run).materials());
    let fixed = [
        format!("compliant coating: {compliant}; stiff coating: {stiff}. Grey: relief that carries nothing."),
        "E₁ of (a), (c) is a tenth of E₁ of (b), (d): equal heights are equal pressures in all panels. A cell has the largest of its elements."
            .into(),
        format!("Colours of the maps end where 99 % of the contact lies below. {}.", note::BRACKETS),
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
