//! Texts of a drafted file: strings of TOML, and quantities as a reader would write them.

use pellicle::display::{DisplayUnit, Unit, short, significant};
use pellicle::input::units::Units;

/// A text as a string of TOML.
pub(super) fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

/// A quantity with at most three digits and its unit in ASCII: `1.24 um`.
pub(super) fn quantity(value: f64, unit: Unit) -> String {
    let scale = DisplayUnit::of(value, unit, Units::Si);
    let label = scale.label.replace('µ', "u");
    format!("{} {label}", short(value / scale.divisor))
}

/// A number as stated, with up to five digits, and its unit in ASCII.
pub(super) fn stated(value: f64, unit: Unit) -> String {
    let scale = DisplayUnit::of(value, unit, Units::Si);
    let number = significant(value / scale.divisor, 5);
    let number = number.parse::<f64>().map_or(number, |n| n.to_string());
    format!("{number} {}", scale.label.replace('µ', "u"))
}

/// A time: `60 s`.
pub(super) fn seconds(value: f64) -> String {
    format!("{} s", short(value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_and_quantities_are_those_of_a_fit_file() {
        assert_eq!(quoted("a \"b\" \\"), "\"a \\\"b\\\" \\\\\"");
        assert_eq!(quantity(1.2399e-6, Unit::Metre), "1.24 um");
        assert_eq!(stated(27.5e-6, Unit::Metre), "27.5 um");
        assert_eq!(stated(0.043_493_666, Unit::NewtonPerMetre), "43.494 mN/m");
        assert_eq!(seconds(60.02), "60 s");
    }
}
