//! Numbers for human readers: a few digits and an SI prefix, ranges, and counts.

use crate::input::dimension::Dimension;
use crate::input::units::Units;

/// The prefixes of 10⁻¹⁸, 10⁻¹⁵ … 10¹².
const PREFIXES: [&str; 11] = ["a", "f", "p", "n", "µ", "m", "", "k", "M", "G", "T"];

/// A unit without prefix.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// m
    Metre,
    /// m²
    SquareMetre,
    /// m³
    CubicMetre,
    /// Pa
    Pascal,
    /// N
    Newton,
    /// N/m
    NewtonPerMetre,
}

impl Unit {
    /// All units.
    pub const ALL: [Self; 6] = [
        Self::Metre,
        Self::SquareMetre,
        Self::CubicMetre,
        Self::Pascal,
        Self::Newton,
        Self::NewtonPerMetre,
    ];

    /// Its name in ASCII, as in the headers of tables.
    #[must_use]
    pub fn ascii(self) -> &'static str {
        match self {
            Self::SquareMetre => "m^2",
            Self::CubicMetre => "m^3",
            _ => self.symbol(),
        }
    }

    /// Its name.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Metre => "m",
            Self::SquareMetre => "m²",
            Self::CubicMetre => "m³",
            Self::Pascal => "Pa",
            Self::Newton => "N",
            Self::NewtonPerMetre => "N/m",
        }
    }

    /// The power of the prefix: 1 µm² is (10⁻⁶ m)².
    fn power(self) -> i32 {
        match self {
            Self::SquareMetre => 2,
            Self::CubicMetre => 3,
            _ => 1,
        }
    }
}

/// A scale on which numbers of a given magnitude are easy to read.
#[derive(Debug, Clone, PartialEq)]
pub struct DisplayUnit {
    /// The divisor of a value.
    pub divisor: f64,
    /// The unit of the quotient: `µm`, `10⁻³ case units`; empty for bare case units.
    pub label: String,
}

impl DisplayUnit {
    /// The scale for values up to `largest`.
    #[must_use]
    pub fn of(largest: f64, unit: Unit, units: Units) -> Self {
        let power = unit.power();
        let magnitude = if largest == 0.0 || !largest.is_finite() {
            0.0
        } else {
            largest.abs().log10()
        };
        // The slack keeps 10⁻⁶ m, whose logarithm may round down, at 1 µm.
        let step = ((magnitude + 1e-9) / f64::from(3 * power)).floor();
        match units {
            Units::Si => Self::prefixed(step, unit),
            Units::Consistent => Self::power_of_ten(magnitude),
        }
    }

    /// The scale for values up to `largest` of a dimension: angles in degrees, compliances in nm/GPa, and those that
    /// have no prefixes in their SI unit.
    #[must_use]
    pub fn of_dimension(largest: f64, dimension: Option<Dimension>, units: Units) -> Self {
        let plain = |divisor, label: &str| Self {
            divisor,
            label: label.to_owned(),
        };
        let unit = match dimension {
            Some(Dimension::Length) => Unit::Metre,
            Some(Dimension::Area) => Unit::SquareMetre,
            Some(Dimension::Volume) => Unit::CubicMetre,
            Some(Dimension::Pressure) => Unit::Pascal,
            Some(Dimension::Force) => Unit::Newton,
            Some(Dimension::Stiffness | Dimension::EnergyPerArea) => Unit::NewtonPerMetre,
            Some(Dimension::Angle) => return plain(1_f64.to_radians(), "°"),
            Some(Dimension::Compliance) if units == Units::Si => return plain(1e-18, "nm/GPa"),
            Some(other) if units == Units::Si => return plain(1.0, other.si_unit()),
            _ => return plain(1.0, ""),
        };
        Self::of(largest, unit, units)
    }

