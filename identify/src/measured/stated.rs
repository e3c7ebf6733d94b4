//! Numbers that a text states above its table: the spring constant of the cantilever, its sensitivity, the radius of
//! the tip, the compliance of the frame.
//!
//! A line states a number by the words of a name, a value and a unit at either of them (`setting`). Without a unit a
//! number is in SI units, as JPK, Asylum and afmformats write them, if it then has a usual size. Nominal numbers are
//! not those of the tip.

use std::ops::RangeInclusive;

use pellicle::input::dimension::Dimension;
use pellicle::input::quantity;

use super::columns::calibration;
use super::header::Electrical;
use super::setting::Setting;

/// Two numbers that differ by more than this fraction are not the same one rounded.
const SAME: f64 = 0.01;

/// Words of settings that are no calibration of the bending of a cantilever by the force, or none that counts.
const OTHERS: [&str; 20] = [
    "nominal",
    "lateral",
    "torsional",
    "torsion",
    "horizontal",
    "support",
    "piezo",
    "scanner",
    "x",
    "y",
    "z",
    "xsens",
    "ysens",
    "zsens",
    "height",
    "amp",
    "amplitude",
    "ampinvols",
    "error",
    "correction",
];

/// The words for what has the radius of the tip.
const BODIES: [&str; 8] = [
    "tip", "probe", "indenter", "sphere", "bead", "ball", "colloid", "particle",
];

/// A quantity that a text may state above its table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StatedQuantity {
    /// The spring constant of a cantilever, N/m.
    SpringConstant,
    /// The radius of the tip, m.
    TipRadius,
    /// What a volt of the deflection is, m/V.
    Sensitivity,
    /// The compliance of the frame of an instrument, m/N.
    FrameCompliance,
    /// Where on the specimen the curve was measured, along x, m.
    PositionX,
    /// The same along y, m.
    PositionY,
}

/// A number that a text states above its table.
#[derive(Debug, Clone, PartialEq)]
pub struct StatedNumber {
    /// The quantity.
    pub quantity: StatedQuantity,
    /// Its value, SI.
    pub value: f64,
    /// The unit in which it is taken, where the line states none.
    pub assumed_unit: Option<&'static str>,
    /// The line, from 1.
    pub line: usize,
    /// The text of the line, without its indentation.
    pub text: String,
}

impl StatedNumber {
    /// The numbers that some lines state: of each quantity the first with a unit, or else the first.
    #[must_use]
    pub fn all(lines: &[&str]) -> Vec<Self> {
        let mut found: Vec<Self> = Vec::new();
        for (index, text) in lines.iter().enumerate() {
            let Some(number) = number(text) else {
                continue;
            };
            let text: Vec<_> = text.split_whitespace().collect();
            let stated = Self {
                quantity: number.quantity,
                value: number.value,
                assumed_unit: number.assumed_unit,
                line: index + 1,
                text: text.join(" "),
            };
            match (found.iter_mut()).find(|known| known.quantity == stated.quantity) {
                None => found.push(stated),
                Some(known) if known.assumed_unit.is_some() && stated.assumed_unit.is_none() => {
                    *known = stated;
                }
                Some(_) => {}
            }
        }
        found
    }

    /// The number of a quantity among several.
    #[must_use]
    pub fn of(quantity: StatedQuantity, stated: &[Self]) -> Option<&Self> {
        stated.iter().find(|stated| stated.quantity == quantity)
    }

    /// Whether another value contradicts it.
    #[must_use]
    pub fn contradicts(&self, value: f64) -> bool {
        (value / self.value - 1.0).abs() > SAME
    }
}

impl StatedQuantity {
    fn dimension(self) -> Dimension {
        match self {
            Self::SpringConstant => Dimension::Stiffness,
            Self::FrameCompliance => Dimension::FrameCompliance,
            // A sensitivity is one over a volt.
            Self::Sensitivity | Self::TipRadius | Self::PositionX | Self::PositionY => {
                Dimension::Length
            }
        }
    }

    /// The sizes that show a number without a unit to be in SI units.
    fn usual(self) -> RangeInclusive<f64> {
        match self {
            Self::SpringConstant => 1e-4..=1e4,
            Self::Sensitivity => 1e-9..=1e-6,
            // Of a ball of a tenth of a millimetre at most: 0.05 may be one in millimetres.
            Self::TipRadius => 1e-9..=1e-4,
            Self::FrameCompliance => 1e-12..=1e-4,
            Self::PositionX | Self::PositionY => f64::MIN..=f64::MAX,
        }
    }

