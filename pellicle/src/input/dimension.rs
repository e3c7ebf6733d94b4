//! The dimensions of the quantities in a case: their units, allowed magnitudes and signs.

use std::ops::RangeInclusive;

/// The dimension of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// Metres.
    Length,
    /// Pascals: pressures and moduli.
    Pressure,
    /// Newtons.
    Force,
    /// Radians.
    Angle,
    /// Metres per pascal: a length over a pressure.
    Compliance,
    /// Newtons per metre: a force over a length.
    Stiffness,
    /// Joules per square metre, the same as newtons per metre.
    EnergyPerArea,
    /// Metres per newton: a length over a force.
    FrameCompliance,
    /// Square metres per newton: a worn volume over a force and a distance.
    WearCoefficient,
    /// Seconds.
    Time,
    /// Metres per second: a length over a time.
    Speed,
    /// Square metres.
    Area,
    /// Cubic metres.
    Volume,
}

impl Dimension {
    /// All dimensions.
    pub const ALL: [Self; 13] = [
        Self::Length,
        Self::Pressure,
        Self::Force,
        Self::Angle,
        Self::Compliance,
        Self::Stiffness,
        Self::EnergyPerArea,
        Self::FrameCompliance,
        Self::WearCoefficient,
        Self::Time,
        Self::Speed,
        Self::Area,
        Self::Volume,
    ];

    /// Its name in a message.
    #[must_use]
    pub fn noun(self) -> &'static str {
        match self {
            Self::Length => "a length",
            Self::Pressure => "a pressure",
            Self::Force => "a force",
            Self::Angle => "an angle",
            Self::Compliance => "a compliance",
            Self::Stiffness => "a stiffness",
            Self::EnergyPerArea => "an energy per area",
            Self::FrameCompliance => "a frame compliance",
            Self::WearCoefficient => "a wear coefficient",
            Self::Time => "a time",
            Self::Speed => "a rate",
            Self::Area => "an area",
            Self::Volume => "a volume",
        }
    }

    /// Its SI unit.
    #[must_use]
    pub fn si_unit(self) -> &'static str {
        match self {
            Self::Length => "m",
            Self::Pressure => "Pa",
            Self::Force => "N",
            Self::Angle => "rad",
            Self::Compliance => "m/Pa",
            Self::Stiffness => "N/m",
            Self::EnergyPerArea => "J/m^2",
            Self::FrameCompliance => "m/N",
            Self::WearCoefficient => "m^2/N",
            Self::Time => "s",
            Self::Speed => "m/s",
            Self::Area => "m^2",
            Self::Volume => "m^3",
        }
    }

    /// An example, as written in a case.
    #[must_use]
    pub fn example(self) -> &'static str {
        match self {
            Self::Length => "\"5 nm\"",
            Self::Pressure => "\"70 GPa\"",
            Self::Force => "\"2.3 mN\"",
            Self::Angle => "\"65.03 deg\"",
            Self::Compliance => "\"5 nm/GPa\"",
            Self::Stiffness => "\"0.04 N/m\"",
            Self::EnergyPerArea => "\"50 mJ/m^2\"",
            Self::FrameCompliance => "\"0.2 nm/mN\"",
            Self::WearCoefficient => "\"1e-15 m^2/N\"",
            Self::Time => "\"5 s\"",
            Self::Speed => "\"0.02 nm/s\"",
            Self::Area => "\"30 um^2\"",
            Self::Volume => "\"2 um^3\"",
        }
    }

    /// The most common units; each may have its usual prefixes.
    #[must_use]
    pub fn unit_names(self) -> &'static [&'static str] {
        match self {
            Self::Length => &[
                "m", "km", "cm", "mm", "um", "µm", "nm", "pm", "angstrom", "Å", "in", "ft", "mil",
            ],
            Self::Pressure => &[
                "Pa", "kPa", "MPa", "GPa", "TPa", "N/m^2", "N/mm^2", "bar", "psi",
            ],
            Self::Force => &["N", "kN", "mN", "uN", "µN", "nN", "pN", "lbf"],
            Self::Angle => &["deg", "°", "rad", "gon"],
            Self::Compliance => &["m/Pa", "um/MPa", "nm/GPa", "a length / a pressure"],
            Self::Stiffness => &["N/m", "mN/um", "µN/nm", "nN/nm", "a force / a length"],
            Self::EnergyPerArea => &["J/m^2", "mJ/m^2", "uJ/m^2", "N/m", "mN/m"],
            Self::FrameCompliance => &["m/N", "nm/mN", "um/N", "a length / a force"],
            Self::WearCoefficient => &["m^2/N", "um^2/N", "mm^3/Nm", "mm^3/N/m"],
            Self::Time => &["s", "ms", "us", "µs", "ns", "min", "h"],
            Self::Speed => &["m/s", "nm/s", "um/h", "a length / a time"],
            Self::Area => &["m^2", "cm^2", "mm^2", "um^2", "µm^2", "nm^2"],
            Self::Volume => &["m^3", "mm^3", "um^3", "µm^3", "nm^3"],
        }
    }

    /// The allowed magnitudes, in SI units or the case's own. They are far beyond anything measured, yet products of
    /// several still fit into 64 bits.
    #[must_use]
    pub fn magnitudes(self) -> RangeInclusive<f64> {
        match self {
            Self::Length | Self::Pressure => 1e-30..=1e30,
            // Any force, however small, is a valid load; the certificate shows whether it could be solved.
            Self::Force => f64::from_bits(1)..=1e60,
            Self::Compliance
            | Self::Stiffness
            | Self::EnergyPerArea
            | Self::FrameCompliance
            | Self::WearCoefficient
            | Self::Time
            | Self::Speed
            | Self::Area
            | Self::Volume => 1e-60..=1e60,
            Self::Angle => 0.0..=f64::MAX,
        }
    }
}

/// The sign a quantity must have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sign {
    /// Any finite number.
    Any,
    /// Zero or more.
    NotNegative,
    /// More than zero.
    Positive,
}

impl Sign {
    /// Whether a value is finite and has this sign.
    #[must_use]
    pub fn allows(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Any => true,
                Self::NotNegative => value >= 0.0,
                Self::Positive => value > 0.0,
            }
    }

    /// Describes the wanted values: `a positive length such as "5 nm"`.
    #[must_use]
    pub fn wanted(self, dimension: Dimension) -> String {
        let noun = dimension.noun();
        let bare = noun.trim_start_matches("an ").trim_start_matches("a ");
        let noun = match self {
            Self::Any => format!("a finite {bare}"),
            Self::NotNegative => format!("{noun} of zero or more"),
            Self::Positive => format!("a positive {bare}"),
        };
        let or_bare = match dimension {
            Dimension::Angle => "a bare number in radians",
            _ => "a bare number",
        };
        format!("{noun} such as {}, or {or_bare}", dimension.example())
    }
}

#[cfg(test)]
mod tests {
    use super::super::quantity;
    use super::*;

    #[test]
    fn every_listed_unit_is_parsed() {
        for dimension in Dimension::ALL {
            for unit in dimension
                .unit_names()
                .iter()
                .filter(|unit| !unit.contains(' '))
            {
                let one = quantity::one(unit, dimension);
                assert!(one.is_ok_and(|one| one > 0.0), "{unit}");
            }
        }
    }
}
