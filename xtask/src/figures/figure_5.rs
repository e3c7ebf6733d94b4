//! Fig. 5: pressure under the Berkovich pyramid with and without film.

use pellicle_cli::Units;
use pellicle_cli::drawing::Axis;
use pellicle_cli::drawing::{Dash, Rect};
use pellicle_cli::{Scale, Unit, quantity};

use super::line::{self, Line};
use super::loading::{BARE, FILM};
use super::parameters::{Parameters, short};
use super::picture::Picture;
use super::pressure_sheet::{Common, Shown, maps, surfaces};
use super::pressures::{Loaded, reach, rounded_up};
use super::sheet::Sheet;
use super::studio::Studio;
use super::{chart, note};
use crate::XtaskError;

/// Names of the panels.
const PANELS: [&str; 2] = ["with film", "without film"];

/// Of the profiles, in pixels.
const PLACE: Rect = Rect {
    left: 112.0,
    top: Sheet::TOP + 50.0,
    width: 1060.0,
    height: 440.0,
};

const TITLE: &str = "Fig. 5: pressure under a Berkovich pyramid with a rounded tip";

/// The pressure as maps, as columns over the surface, and along the axis of symmetry.
pub(super) fn draw(studio: &mut Studio<'_>) -> Result<Vec<Picture>, XtaskError> {
    let loaded = Loaded::all(studio, ["cases/fig5-film", "cases/fig5-bare"])?;
    let (subtitle, notes) = (subtitle(studio, &loaded), notes(&loaded));
    let reach = reach(&loaded);
    let metres = Scale::of(reach, Unit::Metre, Units::Si);
    let common = Common {
        title: TITLE,
        subtitle: &subtitle,
        notes: &notes,
        reach: reach / metres.divisor,
        metres,
    };
    let panels = panels(&loaded);
    Ok(vec![
        maps("fig5-map", &common, &panels),
        surfaces("fig5-surface", &common, &panels),
        profiles(&common, &panels),
    ])
}

/// The same ends of axes and colours in both panels.
fn panels(loaded: &[Loaded]) -> Vec<Shown<'_>> {
    let peaks = || loaded.iter().map(Loaded::peak);
    let pascals = Scale::of(peaks().fold(0.0, f64::max), Unit::Pascal, Units::Si);
    let top = rounded_up(peaks().map(|peak| peak / pascals.divisor));
    let panels = loaded.iter().zip(PANELS);
    panels
        .map(|(loaded, name)| Shown {
            title: format!("{name}, {}", penetration(loaded)),
            fields: loaded.stored.fields(loaded.run.side()),
            pascals: pascals.clone(),
            top,
            brightest: top,
        })
        .collect()
}

fn penetration(loaded: &Loaded) -> String {
    let depth = quantity(loaded.run.last().penetration, Unit::Metre, Units::Si);
    format!("D = {depth}")
}

fn subtitle(studio: &Studio<'_>, loaded: &[Loaded]) -> String {
    let film = Parameters::of(&loaded[0].run);
    let force = quantity(loaded[0].run.last().force, Unit::Newton, Units::Si);
    format!(
        "{}Q = {}; tip radius {}; coating {}; film {}",
        studio.quality.mark(),
        short(&force),
        film.tip_radius(),
        film.thickness(),
        film.film()
    )
}

fn notes(loaded: &[Loaded]) -> Vec<String> {
    let film = Parameters::of(&loaded[0].run);
    let fixed = [
        format!("coating: {}, {}. Grey: film that carries nothing. {}.", film.modulus(), film.materials(), note::BRACKETS),
        "The film shortens by many times its thickness at this force, as printed: linear springs are used outside their validity.".into(),
    ];
    let data = loaded
        .iter()
        .zip(PANELS)
        .map(|(loaded, name)| loaded.note(name));
    fixed.into_iter().chain(data).collect()
}

/// The pressures along x beside the axis, in one panel.
fn profiles(common: &Common<'_>, panels: &[Shown<'_>]) -> Picture {
    let height = 50.0 + PLACE.height + 76.0;
    let size = (PLACE.right() + 40.0, height);
    let mut sheet = Sheet::new(size, TITLE, common.subtitle, common.notes);
    let lines: Vec<_> = (panels.iter().zip([FILM, BARE]))
        .map(|(shown, colour)| Line {
            name: shown.title.clone(),
            colour,
            dash: Dash::Solid,
            width: Line::WIDTH,
            is_marked: false,
            parts: vec![common.profile(shown)],
        })
        .collect();
    let axes = (
        Axis::new(
            -common.reach,
            common.reach,
            format!("x, {}", common.metres.label),
            8,
        ),
        Axis::new(
            0.0,
            1.06 * panels[0].top,
            format!("p beside the axis, {}", panels[0].pascals.label),
            5,
        ),
    );
    chart::draw(&mut sheet.svg, "", PLACE, axes, &lines);
    let entries: Vec<&Line> = lines.iter().collect();
    chart::legend(
        &mut sheet.svg,
        (PLACE.left, Sheet::TOP + 12.0),
        420.0,
        &[&entries],
    );
    let csv = line::csv([("along x", lines.as_slice())]);
    sheet.finish("fig5-profile", csv)
}
