//! The header of a column: its name, and the unit that the file states for it.

use pellicle::input::dimension::Dimension;
use pellicle::input::quantity;

use super::channel::Channel;

/// Electrical units, with what they are and their size in V or A: a column in one of them needs a calibration.
const ELECTRICAL: [(&str, Electrical, f64); 7] = [
    ("V", Electrical::Voltage, 1.0),
    ("mV", Electrical::Voltage, 1e-3),
    ("uV", Electrical::Voltage, 1e-6),
    ("µV", Electrical::Voltage, 1e-6),
    ("A", Electrical::Current, 1.0),
    ("mA", Electrical::Current, 1e-3),
    ("nA", Electrical::Current, 1e-9),
];

/// Spellings of units in headers that a case file does not have.
const SPELLINGS: [(&str, &str); 12] = [
    ("Angstrom", "Å"),
    ("Angstroms", "Å"),
    ("angstrom", "Å"),
    ("angstroms", "Å"),
    ("sec", "s"),
    ("sec.", "s"),
    ("secs", "s"),
    ("seconds", "s"),
    ("msec", "ms"),
    ("micron", "um"),
    ("microns", "um"),
    ("Newton", "N"),
];

/// Prefixes of units in words.
const PREFIXES: [&str; 6] = ["pico", "nano", "micro", "milli", "kilo", "mega"];

/// The unit in the header of a column.
#[derive(Debug, Clone, PartialEq)]
pub enum HeaderUnit {
    /// No known unit.
    None,
    /// A unit of this dimension.
    Of(Dimension),
    /// A voltage or a current.
    Electrical,
}

/// What an electrical unit measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Electrical {
    /// A voltage, V.
    Voltage,
    /// A current, A.
    Current,
}

/// What an electrical unit measures, and its size in V or A; none for other units.
pub(super) fn electrical(unit: &str) -> Option<(Electrical, f64)> {
    let found = ELECTRICAL.iter().find(|(name, ..)| *name == unit);
    found.map(|(_, measures, size)| (*measures, *size))
}

/// The header of a column.
#[derive(Debug, Clone, PartialEq)]
pub struct HeaderField {
    /// The header as written, without quotation marks: `Depth (nm)`.
    pub text: String,
    /// The header without the unit: `Depth`.
    pub name: String,
    /// The text of the unit: `nm`; empty without a unit.
    pub unit_text: String,
    /// The kind of unit.
    pub unit: HeaderUnit,
    /// Another unit in a line of units below.
    pub other_unit: Option<String>,
}

impl HeaderField {
    /// Parses a header: a name, and a unit in round or square brackets or after a slash or a comma.
    #[must_use]
    pub fn new(text: &str) -> Self {
        let text = tidied(text);
        if let Some((name, unit)) = name_and_unit(&text, |unit| kind(unit) != HeaderUnit::None) {
            return Self {
                name,
                unit_text: spelling(unit).to_owned(),
                unit: kind(unit),
                other_unit: None,
                text,
            };
        }
        Self {
            name: text.clone(),
            unit_text: String::new(),
            unit: HeaderUnit::None,
            other_unit: None,
            text,
        }
    }

    /// Whether the name is that of a measured quantity.
    pub(super) fn is_quantity(&self) -> bool {
        Channel::ALL
            .iter()
            .any(|channel| channel.is_indicated_by(&self.name))
    }

    /// Adds the unit from a line of units.
    pub(super) fn with_unit(mut self, unit: &str) -> Self {
        let unit = spelling(bare(unit));
        match (&self.unit, kind(unit)) {
            (_, HeaderUnit::None) => {}
            (HeaderUnit::None, found) => {
                self.unit = found;
                unit.clone_into(&mut self.unit_text);
            }
            _ if unit == self.unit_text => {}
            _ => self.other_unit = Some(unit.to_owned()),
        }
        self
    }
}

/// Removes the brackets around a unit.
pub(super) fn bare(unit: &str) -> &str {
    let open = unit.trim().trim_start_matches(['(', '[']);
    open.trim_end_matches([')', ']']).trim()
}

/// Normalises white space and the micro sign.
fn tidied(text: &str) -> String {
    let words: Vec<_> = text.split_whitespace().collect();
    words.join(" ").replace('\u{3bc}', "µ")
}

/// The name of a text and the unit that it states, where that is one.
pub(super) fn name_and_unit(text: &str, is_unit: impl Fn(&str) -> bool) -> Option<(String, &str)> {
    let splits = splits(text).into_iter();
    let splits = splits.map(|(name, unit)| (name.to_owned(), unit));
    let mut splits = splits.chain(at_underscores(text)).chain(behind_blank(text));
    splits.find(|(_, unit)| is_unit(unit))
}

