//! Numbers that a text states above its table: the spring constant of the cantilever, its sensitivity, the radius of
//! the tip, the compliance of the frame.
//!
//! A line states a number by a name, a value and a unit, `k (N/m)<tab>0.019`, `Tip radius: 27.5 um`. The text exports
//! of JPK and of afmformats give spring constants without a unit, in N/m. Nominal numbers are not those of the tip.

use pellicle::input::dimension::Dimension;
use pellicle::input::quantity;

use super::columns::calibration;
use super::header::{Electrical, HeaderField, bare};

/// Two numbers that differ by more than this fraction are not the same one rounded.
const SAME: f64 = 0.01;
/// Marks between a name and its value, the surest first.
const MARKS: [char; 5] = ['\t', '=', ':', ';', ','];

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
    /// The line, from 1.
    pub line: usize,
    /// The text of the line, without its indentation.
    pub text: String,
}

impl StatedNumber {
    /// The numbers that some lines state, the first of each quantity.
    #[must_use]
    pub fn all(lines: &[&str]) -> Vec<Self> {
        let mut found: Vec<Self> = Vec::new();
        for (index, text) in lines.iter().enumerate() {
            let Some((quantity, value)) = number(text) else {
                continue;
            };
            if found.iter().all(|known| known.quantity != quantity) {
                let (line, text) = (index + 1, text.split_whitespace().collect::<Vec<_>>());
                let text = text.join(" ");
                found.push(Self {
                    quantity,
                    value,
                    line,
                    text,
                });
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

    /// The quantity of a name, and by how much its value is to be multiplied.
    fn named(name: &str) -> Option<(Self, f64)> {
        let words = words(name);
        let has = |wanted: &[&str]| words.iter().any(|word| wanted.contains(&word.as_str()));
        if has(&["nominal"]) {
            return None;
        }
        if let Some(position) = Self::position(&words) {
            return Some((position, 1.0));
        }
        let is_spring = has(&["spring"]) && has(&["constant", "const"]) || words == ["k"];
        let is_spring = is_spring || has(&["springconstant"]);
        if is_spring && !has(&["lateral", "torsional", "support"]) {
            return Some((Self::SpringConstant, 1.0));
        }
        let is_sensitivity =
            has(&["sensitivity", "sens"]) && has(&["deflection", "defl", "optical"]);
        if is_sensitivity || has(&["invols"]) || words == ["inv", "ols"] {
            return Some((Self::Sensitivity, 1.0));
        }
        if has(&["frame", "machine", "instrument"]) && has(&["compliance"]) {
            return Some((Self::FrameCompliance, 1.0));
        }
        match (has(&BODIES), has(&["radius"]), has(&["diameter"])) {
            (true, true, false) => Some((Self::TipRadius, 1.0)),
            (true, false, true) => Some((Self::TipRadius, 0.5)),
            _ => None,
        }
    }
}

impl StatedQuantity {
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
}

/// The quantity and the SI value that a line states.
fn number(line: &str) -> Option<(StatedQuantity, f64)> {
    let plain = line.trim_start_matches(['#', '%']).trim();
    MARKS.iter().find_map(|mark| {
        let (name, value) = plain.split_once(*mark)?;
        let name = name.trim().trim_end_matches([':', '=']).trim_matches('"');
        let in_name = name.rsplit_once(['(', '[']).map(|(_, unit)| bare(unit));
        let name = HeaderField::new(name);
        let (quantity, factor) = StatedQuantity::named(&name.name)?;
        if quantity == StatedQuantity::Sensitivity {
            let (value, unit) = value_and_unit(value)?;
            let unit = Some(unit).filter(|unit| !unit.is_empty()).or(in_name)?;
            let (size, of) = calibration(unit, quantity.dimension())?;
            let is_one = of == Electrical::Voltage && value > 0.0 && value.is_finite();
            return is_one.then_some((quantity, value * size));
        }
        let (value, unit) = value_and_unit(value)?;
        let unit = match [name.unit_text.as_str(), unit]
            .iter()
            .find(|unit| !unit.is_empty())
        {
            Some(unit) => quantity::one(unit, quantity.dimension()).ok()?,
            None if line.starts_with('#') && is_bare(&name.name) => 1.0,
            None => return None,
        };
        let value = factor * value * unit;
        let is_place = [StatedQuantity::PositionX, StatedQuantity::PositionY].contains(&quantity);
        ((is_place || value > 0.0) && value.is_finite()).then_some((quantity, value))
    })
}

/// Whether the exports of JPK and afmformats give the quantity of this name without a unit, in SI.
fn is_bare(name: &str) -> bool {
    let name = name.to_lowercase();
    name.contains("spring") || name.contains("position")
}

/// A number at the beginning of a text, with either decimal mark, and the unit behind it.
fn value_and_unit(text: &str) -> Option<(f64, &str)> {
    let text = text.trim_matches([' ', '\t', '"', ',', ';', ':', '=']);
    let is_part = |c: char| c.is_ascii_digit() || "+-.,eE".contains(c);
    let end = text.find(|c| !is_part(c)).unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let value = number
        .trim_end_matches(',')
        .replacen(',', ".", 1)
        .parse()
        .ok()?;
    let unit = unit.split([',', ';', '\t']).next().unwrap_or_default();
    Some((
        value,
        unit.trim().trim_matches(['(', ')', '[', ']', '"']).trim(),
    ))
}

/// The words of a name in lower case, split at signs and within `springConstant`.
fn words(name: &str) -> Vec<String> {
    let mut split = String::new();
    let mut was_lower = false;
    for c in name.chars() {
        if was_lower && c.is_uppercase() {
            split.push(' ');
        }
        was_lower = c.is_lowercase();
        split.push(if c.is_alphanumeric() { c } else { ' ' });
    }
    split.split_whitespace().map(str::to_lowercase).collect()
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
            assert_eq!(found.0, quantity, "{line}");
            // A few roundings of products with units.
            assert!((found.1 / value - 1.0).abs() < 1e-14, "{line}: {found:?}");
        }
    }

    #[test]
    fn other_lines_state_none_of_them() {
        for line in [
            "Slope (N/m)\t0.000",
            "SpringConstant: 0.08",
            "Tip radius (um)\t0.000",
            "Lateral spring constant (N/m): 80",
            "Contact radius (um)\t3",
            "Tip radius\t27.5",
            "Radius of curvature",
            "k\tvalue",
            "Support Spring Stiffness (N/m): 95",
            "Nominal tip radius (nm): 20",
            "  SpringConstant: 0.08",
            "# k: 40",
            "X (#)\t1",
            "Z-position (um)\t6833.680",
            "Piezo position (nm) (Measured)\t-10.3",
        ] {
            assert_eq!(number(line), None, "{line}");
        }
    }

    #[test]
    fn the_first_statement_counts_and_a_hundredth_is_the_same() {
        let lines = ["a", "k (N/m)\t0.019", "k (N/m)\t0.1"];
        let found = StatedNumber::all(&lines);
        assert_eq!((found.len(), found[0].line, found[0].value), (1, 2, 0.019));
        assert!(!found[0].contradicts(0.01915) && found[0].contradicts(0.0193));
    }
}
