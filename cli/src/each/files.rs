//! The files of curves fitted apart: table, map, and `each.json` last.

use std::path::Path;

use pellicle_files::cell::text_cell;
use pellicle_files::{json, whole};
use pellicle_plot::fit::heading::FitHeading;
use pellicle_plot::fit::places::PlacesMap;
use pellicle_plot::sheet::style::Style;

use super::{EachCurve, EachResult, position, text};
use crate::failure::Failure;
use crate::identification::{names, units};
use crate::output::write_progress::WriteProgress;

/// File name of the table.
const TABLE: &str = "each.csv";
/// File name of the map of an unknown, before its number from the second on.
const MAP: &str = "each-map";

/// Whether curves fitted apart have a file with this name.
#[must_use]
pub fn is_name(name: &str) -> bool {
    let ending = name
        .strip_prefix(MAP)
        .map(|rest| rest.trim_start_matches(|c: char| c == '-' || c.is_ascii_digit()));
    [super::FILE, TABLE].contains(&name)
        || ending.is_some_and(|ending| [".svg", ".png"].contains(&ending))
}

/// Writes the files into a folder; returns the sentences about pictures that cannot be drawn.
///
/// # Errors
///
/// [`Failure::File`] if a file cannot be written.
pub fn write(folder: &Path, result: &EachResult) -> Result<Vec<String>, Failure> {
    let writer = WriteProgress::new(1, &|_, _| ());
    for index in 0..keys(result).len() {
        let name = match index {
            0 => MAP.to_owned(),
            index => format!("{MAP}-{}", index + 1),
        };
        let svg = writer.drawn(&name, || {
            Ok(map(result, index).and_then(|map| map.draw(&Style::default())))
        });
        if let Some(svg) = svg.flatten() {
            writer.picture(folder, &name, || svg)?;
        }
    }
    whole::write_bytes(&folder.join(TABLE), table(result).as_bytes())?;
    let text = json(result)?;
    whole::write_bytes(&folder.join(super::FILE), text.as_bytes())?;
    Ok(writer
        .warnings()
        .into_iter()
        .map(|warning| warning.message)
        .collect())
}

/// The keys of the unknowns and their units, of the first curve that has any.
fn keys(result: &EachResult) -> Vec<(String, String)> {
    let first = result
        .curves
        .iter()
        .find(|curve| !curve.unknowns.is_empty());
    let unknowns = first.map(|curve| &curve.unknowns[..]).unwrap_or_default();
    unknowns
        .iter()
        .map(|of| (of.key.clone(), of.unit.clone()))
        .collect()
}

/// The table, as CSV: a row for each curve.
#[must_use]
pub fn table(result: &EachResult) -> String {
    let keys = keys(result);
    let unit = if position::are_in_metres(&result.curves) {
        " [m]"
    } else {
        ""
    };
    let columns = keys.iter().map(|(key, unit)| {
        format!(",{key} [{unit}],{key} lower [{unit}],{key} upper [{unit}],{key} verdict")
    });
    let header = format!(
        "file,x{unit},y{unit},fit{},misfit p,cause\n",
        columns.collect::<String>()
    );
    let row = |curve: &EachCurve| {
        let place = |axis: usize| number(curve.position.map(|position| position[axis]));
        let unknown = |index: usize| match curve.unknowns.get(index) {
            Some(of) => {
                let [low, high] = of.interval.map(number);
                format!(",{:e},{low},{high},{}", of.value, of.verdict)
            }
            None => ",,,,".to_owned(),
        };
        format!(
            "{},{},{},{}{},{},{}\n",
            text_cell(&curve.file),
            place(0),
            place(1),
            curve.verdict,
            (0..keys.len()).map(unknown).collect::<String>(),
            number(curve.misfit_p),
            text_cell(curve.cause.as_deref().unwrap_or_default()),
        )
    };
    header + &result.curves.iter().map(row).collect::<String>()
}

/// Writes a number, or an empty cell.
fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| format!("{value:e}"))
}

/// The map of an unknown over the positions of the curves, with the values of those fitted whose interval closes.
fn map(result: &EachResult, index: usize) -> Option<PlacesMap> {
    let place = |curve: &EachCurve| {
        let of = curve
            .unknowns
            .get(index)
            .filter(|of| curve.verdict == "fitted" && of.is_closed());
        Some((curve.position?, of.map(|of| of.value)))
    };
    let places: Vec<_> = result.curves.iter().filter_map(place).collect();
    let (key, unit) = keys(result).into_iter().nth(index)?;
    let farthest = places
        .iter()
        .flat_map(|(place, _)| *place)
        .fold(0.0, |far: f64, x| far.max(x.abs()));
    let largest = places
        .iter()
        .filter_map(|(_, value)| *value)
        .fold(0.0, f64::max);
    let unit_along = if position::are_in_metres(&result.curves) {
        "m"
    } else {
        "1"
    };
    Some(PlacesMap {
        head: FitHeading {
            title: result.title.clone(),
            numbers: text::counts(result),
        },
        places,
        along: units::scale(farthest, unit_along),
        quantity: (names::of_key(&key), units::scale(largest, &unit)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_file_names_of_curves_fitted_apart_are_recognised() {
        for name in ["each.json", "each.csv", "each-map.svg", "each-map-2.png"] {
            assert!(is_name(name), "{name}");
        }
        for name in ["each.md", "each-map.pdf", "each-mapped.svg", "each"] {
            assert!(!is_name(name), "{name}");
        }
    }
}