    fn prefixed(step: f64, unit: Unit) -> Self {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "clamped to the eleven prefixes"
        )]
        let step = step.clamp(-6.0, 4.0) as i32;
        let prefix = PREFIXES[step.abs_diff(-6) as usize];
        Self {
            divisor: 10_f64.powi(3 * step * unit.power()),
            label: format!("{prefix}{}", unit.symbol()),
        }
    }

    fn power_of_ten(magnitude: f64) -> Self {
        if (-3.0..4.0).contains(&magnitude) {
            return Self {
                divisor: 1.0,
                label: String::new(),
            };
        }
        #[expect(
            clippy::cast_possible_truncation,
            reason = "the logarithm of an f64 is below 309"
        )]
        let exponent = 3 * ((magnitude + 1e-9) / 3.0).floor() as i32;
        Self {
            divisor: 10_f64.powi(exponent),
            label: format!("10{} case units", superscript(exponent)),
        }
    }

    /// The value with five digits and its unit: `1.2346 µm`.
    #[must_use]
    pub fn with_unit(&self, value: f64) -> String {
        format!("{} {}", significant(value / self.divisor, 5), self.label)
    }
}

/// An error with two digits on the scale of its value: `± 0.29 µm²`.
#[must_use]
pub fn error_of(value: f64, error: f64, unit: Unit, units: Units) -> String {
    let error_on = |scale: DisplayUnit| {
        format!(
            "± {} {}",
            significant(error / scale.divisor, 2),
            scale.label
        )
    };
    match units {
        Units::Si => error_on(DisplayUnit::of(value, unit, units)),
        Units::Consistent => format!("± {}", significant(error, 2)),
    }
}

/// The value on its own scale, with its unit.
#[must_use]
pub fn quantity(value: f64, unit: Unit, units: Units) -> String {
    match units {
        Units::Si => DisplayUnit::of(value, unit, units).with_unit(value),
        Units::Consistent => significant(value, 5),
    }
}

/// Part of an element within which a coordinate counts as zero: the search for a peak on an axis ends slightly beside
/// it, where a length of picometres would say nothing.
const ON_AXIS: f64 = 1e-3;

/// The coordinates of a point on a grid of elements of this side; those that are zero to the accuracy of a place, as 0.
#[must_use]
pub fn settled<const AXES: usize>(at: [f64; AXES], element_side: f64) -> [f64; AXES] {
    at.map(|along| {
        if along.abs() < ON_AXIS * element_side {
            0.0
        } else {
            along
        }
    })
}

/// The same with their units: `0 m, 1.2000 µm`.
#[must_use]
pub fn position<const AXES: usize>(at: [f64; AXES], element_side: f64, units: Units) -> String {
    let metres = |along| quantity(along, Unit::Metre, units);
    settled(at, element_side).map(metres).join(", ")
}

/// A number of bytes: `85 MB`, `1.4 GB`.
#[must_use]
pub fn memory(bytes: u64) -> String {
    let megabytes = bytes as f64 / 1e6;
    if megabytes < 999.5 {
        format!("{} MB", significant(megabytes, 2))
    } else {
        format!("{} GB", significant(megabytes / 1e3, 2))
    }
}

/// The value with this many significant digits.
#[must_use]
pub fn significant(value: f64, digits: usize) -> String {
    let size = value.abs();
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    if !(1e-3..1e6).contains(&size) {
        return format!("{value:.*e}", digits - 1);
    }
    // The exponent after rounding: 9.99999 rounds to 10.
    let rounded = format!("{value:.*e}", digits - 1);
    let exponent = rounded
        .rsplit('e')
        .next()
        .and_then(|text| text.parse().ok());
    let digits = i32::try_from(digits).unwrap_or(i32::MAX);
    let after = digits.saturating_sub(1 + exponent.unwrap_or(0));
    format!("{value:.*}", usize::try_from(after).unwrap_or(0))
}

/// The value with at most three digits, without trailing zeros.
#[must_use]
pub fn short(value: f64) -> String {
    let rounded = significant(value, 3);
    rounded
        .parse::<f64>()
        .map_or(rounded, |value| value.to_string())
}

/// A range: `0.1 to 10 mN`.
#[must_use]
pub fn span([least, most]: [f64; 2], scale: &DisplayUnit) -> String {
    let number = |value: f64| short(value / scale.divisor);
    format!("{} to {} {}", number(least), number(most), scale.label)
}

