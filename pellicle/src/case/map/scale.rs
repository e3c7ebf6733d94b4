//! The sides of a map and the unit of its heights: from the case or else from the file, which must agree.

use super::{HEIGHT_UNIT, LENGTHS, MapKeys};
use crate::display::{self, Unit};
use crate::input::diagnosis::{Diagnosis, Fault};
use crate::input::dimension::Dimension;
use crate::input::quantity;
use crate::input::table_reader::TableReader;
use crate::input::units::Units;
use crate::input::value_reader::ValueReader;
use crate::map::MapFile;

/// Part by which a side or unit may differ from that in the head of the file, which is printed with few digits.
const SAME: f64 = 0.01;

/// The length of a 1 in the file, from the case or else from the file; they must not contradict each other.
pub(super) fn height_unit(
    table: &TableReader<'_>,
    field: &ValueReader<'_>,
    keys: &MapKeys,
    file: &MapFile,
) -> Result<f64, Diagnosis> {
    let name = file.height_unit.as_deref();
    let Some(given) = keys.height_unit else {
        return unit(field, "height", name);
    };
    // A unit that is no length, such as volts, needs the key.
    let own = name.and_then(|name| quantity::one(name, Dimension::Length).ok());
    match (own, name) {
        (Some(own), Some(name)) if !is_same(given.abs(), own) => {
            let field = table.required("height_unit", HEIGHT_UNIT)?;
            let reason = format!("which contradicts the unit {name} in the head of the file");
            Err(field.unusable(
                &reason,
                "the unit of the file, negative for depths, or none",
            ))
        }
        _ => Ok(given),
    }
}

/// Whether a length of the case is that of the file.
fn is_same(given: f64, own: f64) -> bool {
    (given / own - 1.0).abs() <= SAME
}

pub(super) fn units(file: &MapFile) -> Units {
    if file.lateral_unit.is_some() || file.height_unit.is_some() {
        Units::Si
    } else {
        Units::Consistent
    }
}

/// The sides from the case or else from the file; those of points are in the unit of their heights.
pub(super) fn sides(
    table: &TableReader<'_>,
    field: &ValueReader<'_>,
    keys: &MapKeys,
    file: &MapFile,
    height_unit: f64,
) -> Result<[f64; 2], Diagnosis> {
    const WANTED: &str =
        "side, the length of the map along x, or sides = [x, y], since the file does not give it";
    if let (Some(_), Some(_)) = (keys.side, keys.sides) {
        return Err(table.required("sides", "")?.diagnosis(Fault::Wrong {
            found: "side and sides".into(),
            wanted: "one of them".into(),
        }));
    }
    let [along_x, along_y] = file.shape.map(|samples| samples as f64);
    let own = match file.sides {
        Some(sides) if file.has_one_unit => {
            let unit = keys.lateral_unit.unwrap_or(height_unit);
            Some(sides.map(|side| side * unit.abs()))
        }
        Some(sides) => {
            let unit = unit(field, "lateral", file.lateral_unit.as_deref())?;
            Some(sides.map(|side| side * unit))
        }
        None => None,
    };
    // Points may have other units along x and y, so their sides are no contradiction.
    let of_head = own.filter(|_| !file.has_one_unit);
    let given = match (keys.side, keys.sides, of_head) {
        (Some(side), _, Some([x, y])) => Some([side, side * y / x]),
        // Square pixels.
        (Some(side), _, None) => Some([side, side * along_y / along_x]),
        (None, sides, _) => sides,
    };
    let Some(given) = given else {
        return own.ok_or_else(|| table.missing("side", WANTED.into()));
    };
    if let Some(own) = of_head.filter(|own| !(0..2).all(|axis| is_same(given[axis], own[axis]))) {
        let key = if keys.side.is_some() { "side" } else { "sides" };
        let [x, y] = own.map(|side| display::quantity(side, Unit::Metre, units(file)));
        let reason = format!("which contradicts the size {x} by {y} in the head of the file");
        return Err(table
            .required(key, LENGTHS)?
            .unusable(&reason, "the size of the file, or none"));
    }
    Ok(given)
}

/// The unit that the file names, m; 1 if it names none.
fn unit(field: &ValueReader<'_>, what: &str, name: Option<&str>) -> Result<f64, Diagnosis> {
    let Some(name) = name else {
        return Ok(1.0);
    };
    quantity::one(name, Dimension::Length).map_err(|_| {
        let reason = format!("whose header has the {what} unit \"{name}\", which is not a length");
        field.unusable(
            &reason,
            "a map of heights, or the key that overrides the header",
        )
    })
}
