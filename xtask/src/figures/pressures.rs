//! Figures 2 and 5: the pressure over the surface.

use pellicle_cli::case::units::Units;
use pellicle_cli::display::{Scale, Unit, quantity};
use pellicle_cli::output::npz::StoredFields;

use super::note;
use super::number::power;
use super::parameters::Parameters;
use super::picture::Picture;
use super::pressure_sheet::{Common, Shown, maps, surfaces};
use super::studio::Studio;
use crate::{PaperCase, PaperRun, XtaskError};

/// What is shown around the contact, as a part of it.
const MARGIN: f64 = 1.06;

/// A run and the fields of its only step.
struct Loaded {
    run: PaperRun,
    stored: StoredFields,
}

impl Studio<'_> {
    fn load(&mut self, case: PaperCase) -> Result<Loaded, XtaskError> {
        let run = self.fields(case)?;
        let stored = run.fields(0)?;
        Ok(Loaded { run, stored })
    }
}

/// Fig. 2: pressure under the paraboloid on the compliant (a, c) and the stiff (b, d) coating, small and large load.
///
/// The compliant coating's modulus is a tenth of the stiff one's: the paper's materials change places. So axes whose ends are
/// ten to one in units of E₁ are the same axis, and the same colour is the same pressure.
pub(super) fn figure_2(studio: &mut Studio<'_>) -> Result<Vec<Picture>, XtaskError> {
    let cases = [
        ("(a) compliant", PaperCase::Fig2a, STIFF_TO_COMPLIANT),
        ("(b) stiff", PaperCase::Fig2b, 1.0),
        ("(c) compliant", PaperCase::Fig2c, STIFF_TO_COMPLIANT),
        ("(d) stiff", PaperCase::Fig2d, 1.0),
    ];
    let mut loaded = Vec::new();
    for (_, case, _) in cases {
        loaded.push(studio.load(case)?);
    }
    let ratios = cases.map(|(_, _, ratio)| ratio);
    let peaks = loaded.iter().zip(ratios);
    let top = rounded_up(peaks.map(|(l, ratio)| l.run.last().max_pressure / ratio));
    let panels: Vec<_> = (loaded.iter().zip(cases))
        .map(|(loaded, (name, _, ratio))| {
            let step = loaded.run.last();
            let (force, depth) = (power(step.force, 5), power(step.penetration, 4));
            Shown {
                title: format!("{name} coating, Q = {force} E₁R², D = {depth} R"),
                fields: loaded.stored.fields(loaded.run.side()),
                pascals: bare("E₁"),
                top: top * ratio,
            }
        })
        .collect();
    let [compliant, stiff] = [&loaded[0].run, &loaded[1].run].map(Parameters::of);
    let notes = [
        format!("compliant coating: {}; stiff coating: {}", compliant.materials(), stiff.materials()),
        "Equal colours and heights are equal pressures in all panels: E₁ of (a), (c) is a tenth of E₁ of (b), (d). Grey: relief that carries nothing.".to_owned(),
    ];
    let notes: Vec<_> = notes
        .into_iter()
        .chain(data_notes(&loaded, &["(a)", "(b)", "(c)", "(d)"]))
        .collect();
    let subtitle = format!(
        "{}paraboloid of radius R; coating {}; cylinders {}, {}",
        studio.quality.mark(),
        compliant.thickness(),
        compliant.cylinders(),
        compliant.period()
    );
    let common = Common {
        title: "Fig. 2: pressure on a textured coating",
        subtitle: &subtitle,
        notes: &notes,
        metres: bare("R"),
        reach: reach(&loaded),
    };
    Ok(vec![
        maps("fig2-map", &common, &panels),
        surfaces("fig2-surface", &common, &panels),
    ])
}

/// E₁ of the stiff coating over E₁ of the compliant one; the forces of Fig. 2 have the same ratio.
const STIFF_TO_COMPLIANT: f64 = 10.0;

/// Fig. 5: pressure under the pyramid without and with film.
pub(super) fn figure_5(studio: &mut Studio<'_>) -> Result<Vec<Picture>, XtaskError> {
    let cases = [
        ("with film", PaperCase::Fig5Film),
        ("without film", PaperCase::Fig5Bare),
    ];
    let mut loaded = Vec::new();
    for (_, case) in cases {
        loaded.push(studio.load(case)?);
    }
    let peaks = || loaded.iter().map(|loaded| loaded.run.last().max_pressure);
    let pascals = Scale::of(peaks().fold(0.0, f64::max), Unit::Pascal, Units::Si);
    let top = rounded_up(peaks().map(|peak| peak / pascals.divisor));
    let panels: Vec<_> = (loaded.iter().zip(cases))
        .map(|(loaded, (name, _))| {
            let depth = quantity(loaded.run.last().penetration, Unit::Metre, Units::Si);
            Shown {
                title: format!("{name}, D = {depth}"),
                fields: loaded.stored.fields(loaded.run.side()),
                pascals: pascals.clone(),
                top,
            }
        })
        .collect();
    let film = Parameters::of(&loaded[0].run);
    let notes: Vec<_> = std::iter::once("The film shortens by many times its thickness at this force, as printed: linear springs are used outside their validity.".to_owned())
        .chain(data_notes(&loaded, &["with", "without"]))
        .collect();
    let force = quantity(loaded[0].run.last().force, Unit::Newton, Units::Si);
    let subtitle = format!(
        "{}Q = {force}; {}; coating {}, {}, {}; film {}",
        studio.quality.mark(),
        film.tip_radius(),
        film.modulus(),
        film.materials(),
        film.thickness(),
        film.film()
    );
    let reach = reach(&loaded);
    let metres = Scale::of(reach, Unit::Metre, Units::Si);
    let common = Common {
        title: "Fig. 5: pressure under a Berkovich pyramid with a rounded tip",
        subtitle: &subtitle,
        notes: &notes,
        reach: reach / metres.divisor,
        metres,
    };
    Ok(vec![
        maps("fig5-map", &common, &panels),
        surfaces("fig5-surface", &common, &panels),
    ])
}

/// A unit of the paper's system.
fn bare(label: &str) -> Scale {
    Scale {
        divisor: 1.0,
        label: label.to_owned(),
    }
}

/// The largest contact and a margin.
fn reach(loaded: &[Loaded]) -> f64 {
    let radii = loaded.iter().map(|loaded| loaded.run.last().contact_radius);
    MARGIN * radii.fold(0.0, f64::max)
}

fn data_notes<'a>(loaded: &'a [Loaded], names: &'a [&str]) -> impl Iterator<Item = String> + 'a {
    let notes = loaded.iter().zip(names);
    notes.map(|(loaded, name)| format!("{name}: {}", note::of_step(&loaded.run, loaded.run.last())))
}

/// The largest value, rounded up to two digits of which the second is even, so that the end of an axis is a round number.
fn rounded_up(values: impl Iterator<Item = f64>) -> f64 {
    let largest = values.fold(0.0, f64::max);
    let unit = 2.0 * 10_f64.powf(largest.log10().floor() - 1.0);
    // A value that is round already stays, whatever its last bits are.
    unit * (largest / unit - 1e-9).ceil()
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn the_end_of_an_axis_is_round_and_no_smaller_than_the_data() {
        // A few roundings of products.
        for (value, end) in [(0.499, 0.50), (0.0434, 0.044), (4.19, 4.2), (0.5, 0.5)] {
            assert_relative_eq!(rounded_up([value].into_iter()), end, max_relative = 1e-14);
        }
    }
}
