//! What a quantity may be written in, and how large it may be.

use std::ops::RangeInclusive;

use super::quantity::Dimension;

/// The units that people write most; each may have its usual prefixes.
#[must_use]
pub fn names(dimension: Dimension) -> &'static [&'static str] {
    match dimension {
        Dimension::Length => &[
            "m", "km", "cm", "mm", "um", "µm", "nm", "pm", "angstrom", "Å", "in", "ft", "mil",
        ],
        Dimension::Pressure => &[
            "Pa", "kPa", "MPa", "GPa", "TPa", "N/m^2", "N/mm^2", "bar", "psi",
        ],
        Dimension::Force => &["N", "kN", "mN", "uN", "µN", "nN", "pN", "lbf"],
        Dimension::Angle => &["deg", "°", "rad", "gon"],
        Dimension::Compliance => &["m/Pa", "um/MPa", "nm/GPa", "a length / a pressure"],
    }
}

/// How large the size of a quantity may be, in SI units or the case's own: far beyond all that is measured, and such
/// that products of several are numbers of 64 bits.
#[must_use]
pub fn sizes(dimension: Dimension) -> RangeInclusive<f64> {
    match dimension {
        Dimension::Length | Dimension::Pressure => 1e-30..=1e30,
        // A force however small is a load; whether it can be solved for the certificate says.
        Dimension::Force => f64::from_bits(1)..=1e60,
        Dimension::Compliance => 1e-60..=1e60,
        Dimension::Angle => 0.0..=f64::MAX,
    }
}

#[cfg(test)]
mod tests {
    use super::super::quantity;
    use super::*;

    #[test]
    fn every_unit_that_is_named_is_read() {
        for dimension in [
            Dimension::Length,
            Dimension::Pressure,
            Dimension::Force,
            Dimension::Angle,
            Dimension::Compliance,
        ] {
            for unit in names(dimension).iter().filter(|unit| !unit.contains(' ')) {
                let one = quantity::one(unit, dimension);
                assert!(one.is_ok_and(|one| one > 0.0), "{unit}");
            }
        }
    }
}
