//! A resolved case with the units of its numbers, as in a case file that somebody would write.

use serde_json::Value;

use super::key_dimension;
use crate::input::dimension::Dimension;
use crate::input::key_path::dotted;
use crate::input::quantity;

/// The prefixes of 10⁻¹², 10⁻⁹ … 10¹², as in a case file.
const PREFIXES: [&str; 9] = ["p", "n", "u", "m", "", "k", "M", "G", "T"];

/// The compliance of 1 nm/GPa, 10⁻¹⁸ m/Pa, as a power of ten.
const NANOMETRE_PER_GIGAPASCAL: i32 = -18;

/// Decimal places by which a point is moved rather than written as an exponent.
const MOVED: std::ops::RangeInclusive<i32> = -3..=5;

/// Gives the numbers of a case in SI units their units; read again, they have the same bits. Missing values are left
/// out.
#[must_use]
pub fn with_units(case: Value) -> Value {
    within(case, "")
}

fn within(value: Value, path: &str) -> Value {
    match value {
        Value::Object(entries) => {
            let entries = entries.into_iter().filter(|(_, value)| !value.is_null());
            let entry = |(key, value): (String, Value)| {
                let value = within(value, &dotted(path, &key));
                (key, value)
            };
            Value::Object(entries.map(entry).collect())
        }
        Value::Array(items) => {
            let items = items.into_iter();
            Value::Array(items.map(|item| within(item, path)).collect())
        }
        Value::Number(number) => match (key_dimension::of_path(path), number.as_f64()) {
            (Some(dimension), Some(number)) => written(number, dimension).into(),
            _ => Value::Number(number),
        },
        other => other,
    }
}

/// Writes a number in SI units with a unit of a readable size.
fn written(number: f64, dimension: Dimension) -> String {
    let shortest = format!("{number:e}");
    let (mantissa, exponent) = shortest.split_once('e').unwrap_or((&shortest, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    match dimension {
        dimension if number == 0.0 => format!("{number} {}", dimension.si_unit()),
        Dimension::Length | Dimension::Pressure | Dimension::Force => {
            let thousands = exponent.div_euclid(3).clamp(-4, 4);
            let prefix = PREFIXES[thousands.abs_diff(-4) as usize];
            let moved = moved(mantissa, exponent - 3 * thousands);
            format!("{moved} {prefix}{}", dimension.si_unit())
        }
        Dimension::Compliance => {
            format!(
                "{} nm/GPa",
                moved(mantissa, exponent - NANOMETRE_PER_GIGAPASCAL)
            )
        }
        Dimension::Angle => {
            // Most angles are whole degrees or have few decimals.
            let degrees = format!("{:.9}", number.to_degrees());
            let degrees = degrees.trim_end_matches('0').trim_end_matches('.');
            let degrees = format!("{degrees} deg");
            let is_same = quantity::parse(&degrees, dimension)
                .is_ok_and(|read| read.to_bits() == number.to_bits());
            if is_same {
                degrees
            } else {
                format!("{number} rad")
            }
        }
        dimension => format!("{} {}", moved(mantissa, exponent), dimension.si_unit()),
    }
}

/// Multiplies a number such as `-1.25` by a power of ten without rounding it.
fn moved(mantissa: &str, places: i32) -> String {
    if !MOVED.contains(&places) {
        return format!("{mantissa}e{places}");
    }
    let (sign, digits) = match mantissa.strip_prefix('-') {
        Some(digits) => ("-", digits),
        None => ("", mantissa),
    };
    let (whole, decimals) = digits.split_once('.').unwrap_or((digits, ""));
    let zeros = "0".repeat(places.unsigned_abs() as usize);
    if places < 0 {
        let (zero, rest) = zeros.split_at(1);
        return format!("{sign}{zero}.{rest}{whole}{decimals}");
    }
    let digits = format!("{decimals}{zeros}");
    let (before, after) = digits.split_at(zeros.len());
    let after = after.trim_end_matches('0');
    let point = if after.is_empty() { "" } else { "." };
    format!("{sign}{whole}{before}{point}{after}")
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn every_quantity_has_a_unit_and_every_other_number_has_none() {
        let case = json!({
            "foundation": {"layer": [{
                "thickness": 2e-6, "young_modulus": {"from": 4e11, "to": 210e9, "profile": "linear"},
                "poisson_ratio": 0.25, "interface": {"normal_compliance": 0.0, "shear_compliance": 2e-18},
            }]},
            "surface": {"offset": [0.0, -1.5e-6]},
            "indenter": {"half_angle": 65.03_f64.to_radians(), "radius": null},
            "load": {"forces": [1e-4, 0.05]}, "grid": {"elements": 64, "side": 5.125_138_012_345_679e-5},
            "solver": {"tolerance": 1e-8}, "wear": {"coefficient": 1e-15, "distances": [10.0]},
        });
        let wanted = json!({
            "foundation": {"layer": [{
                "thickness": "2 um", "young_modulus": {"from": "400 GPa", "to": "210 GPa", "profile": "linear"},
                "poisson_ratio": 0.25, "interface": {"normal_compliance": "0 m/Pa", "shear_compliance": "2 nm/GPa"},
            }]},
            "surface": {"offset": ["0 m", "-1.5 um"]},
            "indenter": {"half_angle": "65.03 deg"},
            "load": {"forces": ["100 uN", "50 mN"]}, "grid": {"elements": 64, "side": "51.25138012345679 um"},
            "solver": {"tolerance": 1e-8}, "wear": {"coefficient": "1e-15 m^2/N", "distances": ["10 m"]},
        });
        assert_eq!(with_units(case), wanted);
    }

    #[test]
    fn a_written_quantity_is_read_as_the_same_number() {
        let dimensions = [
            Dimension::Length,
            Dimension::Pressure,
            Dimension::Force,
            Dimension::Angle,
            Dimension::Compliance,
            Dimension::WearCoefficient,
        ];
        let mut number: f64 = 1.234_567_890_123_456_7e-31;
        let mut numbers = vec![0.0, 1e-30, 999.999_999_999_999_9, 1e30, 1.0, -1e-9];
        while number < 1e31 {
            numbers.push(number);
            number *= 1.234_567_890_1;
        }
        for number in numbers {
            for dimension in dimensions {
                let text = written(number, dimension);
                let read = quantity::parse(&text, dimension).unwrap();
                assert_eq!(read.to_bits(), number.to_bits(), "{text} for {number:e}");
            }
        }
    }
}
