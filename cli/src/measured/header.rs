//! The head of a column: its name, and the unit that the file states for it.

use super::separator::Separator;
use crate::input::dimension::Dimension;
use crate::input::quantity;

/// Units of what is no quantity of a contact: a column in one of them needs a calibration.
const ELECTRICAL: [&str; 7] = ["V", "mV", "uV", "µV", "A", "mA", "nA"];

/// The unit in the head of a column.
#[derive(Debug, Clone, PartialEq)]
pub enum HeaderUnit {
    /// Nothing that is known as a unit.
    None,
    /// A unit of this dimension.
    Of(Dimension),
    /// A voltage or a current.
    Electrical,
}

/// The head of a column.
#[derive(Debug, Clone, PartialEq)]
pub struct HeaderField {
    /// As written, without quotation marks: `Depth (nm)`.
    pub text: String,
    /// Without the unit: `Depth`.
    pub name: String,
    /// The text of the unit: `nm`; empty without.
    pub unit_text: String,
    /// The kind of unit.
    pub unit: HeaderUnit,
}

impl HeaderField {
    /// The head with this text: a name, and a unit in round or square brackets or behind a slash or a comma.
    #[must_use]
    pub fn new(text: &str) -> Self {
        let text = tidied(text);
        for (name, unit) in splits(&text) {
            let kind = kind(unit);
            if kind != HeaderUnit::None {
                return Self {
                    name: name.to_owned(),
                    unit_text: unit.to_owned(),
                    unit: kind,
                    text,
                };
            }
        }
        Self {
            name: text.clone(),
            unit_text: String::new(),
            unit: HeaderUnit::None,
            text,
        }
    }

    /// The same with the unit of a line of units.
    fn with_unit(mut self, unit: &str) -> Self {
        let unit = bare(unit);
        if self.unit == HeaderUnit::None && kind(unit) != HeaderUnit::None {
            self.unit = kind(unit);
            unit.clone_into(&mut self.unit_text);
        }
        self
    }
}

/// The heads in the lines above the first row, nearest last; none if they are not heads of a table `width` wide.
#[must_use]
pub fn above(lines: &[&str], separator: Separator, width: usize) -> Vec<HeaderField> {
    let mut lines = lines.iter().rev();
    let Some(fields) = next_fields(&mut lines, separator) else {
        return Vec::new();
    };
    if is_line_of_units(&fields) {
        let names = next_fields(&mut lines, separator).unwrap_or_default();
        if is_head(&names, separator, width) {
            let units = fields.iter().copied().chain(std::iter::repeat(""));
            let with_unit = |(name, unit): (&&str, &str)| HeaderField::new(name).with_unit(unit);
            return names.iter().zip(units).map(with_unit).collect();
        }
    }
    if !is_head(&fields, separator, width) {
        return Vec::new();
    }
    fields.iter().map(|field| HeaderField::new(field)).collect()
}

/// The fields of the next line upwards, over one empty line at most.
fn next_fields<'t>(
    lines: &mut std::iter::Rev<std::slice::Iter<'_, &'t str>>,
    separator: Separator,
) -> Option<Vec<&'t str>> {
    let is_empty = |line: &str| line.trim().is_empty();
    let line = match lines.next()? {
        line if is_empty(line) => lines.next().filter(|line| !is_empty(line))?,
        line => line,
    };
    let line = line.trim_start_matches(['#', '%']);
    let mut fields = joined(separator.fields(line), line, separator);
    while fields.last() == Some(&"") {
        fields.pop();
    }
    Some(fields)
}

/// The fields with a unit in brackets joined to its name where blanks separate: `Depth (nm)` is one field.
fn joined<'t>(fields: Vec<&'t str>, line: &'t str, separator: Separator) -> Vec<&'t str> {
    if separator != Separator::Space || line.contains('"') {
        return fields;
    }
    let place = |field: &str| field.as_ptr() as usize - line.as_ptr() as usize;
    let mut joined: Vec<&str> = Vec::new();
    for field in fields {
        match joined.last_mut() {
            Some(last) if field.starts_with(['(', '[']) => {
                let (from, to) = (place(last), place(field) + field.len());
                *last = line.get(from..to).unwrap_or(last);
            }
            _ => joined.push(field),
        }
    }
    joined
}

/// Whether these are heads of a table so wide: words, of about as many columns.
fn is_head(fields: &[&str], separator: Separator, width: usize) -> bool {
    let slack = match separator {
        // Prose consists of words too.
        Separator::Space => 0,
        _ => 1,
    };
    let has_letters = |field: &&str| field.contains(char::is_alphabetic);
    fields.len() >= 2 && fields.len().abs_diff(width) <= slack && fields.iter().any(has_letters)
}

/// Whether every field is a unit, a dash or empty, and one at least is a unit.
fn is_line_of_units(fields: &[&str]) -> bool {
    let is_unit = |field: &&str| kind(bare(field)) != HeaderUnit::None;
    let is_none = |field: &&str| matches!(bare(field), "" | "-" | "#" | "1");
    fields.iter().any(&is_unit) && fields.iter().all(|f| is_unit(f) || is_none(f))
}

/// A unit without the brackets around it.
fn bare(unit: &str) -> &str {
    let open = unit.trim().trim_start_matches(['(', '[']);
    open.trim_end_matches([')', ']']).trim()
}

/// One kind of white space and of micro sign.
fn tidied(text: &str) -> String {
    let words: Vec<_> = text.split_whitespace().collect();
    words.join(" ").replace('\u{3bc}', "µ")
}

/// The ways of cutting a head into a name and a unit.
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
        behind('/'),
        behind(','),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn kind(unit: &str) -> HeaderUnit {
    if ELECTRICAL.contains(&unit) {
        return HeaderUnit::Electrical;
    }
    quantity::dimension_of(&format!("1 {unit}")).map_or(HeaderUnit::None, HeaderUnit::Of)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_stands_in_brackets_or_behind_a_slash_or_a_comma() {
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
        assert_eq!(HeaderField::new("Load (\u{3bc}N)").unit_text, "µN");
        assert_eq!(HeaderField::new("Depth (V)").unit, HeaderUnit::Electrical);
        assert_eq!(HeaderField::new("Load (raw)").name, "Load (raw)");
    }

    #[test]
    fn units_may_stand_in_a_line_of_their_own() {
        let lines = ["Agilent", "Depth\tLoad\tTest", "nm\t[mN]\t", ""];
        let heads = above(&lines, Separator::Tab, 3);
        let units: Vec<_> = heads.iter().map(|head| head.unit_text.as_str()).collect();
        assert_eq!(
            (units, heads[1].name.as_str()),
            (vec!["nm", "mN", ""], "Load")
        );
    }

    #[test]
    fn prose_is_no_head_and_a_comment_may_be() {
        assert!(above(&["This is a tip."], Separator::Space, 3).is_empty());
        assert!(above(&["Measured by hand"], Separator::Tab, 3).is_empty());
        let heads = above(&["# Depth (nm)  Load (mN)"], Separator::Space, 2);
        assert_eq!(heads[1].text, "Load (mN)");
    }
}
