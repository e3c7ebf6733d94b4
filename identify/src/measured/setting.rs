//! A setting above a table: the words of its name, its value, and the unit at either of them.
//!
//! `k (N/m)<tab>0.019`, `InvOLS: 55 nm/V`, `# sensitivity: 5.5e-08`, `\@Sens. DeflSens: V 55 nm/V`.

use super::columns::is_calibration;
use super::header::{HeaderUnit, kind, name_and_unit};
use super::words::lower_words;

/// Marks between a name and its value, the surest first.
const MARKS: [char; 5] = ['\t', '=', ':', ';', ','];
/// Marks of comments and quotations before a name, and those of Nanoscope's lists.
const LEADING: [char; 8] = ['#', '%', '*', '\\', '@', '"', ' ', '\t'];

/// A setting.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Setting {
    /// The words of its name, in lower case.
    pub(super) words: Vec<String>,
    /// Its value in its unit.
    pub(super) value: f64,
    /// Its unit as written, known or not; none if there is none.
    pub(super) unit: Option<String>,
}

impl Setting {
    /// The ways to read a line as a setting, the surest first.
    pub(super) fn ways(line: &str) -> impl Iterator<Item = Self> + '_ {
        let plain = line.trim_start_matches(LEADING).trim_end();
        MARKS.iter().filter_map(move |mark| {
            let (name, value) = plain.split_once(*mark)?;
            Self::read(name, value)
        })
    }

    fn read(name: &str, value: &str) -> Option<Self> {
        let name = name.trim_matches([' ', '\t', '"', ':', '=']);
        let (value, behind) = value_and_unit(value)?;
        let (name, inside) = match name_and_unit(name, is_unit) {
            Some((name, unit)) => (name, Some(unit)),
            None => match name.rsplit_once(['(', '[']) {
                Some((name, unit)) => (name.to_owned(), Some(unit.trim_end_matches([')', ']']))),
                None => (name.to_owned(), None),
            },
        };
        let unit = Some(behind).filter(|unit| !unit.is_empty()).or(inside);
        let (words, unit) = (lower_words(&name), unit.map(str::to_owned));
        Some(Self { words, value, unit })
    }
}

/// Whether a text is a unit of a setting.
fn is_unit(text: &str) -> bool {
    kind(text) != HeaderUnit::None || is_calibration(text)
}

/// A number at the beginning of a text, with either decimal mark, and the unit behind it. Nanoscope writes a `V` before
/// a value.
fn value_and_unit(text: &str) -> Option<(f64, &str)> {
    const AROUND: [char; 11] = [' ', '\t', '"', ',', ';', ':', '=', '(', ')', '[', ']'];
    let text = text.trim_matches(AROUND);
    let text = text.strip_prefix("V ").unwrap_or(text).trim_start();
    let is_part = |c: char| c.is_ascii_digit() || "+-.,eE".contains(c);
    let end = text.find(|c| !is_part(c)).unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let number = number.trim_end_matches(',').replacen(',', ".", 1);
    let unit = unit.trim_start_matches(AROUND);
    let unit = unit.split([',', ';', '\t']).next().unwrap_or_default();
    Some((number.parse().ok()?, unit.trim_matches(AROUND)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unit_stands_at_the_name_or_behind_the_value() {
        for line in [
            "InvOLS (nm/V): 5,5",
            "# InvOLS: 5.5 nm/V",
            "InvOLS, nm/V\t5.5",
            "InvOLS,5.5,nm/V",
            "\\@InvOLS: V 5.5 nm/V",
            "\"InvOLS\" = 5.5 [nm/V]",
        ] {
            let found = Setting::ways(line).next().expect(line);
            assert_eq!(
                (found.words, found.value),
                (vec!["invols".into()], 5.5),
                "{line}"
            );
            assert_eq!(found.unit.as_deref(), Some("nm/V"), "{line}");
        }
    }

    #[test]
    fn what_stands_in_brackets_is_no_word_even_if_it_is_no_unit() {
        let found = Setting::ways("X (#)\t1").next().expect("a setting");
        assert_eq!(
            (found.words.concat().as_str(), found.unit.as_deref()),
            ("x", Some("#"))
        );
        assert_eq!(
            Setting::ways("springConstant: 0.08")
                .next()
                .expect("a setting")
                .unit,
            None
        );
    }
}
