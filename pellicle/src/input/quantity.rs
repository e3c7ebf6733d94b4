//! A quantity with its unit, as a string: `"70 GPa"`, `"5 nm"`, `"2.3 mN"`, `"65.03 deg"`.

use uom::si::f64::{Angle, Area, Energy, Force, Length, Pressure, Time, Volume};

use super::dimension::Dimension;

/// The longest number that is read, in bytes.
const MAX_NUMBER_LENGTH: usize = 64;

/// The reason why a text is not a quantity of the wanted dimension.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum QuantityError {
    /// The text does not begin with a number.
    #[error("no number")]
    NoNumber,
    /// There is no unit.
    #[error("a number without a unit")]
    NoUnit,
    /// The unit belongs to no dimension.
    #[error("the unknown unit `{0}`")]
    UnknownUnit(String),
    /// The unit belongs to another dimension.
    #[error("{}", .0.noun())]
    OtherDimension(Dimension),
}

/// Parses a quantity and returns it in SI units (m, Pa, N, rad, m/Pa, N/m, J/m², s), correctly rounded if the unit is a
/// power of ten of the SI unit.
///
/// # Errors
///
/// [`QuantityError`] if the text is not a number and a unit of this dimension.
pub fn parse(text: &str, dimension: Dimension) -> Result<f64, QuantityError> {
    let (number, unit) = split(text)?;
    let unit = spelling(unit);
    let factor = factor(dimension, &unit);
    factor.map_or_else(
        || Err(not_of_dimension(&unit)),
        |factor| Ok(times(number, factor)),
    )
}

/// The size of this unit in SI units.
///
/// # Errors
///
/// [`QuantityError`] if there is no such unit of this dimension.
pub fn one(unit: &str, dimension: Dimension) -> Result<f64, QuantityError> {
    parse(&format!("1 {unit}"), dimension)
}

/// The dimension of a quantity with a unit; none if the text is not one.
#[must_use]
pub fn dimension_of(text: &str) -> Option<Dimension> {
    let (_, unit) = split(text).ok()?;
    dimension_of_unit(&spelling(unit))
}

fn not_of_dimension(unit: &str) -> QuantityError {
    dimension_of_unit(unit).map_or_else(
        || QuantityError::UnknownUnit(unit.to_owned()),
        QuantityError::OtherDimension,
    )
}

fn dimension_of_unit(unit: &str) -> Option<Dimension> {
    let has = |dimension: &Dimension| factor(*dimension, unit).is_some();
    Dimension::ALL.into_iter().find(has)
}

/// The size of `unit` in SI units; `None` if the unit is not of this dimension.
fn factor(dimension: Dimension, unit: &str) -> Option<f64> {
    let one = format!("1 {unit}");
    match dimension {
        Dimension::Length => one.parse::<Length>().ok().map(|length| length.value),
        Dimension::Pressure => one.parse::<Pressure>().ok().map(|pressure| pressure.value),
        Dimension::Force => one.parse::<Force>().ok().map(|force| force.value),
        Dimension::Angle => one.parse::<Angle>().ok().map(|angle| angle.value),
        Dimension::Compliance => quotient(unit, Dimension::Length, Dimension::Pressure),
        Dimension::Stiffness => quotient(unit, Dimension::Force, Dimension::Length),
        Dimension::EnergyPerArea => energy_per_area(unit),
        Dimension::FrameCompliance => quotient(unit, Dimension::Length, Dimension::Force),
        Dimension::WearCoefficient => wear_coefficient(unit),
        Dimension::Time => one.parse::<Time>().ok().map(|time| time.value),
        Dimension::Speed => quotient(unit, Dimension::Length, Dimension::Time),
        Dimension::Area => area(unit),
        Dimension::Volume => volume(unit),
    }
}

/// The size of a unit `above/below` in SI units.
fn quotient(unit: &str, above: Dimension, below: Dimension) -> Option<f64> {
    let (numerator, denominator) = unit.split_once('/')?;
    let numerator = factor(above, &spelling(numerator))?;
    Some(numerator / factor(below, &spelling(denominator))?)
}