/// The ways of splitting a header into a name and a unit.
fn splits(text: &str) -> Vec<(&str, &str)> {
    let bracket = |open: char, close: char| {
        let (name, rest) = text.rsplit_once(open)?;
        let name = name.trim().trim_end_matches(['/', ',']).trim();
        Some((name, rest.trim_end().strip_suffix(close)?.trim()))
    };
    let behind = |mark: char| {
        let (name, unit) = text.split_once(mark)?;
        Some((name.trim(), bare(unit)))
    };
    [
        bracket('[', ']'),
        bracket('(', ')'),
        behind(','),
        behind('/'),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The only part of a name in underscores that is a unit, and the name without it: `Defl_pN_Ex`, `Defl_V_Ex`,
/// `force_uN`. An `m` may as well be a mean, an `A` a channel; nor is it the unit behind a prefix in words,
/// `load_micro_N`.
fn at_underscores(text: &str) -> Option<(String, &str)> {
    let parts: Vec<&str> = text.split('_').collect();
    let is_unit = |place: &usize| {
        let has_prefix = PREFIXES.contains(&parts[place - 1].to_lowercase().as_str());
        let is_known = kind(parts[*place]) != HeaderUnit::None;
        !["m", "A"].contains(&parts[*place]) && is_known && !has_prefix
    };
    let places: Vec<usize> = (1..parts.len()).filter(is_unit).collect();
    let [place] = places[..] else {
        return None;
    };
    let rest = parts
        .iter()
        .enumerate()
        .filter(|(other, _)| *other != place);
    let rest: Vec<&str> = rest.map(|(_, part)| *part).collect();
    Some((rest.join("_"), parts[place]))
}

/// The last word of a name, if it is a unit of the quantity that the words before it name: `Depth um`, `Load N`.
fn behind_blank(text: &str) -> Option<(String, &str)> {
    let (name, unit) = text.rsplit_once(' ')?;
    let is_of = |channel: &Channel| {
        kind(unit) == HeaderUnit::Of(channel.dimension()) && channel.is_indicated_by(name)
    };
    let is_volts = kind(unit) == HeaderUnit::Electrical && unit.ends_with('V');
    let is_unit = is_volts || Channel::ALL.iter().any(is_of);
    is_unit.then(|| (name.trim().to_owned(), unit))
}

/// The unit in the spelling of a case file.
fn spelling(unit: &str) -> &str {
    let found = SPELLINGS.iter().find(|(other, _)| *other == unit);
    found.map_or(unit, |(_, unit)| unit)
}

/// The kind of a unit without brackets.
pub(super) fn kind(unit: &str) -> HeaderUnit {
    let unit = spelling(unit);
    if electrical(unit).is_some() {
        return HeaderUnit::Electrical;
    }
    quantity::dimension_of(&format!("1 {unit}")).map_or(HeaderUnit::None, HeaderUnit::Of)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_read_in_brackets_or_after_a_slash_or_comma() {
        for text in [
            "Depth (nm)",
            "Depth[nm]",
            "Depth/nm",
            "Depth, nm",
            " Depth  [ nm ]",
            "Depth / (nm)",
        ] {
            let head = HeaderField::new(text);
            let found = (head.name.as_str(), head.unit_text.as_str(), head.unit);
            assert_eq!(
                found,
                ("Depth", "nm", HeaderUnit::Of(Dimension::Length)),
                "{text}"
            );
        }
        let stiffness = HeaderField::new("Harmonic Contact Stiffness [N/m]");
        assert_eq!(stiffness.unit, HeaderUnit::Of(Dimension::Stiffness));
        let stiffness = HeaderField::new("Stiffness, N/m");
        assert_eq!(stiffness.unit, HeaderUnit::Of(Dimension::Stiffness));
        assert_eq!(HeaderField::new("Load (\u{3bc}N)").unit_text, "µN");
        assert_eq!(HeaderField::new("Depth (V)").unit, HeaderUnit::Electrical);
        assert_eq!(HeaderField::new("Load (raw)").name, "Load (raw)");
    }

    #[test]
    fn units_in_underscores_and_other_spellings_are_read() {
        for (text, unit) in [
            ("Defl_pN_Ex", "pN"),
            ("Defl_V_Ex", "V"),
            ("load_A", ""),
            ("Calc_Ramp_Rt_nm", "nm"),
            ("Time_s_Ex", "s"),
            ("force_uN", "uN"),
            ("Time (sec)", "s"),
            ("m_s_N", ""),
            ("load_micro_N", ""),
            ("depth_m", ""),
            ("N_1", ""),
            ("Depth um", "um"),
            ("Load On Sample mN", "mN"),
            ("Deflection V", "V"),
            ("Load A", ""),
            ("Load s", ""),
            ("Standard m", ""),
        ] {
            assert_eq!(HeaderField::new(text).unit_text, unit, "{text}");
        }
    }
}
