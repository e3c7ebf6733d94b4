//! A column of a curve, and the text in its cells.

use crate::input::units::Units;

/// A column: its name, its SI unit if it has one, and the text of its cell in the row of a `T`.
pub type CurveColumn<T> = (&'static str, Option<&'static str>, fn(&T) -> String);

/// The name of a column, with its unit.
pub fn name<T>((name, unit, _): &CurveColumn<T>, units: Units) -> String {
    match unit {
        Some(unit) => format!("{name} [{}]", units.name(unit)),
        None => (*name).to_owned(),
    }
}

/// The shortest text that reads back as the same number.
pub fn number(value: f64) -> String {
    format!("{value:e}")
}