/// The size of an area in m²: `um^2`, `mm²`.
fn area(unit: &str) -> Option<f64> {
    let one = format!("1 {}", spelling(&with_micro(unit)));
    one.parse::<Area>().ok().map(|area| area.value)
}

/// The size of a volume in m³: `um^3`, `mm³`.
fn volume(unit: &str) -> Option<f64> {
    let one = with_micro(unit).replace("^3", "³").replace("m3", "m³");
    let one = format!("1 {one}").parse::<Volume>();
    one.ok().map(|volume| volume.value)
}

/// The unit with µ for micro, however it is spelled.
fn with_micro(unit: &str) -> String {
    let unit = unit.trim().replace('\u{3bc}', "\u{b5}");
    unit.replace("um", "µm")
}

/// The size of an energy over an area, or of a force over a length, in J/m².
fn energy_per_area(unit: &str) -> Option<f64> {
    let (energy, area) = unit.split_once('/')?;
    let energy = format!("1 {}", spelling(energy)).parse::<Energy>();
    let area = format!("1 {}", spelling(area)).parse::<Area>();
    match (energy, area) {
        (Ok(energy), Ok(area)) => Some(energy.value / area.value),
        _ => factor(Dimension::Stiffness, unit),
    }
}

/// The size of an area over a force, or of a volume over a force and a length, in m²/N: `m^2/N`, `mm^3/Nm`.
fn wear_coefficient(unit: &str) -> Option<f64> {
    let (above, below) = unit.split_once('/')?;
    let over_force = factor(Dimension::Force, &spelling(below));
    if let (Some(area), Some(force)) = (area(above), over_force) {
        return Some(area / force);
    }
    let volume = volume(above)?;
    let below = below.trim().trim_start_matches('(').trim_end_matches(')');
    let force = below.strip_suffix('m')?;
    let force = force.trim_end_matches([' ', '/', '*', '·']);
    Some(volume / factor(Dimension::Force, &spelling(force))?)
}

/// Splits the text into the longest prefix that is a number, and the rest.
fn split(text: &str) -> Result<(&str, &str), QuantityError> {
    let text = text.trim();
    let is_number = |end: &usize| {
        text.get(..*end)
            .is_some_and(|start| start.parse::<f64>().is_ok())
    };
    let end = (1..=text.len().min(MAX_NUMBER_LENGTH))
        .rev()
        .find(is_number)
        .ok_or(QuantityError::NoNumber)?;
    match text.get(end..).map_or("", str::trim_start) {
        "" => Err(QuantityError::NoUnit),
        unit => Ok((&text[..end], unit)),
    }
}

/// The library's spelling of a unit with several spellings: `um`, `μm` with a Greek mu, `deg`, `N/m^2`.
fn spelling(unit: &str) -> String {
    let unit = unit
        .trim()
        .replace('\u{3bc}', "\u{b5}")
        .replace('\u{212b}', "\u{c5}")
        .replace("^2", "²")
        .replace("m2", "m²");
    match unit.as_str() {
        "um" | "uN" | "uPa" | "us" | "uJ" => unit.replacen('u', "\u{b5}", 1),
        "deg" => "°".into(),
        "sec" => "s".into(),
        "angstrom" => "Å".into(),
        "N/m²" => "Pa".into(),
        _ => unit,
    }
}

/// Multiplies the number of a text by a factor. For a power of ten it moves the decimal point, which gives the same
/// bits as the bare number of that value; otherwise the result is rounded twice.
fn times(number: &str, factor: f64) -> f64 {
    let shifted = decimal_exponent(factor).and_then(|shift| shifted(number, shift));
    shifted.unwrap_or_else(|| number.parse().unwrap_or(f64::NAN) * factor)
}

/// `n` of a factor `10ⁿ`, up to the rounding of the library's product of a prefix and a unit.
fn decimal_exponent(factor: f64) -> Option<i32> {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the logarithm of a double is below 309"
    )]
    let exponent = factor.log10().round() as i32;
    let power: f64 = format!("1e{exponent}").parse().ok()?;
    ((factor / power - 1.0).abs() <= 4.0 * f64::EPSILON).then_some(exponent)
}

