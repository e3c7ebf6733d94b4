//! The sides of a map and the unit of its heights: from the case or else from the file, which must agree.

use super::{HEIGHT_UNIT, LENGTHS, MapKeys};
use crate::display::{self, Unit};
use crate::input::diagnosis::{Diagnosis, Fault};
use crate::input::dimension::Dimension;
use crate::input::quantity;
use crate::input::table_reader::TableReader;
use crate::input::toml_tree::TomlValue;
use crate::input::units::Units;
use crate::input::value_reader::ValueReader;
use crate::map::MapFile;

/// Part by which a side or unit may differ from that in the head of the file, which is printed with few digits.
const SAME: f64 = 0.01;

/// The lengths that a 1 in a file stands for, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MapUnits {
    /// Of the heights; negative for depths.
    pub height: f64,
    /// Of the sides.
    lateral: f64,
    /// Whether that of the sides is named, by the file or by its key.
    pub has_lateral: bool,
    /// Whether neither unit is named, so that 1 of the sides is a metre.
    is_bare: bool,
}

impl MapUnits {
    /// The units from the case or else from the file; they must not contradict each other. Those of points are the same
    /// unless both are named.
    pub fn of(
        table: &TableReader<'_>,
        field: &ValueReader<'_>,
        keys: &MapKeys,
        file: &MapFile,
    ) -> Result<Self, Diagnosis> {
        if let (None, Some(_)) = (&file.sides, keys.lateral_unit) {
            let reason = format!("but {} has no lengths in this unit", keys.file);
            let field = table.required("lateral_unit", HEIGHT_UNIT)?;
            return Err(field.unusable(&reason, "side, the length of the map along x"));
        }
        let named = |what, given, name: &Option<String>| {
            one_unit(table, field, what, given, name.as_deref())
        };
        let height = named("height", keys.height_unit, &file.height_unit)?;
        let lateral = named("lateral", keys.lateral_unit, &file.lateral_unit)?;
        let lateral = lateral.map(f64::abs);
        let of_points = |unit: Option<f64>| unit.filter(|_| file.has_one_unit);
        let of_file = lateral.filter(|_| file.lateral_unit.is_some());
        Ok(Self {
            height: height.or_else(|| of_points(of_file)).unwrap_or(1.0),
            lateral: lateral
                .or_else(|| of_points(height.map(f64::abs)))
                .unwrap_or(1.0),
            has_lateral: lateral.is_some(),
            is_bare: lateral.or_else(|| of_points(height)).is_none(),
        })
    }
}

/// The length of a 1 by its key or else by its name in the file; none if there is neither.
fn one_unit(
    table: &TableReader<'_>,
    field: &ValueReader<'_>,
    what: &str,
    given: Option<f64>,
    name: Option<&str>,
) -> Result<Option<f64>, Diagnosis> {
    let own = name.map(|name| quantity::one(name, Dimension::Length).map_err(|_| name));
    match (given, own, name) {
        (Some(given), Some(Ok(own)), Some(name)) if !is_same(given.abs(), own) => {
            let reason = format!("which contradicts the unit {name} in the head of the file");
            let field = table.required(&format!("{what}_unit"), HEIGHT_UNIT)?;
            Err(field.unusable(
                &reason,
                "the unit of the file, negative for depths, or none",
            ))
        }
        (None, Some(Err(name)), _) => {
            let reason =
                format!("whose header has the {what} unit \"{name}\", which is not a length");
            Err(field.unusable(
                &reason,
                "a map of heights, or the key that overrides the header",
            ))
        }
        // A unit that is no length, such as volts, needs the key.
        (Some(given), ..) => Ok(Some(given)),
        (None, own, _) => Ok(own.and_then(Result::ok)),
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

/// The sides of a map, m, and whether they are those of a file that names no unit.
pub(super) struct MapSides {
    pub sides: [f64; 2],
    pub are_bare: bool,
}

/// The sides from the case or else from the file. They must agree where the file has a unit; where it has none, the
/// side of the case gives the scale.
pub(super) fn sides(
    table: &TableReader<'_>,
    keys: &MapKeys,
    file: &MapFile,
    map_units: MapUnits,
) -> Result<MapSides, Diagnosis> {
    const WANTED: &str =
        "side, the length of the map along x, or sides = [x, y], since the file does not give it";
    if let (Some(_), Some(_)) = (keys.side, keys.sides) {
        return Err(table.required("sides", "")?.diagnosis(Fault::Wrong {
            found: "side and sides".into(),
            wanted: "one of them".into(),
        }));
    }
    let [along_x, along_y] = file.shape.map(|samples| samples as f64);
    let own = file
        .sides
        .map(|own| own.map(|side| side * map_units.lateral));
    let given = match (keys.side, keys.sides, own) {
        (Some(side), _, Some([x, y])) => Some([side, side * y / x]),
        // Square pixels.
        (Some(side), _, None) => Some([side, side * along_y / along_x]),
        (None, sides, _) => sides,
    };
    let Some(given) = given else {
        let sides = own.ok_or_else(|| table.missing("side", WANTED.into()))?;
        return Ok(MapSides {
            sides,
            are_bare: map_units.is_bare,
        });
    };
    let of_head = own.filter(|_| map_units.has_lateral);
    if let Some(own) = of_head.filter(|own| !(0..2).all(|axis| is_same(given[axis], own[axis]))) {
        let key = if keys.side.is_some() { "side" } else { "sides" };
        let units = if names_a_unit(table, file) {
            Units::Si
        } else {
            Units::Consistent
        };
        let [x, y] = own.map(|side| display::quantity(side, Unit::Metre, units));
        let of = if file.has_one_unit {
            "of the points"
        } else {
            "in the head"
        };
        let reason = format!("which contradicts the size {x} by {y} {of} of the file");
        return Err(table
            .required(key, LENGTHS)?
            .unusable(&reason, "the size of the file, or none"));
    }
    Ok(MapSides {
        sides: given,
        are_bare: false,
    })
}

/// Whether the given sides or the file have a unit, so that heights have one too.
pub(super) fn names_a_unit(table: &TableReader<'_>, file: &MapFile) -> bool {
    let is_text = |value: &TomlValue| matches!(value, TomlValue::Text(_));
    let has_unit = |field: ValueReader<'_>| match field.value() {
        TomlValue::List(items) => items.iter().any(|item| is_text(&item.value)),
        value => is_text(value),
    };
    let mut sides = ["side", "sides"]
        .into_iter()
        .filter_map(|key| table.optional(key));
    sides.any(has_unit) || units(file) == Units::Si
}