/// A count: `1 curve`, `2 curves`.
#[must_use]
pub fn count(number: usize, noun: &str) -> String {
    match number {
        1 => format!("1 {noun}"),
        number => format!("{number} {noun}s"),
    }
}

/// An integer as an exponent: `⁻³`.
#[must_use]
pub fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raise = |c: char| c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]);
    exponent.to_string().chars().map(raise).collect()
}

/// A quantity of a case with its unit; an angle, in rad, is shown in degrees, a compliance in nm/GPa.
#[must_use]
pub fn dimensional(value: f64, dimension: Dimension, units: Units) -> String {
    let of = |unit| quantity(value, unit, units);
    match (dimension, units) {
        (Dimension::Angle, _) => format!("{}°", significant(value.to_degrees(), 5)),
        (Dimension::Length, _) => of(Unit::Metre),
        (Dimension::Pressure, _) => of(Unit::Pascal),
        (Dimension::Force, _) => of(Unit::Newton),
        (Dimension::Stiffness | Dimension::EnergyPerArea, _) => of(Unit::NewtonPerMetre),
        (Dimension::Area, _) => of(Unit::SquareMetre),
        (Dimension::Volume, _) => of(Unit::CubicMetre),
        (_, Units::Consistent) => significant(value, 5),
        (Dimension::Compliance, Units::Si) => format!("{} nm/GPa", significant(value * 1e18, 5)),
        (
            Dimension::FrameCompliance
            | Dimension::WearCoefficient
            | Dimension::Time
            | Dimension::Speed,
            Units::Si,
        ) => {
            format!("{} {}", significant(value, 5), dimension.si_unit())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn si(value: f64, unit: Unit) -> String {
        quantity(value, unit, Units::Si)
    }

    #[test]
    fn si_values_get_a_suitable_prefix() {
        assert_eq!(si(1.01301e-6, Unit::Metre), "1.0130 µm");
        assert_eq!(si(1e-6, Unit::Metre), "1.0000 µm");
        assert_eq!(si(9.999_999_99, Unit::Newton), "10.000 N");
        assert_eq!(si(471.336e6, Unit::Pascal), "471.34 MPa");
        assert_eq!(si(2.3e-3, Unit::Newton), "2.3000 mN");
        assert_eq!(si(3.18245e-8, Unit::SquareMetre), "31825 µm²");
        assert_eq!(si(0.0, Unit::Metre), "0 m");
        assert_eq!(si(-5e-9, Unit::Metre), "-5.0000 nm");
        assert_eq!(si(1e-30, Unit::Metre), "1.0000e-12 am");
        assert_eq!(si(f64::INFINITY, Unit::Metre), "inf m");
    }

    #[test]
    fn a_place_on_an_axis_is_printed_as_zero() {
        let place = |at| position(at, 400e-9, Units::Si);
        assert_eq!(place([-115e-12, 1.2e-6, 0.0]), "0 m, 1.2000 µm, 0 m");
        assert_eq!(
            place([-115e-11, 0.5e-9, 4e-10]),
            "-1.1500 nm, 500.00 pm, 400.00 pm"
        );
    }

    #[test]
    fn an_error_is_printed_in_the_unit_of_its_value() {
        let error = error_of(9.96e-11, 2.94e-13, Unit::SquareMetre, Units::Si);
        assert_eq!(error, "± 0.29 µm²");
        assert_eq!(
            error_of(0.2, 0.0123, Unit::Pascal, Units::Consistent),
            "± 0.012"
        );
    }

    #[test]
    fn a_case_without_units_is_printed_without_units() {
        assert_eq!(
            quantity(6.38e-4, Unit::Metre, Units::Consistent),
            "6.3800e-4"
        );
        assert_eq!(
            DisplayUnit::of(0.05, Unit::Metre, Units::Consistent).label,
            ""
        );
        let small = DisplayUnit::of(2e-5, Unit::Pascal, Units::Consistent);
        assert_eq!(
            (small.divisor, small.label.as_str()),
            (1e-6, "10⁻⁶ case units")
        );
    }

    #[test]
    fn short_numbers_have_no_trailing_zeros() {
        assert_eq!(short(0.1), "0.1");
        assert_eq!(short(10.0), "10");
    }
}