    /// The quantity of a name, and by how much its value is to be multiplied.
    fn named(words: &[String]) -> Option<(Self, f64)> {
        let has = |wanted: &[&str]| words.iter().any(|word| wanted.contains(&word.as_str()));
        if let Some(position) = Self::position(words) {
            return Some((position, 1.0));
        }
        let is_spring = has(&["spring", "force", "cantilever"]) && has(&["constant", "const"])
            || has(&[
                "springconstant",
                "forceconstant",
                "federkonstante",
                "kraftkonstante",
            ])
            || words == ["k"];
        if is_spring && !has(&OTHERS) {
            return Some((Self::SpringConstant, 1.0));
        }
        let is_sensitivity = has(&["sensitivity", "sens", "deflsens", "invols", "ols"]);
        if is_sensitivity && !has(&OTHERS) {
            return Some((Self::Sensitivity, 1.0));
        }
        if has(&["frame", "machine", "instrument"]) && has(&["compliance"]) {
            return Some((Self::FrameCompliance, 1.0));
        }
        match (has(&BODIES), has(&["radius"]), has(&["diameter"])) {
            _ if has(&["nominal"]) => None,
            (true, true, false) => Some((Self::TipRadius, 1.0)),
            (true, false, true) => Some((Self::TipRadius, 0.5)),
            _ if words == ["r"] || words == ["radius"] => Some((Self::TipRadius, 1.0)),
            _ if has(&["spitzenradius", "kugelradius"]) => Some((Self::TipRadius, 1.0)),
            _ => None,
        }
    }

    /// The coordinate of a name such as `X`, `X-position` or `position x`.
    fn position(words: &[String]) -> Option<Self> {
        let is_place = |word: &&String| ["position", "pos", "coordinate"].contains(&word.as_str());
        let rest: Vec<_> = words.iter().filter(|word| !is_place(word)).collect();
        match rest[..] {
            [axis] if axis == "x" => Some(Self::PositionX),
            [axis] if axis == "y" => Some(Self::PositionY),
            _ => None,
        }
    }

    /// Whether it may be zero or negative.
    fn is_signed(self) -> bool {
        matches!(self, Self::PositionX | Self::PositionY)
    }

    /// The SI value of a number with this unit; none if the unit is not of this quantity.
    fn with_unit(self, value: f64, unit: &str) -> Option<f64> {
        if self != Self::Sensitivity {
            return Some(value * quantity::one(unit, self.dimension()).ok()?);
        }
        let per_volt = |unit: &str| {
            let (size, of) = calibration(unit, self.dimension())?;
            (of == Electrical::Voltage).then_some(size)
        };
        // Some instruments state the volts of a length.
        let volts = || {
            let (volts, length) = unit.split_once('/')?;
            Some(per_volt(&format!("{length}/{volts}"))? / value)
        };
        per_volt(unit).map(|size| value * size).or_else(volts)
    }
}

/// A number of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Number {
    quantity: StatedQuantity,
    value: f64,
    assumed_unit: Option<&'static str>,
}