/// Returns the number of a text with its decimal point moved; none if the number is not finite or its exponent
/// overflows.
fn shifted(number: &str, places: i32) -> Option<f64> {
    let (mantissa, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let exponent = exponent.parse::<i32>().ok()?.checked_add(places)?;
    format!("{mantissa}e{exponent}").parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn length(text: &str) -> Result<f64, QuantityError> {
        parse(text, Dimension::Length)
    }

    #[test]
    fn a_value_with_unit_has_the_bits_of_the_bare_number() {
        assert_eq!(length("10 nm"), Ok(1e-8));
        assert_eq!(length("400 nm"), Ok(4e-7));
        assert_eq!(length("0.3 um"), Ok(0.3e-6));
        assert_eq!(parse("70 GPa", Dimension::Pressure), Ok(70e9));
        assert_eq!(parse("0.14 GPa", Dimension::Pressure), Ok(0.14e9));
        assert_eq!(parse("2.3 mN", Dimension::Force), Ok(2.3e-3));
    }

    /// One unit for every prefix that the library supports, with its power of ten.
    #[test]
    fn a_decimal_prefix_shifts_the_point_and_rounds_once() {
        let prefixes = [
            ("y", -24),
            ("z", -21),
            ("a", -18),
            ("f", -15),
            ("p", -12),
            ("n", -9),
            ("u", -6),
            ("m", -3),
            ("c", -2),
            ("d", -1),
            ("", 0),
            ("da", 1),
            ("h", 2),
            ("k", 3),
            ("M", 6),
            ("G", 9),
            ("T", 12),
            ("P", 15),
            ("E", 18),
            ("Z", 21),
            ("Y", 24),
        ];
        let units = [
            ("m", Dimension::Length),
            ("Pa", Dimension::Pressure),
            ("N", Dimension::Force),
        ];
        for (prefix, exponent) in prefixes {
            for (unit, dimension) in units {
                for number in ["1", "0.3", "2.3", "7.7", "123.456", "-9.1", ".7", "5."] {
                    let bare: f64 = format!("{number}e{exponent}").parse().unwrap();
                    let found = parse(&format!("{number} {prefix}{unit}"), dimension);
                    assert_eq!(found, Ok(bare), "{number} {prefix}{unit}");
                }
            }
        }
        // 2.3e-4 e-9, not 2.3e-4/1e9
        assert_eq!(length("2.3e-4 nm"), Ok(2.3e-13));
        assert_eq!(parse("0.7 nm/GPa", Dimension::Compliance), Ok(0.7e-18));
        assert_eq!(parse("1.7 bar", Dimension::Pressure), Ok(1.7e5));
        assert_eq!(length("7.7 Å"), Ok(7.7e-10));
    }

    #[test]
    fn every_spelling_of_a_unit_is_read() {
        for micron in [
            "1 um",
            "1 µm",
            "1 μm",
            "1um",
            "1 micron",
            "1 micrometer",
            " 1e0  um ",
        ] {
            assert_eq!(length(micron), Ok(1e-6), "{micron}");
        }
        for angstrom in ["1 Å", "1 \u{212b}", "1 angstrom"] {
            assert_eq!(length(angstrom), Ok(1e-10), "{angstrom}");
        }
        for modulus in ["2 N/m^2", "2 N/m2", "2 N/m²", "2 Pa", "2e-6 N/mm^2"] {
            assert_eq!(parse(modulus, Dimension::Pressure), Ok(2.0), "{modulus}");
        }
        for angle in ["180 deg", "180°", "180 degrees", "200 gon"] {
            let found = parse(angle, Dimension::Angle).unwrap();
            // The library's factors have 17 digits, with one rounding error each.
            assert!((found - std::f64::consts::PI).abs() < 1e-15, "{angle}");
        }
        assert_eq!(parse("3 uN", Dimension::Force), Ok(3e-6));
    }

    #[test]
    fn a_compliance_is_a_length_over_a_pressure() {
        let compliance = |text| parse(text, Dimension::Compliance);
        assert_eq!(compliance("5 nm/GPa"), Ok(5e-18));
        assert_eq!(compliance("2 um/MPa"), Ok(2e-12));
        assert_eq!(compliance("3 m / Pa"), Ok(3.0));
        let found = Err(QuantityError::OtherDimension(Dimension::Compliance));
        assert_eq!(length("5 nm/GPa"), found);
        assert!(compliance("5 nm/um").is_err() && compliance("5 N/mm^2").is_err());
    }

    #[test]
    fn a_stiffness_is_a_force_over_a_length_and_times_may_be_in_minutes() {
        let stiffness = |text| parse(text, Dimension::Stiffness);
        assert_eq!(stiffness("0.04 N/m"), Ok(0.04));
        assert_eq!(stiffness("3 uN/nm"), Ok(3e3));
        assert_eq!(stiffness("2 nN/nm"), Ok(2.0));
        let found = Err(QuantityError::OtherDimension(Dimension::Stiffness));
        assert_eq!(parse("5 N/m", Dimension::Pressure), found);
        for (text, seconds) in [
            ("3 s", 3.0),
            ("3 sec", 3.0),
            ("2 min", 120.0),
            ("1 h", 3600.0),
        ] {
            assert_eq!(parse(text, Dimension::Time), Ok(seconds), "{text}");
        }
        assert_eq!(parse("7 us", Dimension::Time), Ok(7e-6));
        assert_eq!(parse("7 ms", Dimension::Time), Ok(7e-3));
    }

    #[test]
    fn a_work_of_adhesion_is_an_energy_per_area_or_a_force_per_length() {
        let energy = |text| parse(text, Dimension::EnergyPerArea);
        for text in [
            "50 mJ/m^2",
            "50 mJ/m²",
            "50 mJ/m2",
            "0.05 J/m^2",
            "0.05 N/m",
            "50 mN/m",
            "5e4 uJ/m^2",
        ] {
            assert_eq!(energy(text), Ok(0.05), "{text}");
        }
        let force = Err(QuantityError::OtherDimension(Dimension::Force));
        assert_eq!(energy("50 mN"), force);
        let found = Err(QuantityError::OtherDimension(Dimension::EnergyPerArea));
        assert_eq!(parse("50 mJ/m^2", Dimension::Pressure), found);
    }

    #[test]
    fn areas_and_volumes_are_powers_of_lengths() {
        for text in ["3 um^2", "3 µm²", "3 μm^2", "3e-6 mm^2", "3e-12 m2"] {
            assert_eq!(parse(text, Dimension::Area), Ok(3e-12), "{text}");
        }
        for text in ["3 um^3", "3 µm³", "3e-9 mm^3", "3e-18 m^3"] {
            assert_eq!(parse(text, Dimension::Volume), Ok(3e-18), "{text}");
        }
        let found = Err(QuantityError::OtherDimension(Dimension::Area));
        assert_eq!(length("3 um^2"), found);
    }

    #[test]
    fn a_unit_of_the_wrong_dimension_is_named() {
        let found = parse("5 nm", Dimension::Pressure);
        assert_eq!(found, Err(QuantityError::OtherDimension(Dimension::Length)));
    }

    #[test]
    fn invalid_quantities_are_rejected() {
        assert_eq!(length("five nm"), Err(QuantityError::NoNumber));
        assert_eq!(length(""), Err(QuantityError::NoNumber));
        assert_eq!(length("µ"), Err(QuantityError::NoNumber));
        assert_eq!(length("5"), Err(QuantityError::NoUnit));
        assert_eq!(
            length("5 parsnips"),
            Err(QuantityError::UnknownUnit("parsnips".into()))
        );
    }

    #[test]
    fn infinity_and_nan_are_left_to_the_reader() {
        assert_eq!(length("inf nm"), Ok(f64::INFINITY));
        assert!(length("nan nm").unwrap().is_nan());
    }
}
