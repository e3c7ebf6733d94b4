//! The header of a column: its name, and the unit that the file states for it.

use pellicle::input::dimension::Dimension;
use pellicle::input::quantity;

use super::separator::Separator;

/// Electrical units: a column in one of them needs a calibration.
const ELECTRICAL: [&str; 7] = ["V", "mV", "uV", "µV", "A", "mA", "nA"];

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
}

impl HeaderField {
    /// Parses a header: a name, and a unit in round or square brackets or after a slash or a comma.
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

    /// Adds the unit from a line of units.
    fn with_unit(mut self, unit: &str) -> Self {
        let unit = bare(unit);
        if self.unit == HeaderUnit::None && kind(unit) != HeaderUnit::None {
            self.unit = kind(unit);
            unit.clone_into(&mut self.unit_text);
        }
        self
    }
}

/// Reads the headers from the lines above the first row, nearest last; none if the lines are not headers of a table of
/// `width` columns.
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

/// The fields of the next line upwards, skipping at most one empty line.
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

/// Joins a unit in brackets to its name if blanks separate fields: `Depth (nm)` is one field.
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

/// Whether these are headers of a table of `width` columns: words, about as many as columns.
fn is_head(fields: &[&str], separator: Separator, width: usize) -> bool {
    let slack = match separator {
        // A line of prose consists of words too.
        Separator::Space => 0,
        _ => 1,
    };
    let has_letters = |field: &&str| field.contains(char::is_alphabetic);
    fields.len() >= 2 && fields.len().abs_diff(width) <= slack && fields.iter().any(has_letters)
}

/// Whether every field is a unit, a placeholder or empty, and at least one is a unit.
fn is_line_of_units(fields: &[&str]) -> bool {
    let is_unit = |field: &&str| kind(bare(field)) != HeaderUnit::None;
    let is_none = |field: &&str| matches!(bare(field), "" | "-" | "#" | "1");
    fields.iter().any(&is_unit) && fields.iter().all(|f| is_unit(f) || is_none(f))
}

/// Removes the brackets around a unit.
fn bare(unit: &str) -> &str {
    let open = unit.trim().trim_start_matches(['(', '[']);
    open.trim_end_matches([')', ']']).trim()
}

/// Normalises white space and the micro sign.
fn tidied(text: &str) -> String {
    let words: Vec<_> = text.split_whitespace().collect();
    words.join(" ").replace('\u{3bc}', "µ")
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
        assert_eq!(HeaderField::new("Load (\u{3bc}N)").unit_text, "µN");
        assert_eq!(HeaderField::new("Depth (V)").unit, HeaderUnit::Electrical);
        assert_eq!(HeaderField::new("Load (raw)").name, "Load (raw)");
    }

    #[test]
    fn units_may_have_a_line_of_their_own() {
        let lines = ["Agilent", "Depth\tLoad\tTest", "nm\t[mN]\t", ""];
        let heads = above(&lines, Separator::Tab, 3);
        let units: Vec<_> = heads.iter().map(|head| head.unit_text.as_str()).collect();
        assert_eq!(
            (units, heads[1].name.as_str()),
            (vec!["nm", "mN", ""], "Load")
        );
    }

    #[test]
    fn prose_is_not_a_header_but_a_comment_may_be() {
        assert!(above(&["This is a tip."], Separator::Space, 3).is_empty());
        assert!(above(&["Measured by hand"], Separator::Tab, 3).is_empty());
        let heads = above(&["# Depth (nm)  Load (mN)"], Separator::Space, 2);
        assert_eq!(heads[1].text, "Load (mN)");
    }
}