/// The number that a line states.
fn number(line: &str) -> Option<Number> {
    Setting::ways(line).find_map(|setting| {
        let (quantity, factor) = StatedQuantity::named(&setting.words)?;
        let known = |value: f64, assumed_unit| {
            let value = factor * value;
            let is_one = value.is_finite() && (value > 0.0 || quantity.is_signed());
            is_one.then_some(Number {
                quantity,
                value,
                assumed_unit,
            })
        };
        if let Some(unit) = &setting.unit {
            return known(quantity.with_unit(setting.value, unit)?, None);
        }
        // A single letter may be anything, and coordinates without a unit are in SI units only in comments.
        let says_little = setting.words.concat().len() == 1;
        if says_little || quantity.is_signed() && !line.starts_with('#') {
            return None;
        }
        let is_usual = |value: &f64| quantity.usual().contains(&(factor * value));
        if is_usual(&setting.value) {
            return known(setting.value, None);
        }
        let units = ["nm/V", "um/V"].into_iter();
        let mut units = units.filter(|_| quantity == StatedQuantity::Sensitivity);
        units.find_map(|unit| {
            let value = quantity.with_unit(setting.value, unit);
            known(value.filter(is_usual)?, Some(unit))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use StatedQuantity::{SpringConstant, TipRadius};

    #[test]
    fn spring_constants_and_radii_are_read_in_the_forms_of_instruments() {
        for (line, quantity, value) in [
            ("k (N/m)\t0.019", SpringConstant, 0.019),
            ("k (N/m)\t0,019", SpringConstant, 0.019),
            ("k, N/m:\t0.2", SpringConstant, 0.2),
            (
                "# springConstant: 0.061000000000000006",
                SpringConstant,
                0.061_000_000_000_000_006,
            ),
            ("#   \"spring constant\": 0.0223,", SpringConstant, 0.0223),
            ("Spring Constant [N/m];42,0", SpringConstant, 42.0),
            (
                "Cantilever spring constant = 200 pN/nm",
                SpringConstant,
                0.2,
            ),
            ("Tip radius (um)\t27.500", TipRadius, 27.5e-6),
            ("Probe Radius: 20 nm", TipRadius, 20e-9),
            ("Bead diameter (um),5", TipRadius, 2.5e-6),
            (
                "Deflection sensitivity (nm/V): 50",
                StatedQuantity::Sensitivity,
                50e-9,
            ),
            ("InvOLS: 60.5 nm/V", StatedQuantity::Sensitivity, 60.5e-9),
            ("SpringConstant: 0.08", SpringConstant, 0.08),
            ("\\Spring Constant: 0.08", SpringConstant, 0.08),
            ("Force Constant,0.6,N/m", SpringConstant, 0.6),
            (
                "Frame compliance (nm/mN)\t0.3",
                StatedQuantity::FrameCompliance,
                3e-7,
            ),
            ("X, um:\t25.000000", StatedQuantity::PositionX, 25e-6),
            (
                "Y-position (um)\t5500.880",
                StatedQuantity::PositionY,
                5500.88e-6,
            ),
            ("# xPosition: -1.5e-05", StatedQuantity::PositionX, -1.5e-5),
        ] {
            let found = number(line).expect(line);
            assert_eq!(
                (found.quantity, found.assumed_unit),
                (quantity, None),
                "{line}"
            );
            // A few roundings of products with units.
            assert!(
                (found.value / value - 1.0).abs() < 1e-14,
                "{line}: {found:?}"
            );
        }
    }

    #[test]
    fn other_lines_state_none_of_them() {
        for line in [
            "Slope (N/m)\t0.000",
            "Tip radius (um)\t0.000",
            "Lateral spring constant (N/m): 80",
            "Contact radius (um)\t3",
            "Tip radius\t27.5",
            "Radius of curvature",
            "k\tvalue",
            "Support Spring Stiffness (N/m): 95",
            "Nominal tip radius (nm): 20",
            "Spring constant (counts): 60",
            "Spring constant: 60 counts",
            "Spring constant error: 0.001",
            "Piezo sensitivity (nm/V): 12",
            "\\@Sens. Zsens: V 12.5 nm/V",
            "AmpInvOLS: 60e-9",
            "Sensitivity: 3 mN/V",
            "InvOLS: 4000000",
            "# k: 40",
            "X (#)\t1",
            "Z-position (um)\t6833.680",
            "Piezo position (nm) (Measured)\t-10.3",
        ] {
            assert_eq!(number(line), None, "{line}");
        }
    }

    #[test]
    fn a_sensitivity_is_read_wherever_its_unit_stands() {
        for line in [
            "# sensitivity: 5.5e-08",
            "InvOLS: 5.5e-08",
            "DeflInvOLS: 5.5e-08",
            "InvOLS (nm/V): 55",
            "InvOLS [nm/V]\t55.0",
            "Inv. OLS, nm/V; 55,0",
            "InvOLS: 55 nm/V",
            "InvOLS=0.055 um/V",
            "Defl. sens. (nm/V): 55",
            "\"\\@Sens. DeflSens: V 55.0 nm/V\"",
            "Sensitivity,55,nm/V",
            "Optical lever sensitivity (nm/mV): 0.055",
            "deflection_sensitivity = 55 nm/V",
            "Deflection sensitivity (V/m): 18181818.18181818",
            "Photodiode sensitivity: 18.18181818181818 mV/nm",
        ] {
            let found = number(line).expect(line);
            assert_eq!(
                (found.quantity, found.assumed_unit),
                (StatedQuantity::Sensitivity, None),
                "{line}"
            );
            // A few roundings of products with units.
            assert!(
                (found.value / 55e-9 - 1.0).abs() < 1e-14,
                "{line}: {found:?}"
            );
        }
    }

    #[test]
    fn a_sensitivity_without_a_unit_has_that_which_makes_it_usual() {
        for (line, unit) in [("InvOLS: 55", "nm/V"), ("Sensitivity: 0.055", "um/V")] {
            let found = number(line).expect(line);
            assert_eq!(found.assumed_unit, Some(unit), "{line}");
            // Two roundings of a product.
            assert!(
                (found.value / 55e-9 - 1.0).abs() < 1e-14,
                "{line}: {found:?}"
            );
        }
        let found = StatedNumber::all(&["InvOLS: 55", "Defl. sens. (nm/V): 54"]);
        assert_eq!(
            (found.len(), found[0].line, found[0].assumed_unit),
            (1, 2, None)
        );
    }

    #[test]
    fn the_first_statement_counts_and_a_hundredth_is_the_same() {
        let lines = ["a", "k (N/m)\t0.019", "k (N/m)\t0.1"];
        let found = StatedNumber::all(&lines);
        assert_eq!((found.len(), found[0].line, found[0].value), (1, 2, 0.019));
        assert!(!found[0].contradicts(0.01915) && found[0].contradicts(0.0193));
    }
}
