//! The lines above a table that may be its headers: names with units, a line of units, labelled lines.

use super::header::{HeaderField, HeaderUnit, bare, kind};
use super::separator::Separator;

/// Lines above the first row that are searched for headers with words between; the longest block of settings that an
/// instrument is known to write between both has a dozen.
const FARTHEST: usize = 20;
/// The last words of labels such as `# columns:` or `# fancyNames:`, before the names of columns in one line.
const NAMES: [&str; 4] = ["names", "columns", "channels", "fields"];
/// The same for the units of columns.
const UNITS: &str = "units";

/// The lines above a table that may hold its headers.
#[derive(Debug, Clone, Copy)]
pub struct LinesAbove<'a, 't> {
    /// The lines, nearest last.
    pub lines: &'a [&'t str],
    /// The separator of the table.
    pub separator: Separator,
    /// The number of its columns.
    pub width: usize,
    /// Whether the first of the lines was named by the user.
    pub is_named: bool,
}

impl LinesAbove<'_, '_> {
    /// Reads the headers; none if no line is one. These are tried: the line above the first row, if it states a unit or
    /// a quantity; the line that the user named; labelled lines; the nearest line of a few more that states one; the
    /// line above the first row.
    #[must_use]
    pub fn headers(&self) -> Vec<HeaderField> {
        let nearest = self.nearest();
        let ways: [&dyn Fn() -> Option<Vec<HeaderField>>; 5] = [
            &|| nearest.clone().filter(|heads| state_something(heads)),
            &|| self.is_named.then(|| self.whole(0)).flatten(),
            &|| self.labelled(),
            &|| self.farther(),
            &|| nearest.clone(),
        ];
        ways.iter().find_map(|way| way()).unwrap_or_default()
    }

    /// The line directly above the first row, and the line of units, if there is one.
    fn nearest(&self) -> Option<Vec<HeaderField>> {
        let mut lines = self.lines.iter().rev();
        let fields = next_fields(&mut lines, self.separator)?;
        if is_line_of_units(&fields) {
            let names = next_fields(&mut lines, self.separator).unwrap_or_default();
            if is_head(&names, self.separator, self.width) {
                return Some(with_units(&names, &fields));
            }
        }
        is_head(&fields, self.separator, self.width).then(|| with_units(&fields, &[]))
    }

    /// A line as headers, in the first way of splitting it that gives one for each column, with a line of units below
    /// it, if there is one.
    fn whole(&self, index: usize) -> Option<Vec<HeaderField>> {
        let line = bare_of_comment(self.lines.get(index)?);
        let units = self
            .lines
            .get(index + 1)
            .map(|line| self.separator.fields(line));
        let units = units
            .filter(|units| is_line_of_units(units))
            .unwrap_or_default();
        let fits = |fields: &Vec<&str>| {
            fields.len() == self.width && fields.iter().all(|field| is_word(field))
        };
        let fields = ways_of_splitting(line, self.separator).find(fits)?;
        Some(with_units(&fields, &units))
    }

    /// The names and units of labelled lines, `# columns: height force` and `# units: m N`.
    fn labelled(&self) -> Option<Vec<HeaderField>> {
        let labelled = |ends: &dyn Fn(&str) -> bool| {
            let mut lines = self.lines.iter().rev();
            lines.find_map(|line| {
                let (label, rest) = bare_of_comment(line).split_once(':')?;
                let label = label.trim().to_lowercase();
                let fields = Separator::Space.fields(rest);
                (ends(&label) && fields.len() == self.width).then_some(fields)
            })
        };
        let names = labelled(&|label| NAMES.iter().any(|name| label.ends_with(name)))?;
        let units = labelled(&|label| label.ends_with(UNITS)).unwrap_or_default();
        Some(with_units(&names, &units))
    }

    /// The nearest line with a word for each column, of which one states a unit or a quantity. The rows of another
    /// table end the search.
    fn farther(&self) -> Option<Vec<HeaderField>> {
        let is_row = |line: &str| {
            let fields = self.separator.fields(line);
            fields.iter().filter(|field| is_number(field)).count() > 1
        };
        let indices = (0..self.lines.len()).rev().take(FARTHEST);
        let mut near = indices.take_while(|index| !is_row(self.lines[*index]));
        near.find_map(|index| self.whole(index).filter(|heads| state_something(heads)))
    }
}

/// Whether one of some headers states a unit or names a quantity.
fn state_something(heads: &[HeaderField]) -> bool {
    let is_stated = |head: &HeaderField| head.unit != HeaderUnit::None || head.is_quantity();
    heads.iter().any(is_stated)
}

/// Headers of these names, with the units of a line of their own.
fn with_units(names: &[&str], units: &[&str]) -> Vec<HeaderField> {
    let units = units.iter().copied().chain(std::iter::repeat(""));
    let with_unit = |(name, unit): (&&str, &str)| HeaderField::new(name).with_unit(unit);
    names.iter().zip(units).map(with_unit).collect()
}

/// The fields of a line of names, split at the separator of the table, at others, and at two blanks or more.
fn ways_of_splitting(line: &str, separator: Separator) -> impl Iterator<Item = Vec<&str>> {
    let at = move |separator: Separator| {
        let mut fields = joined(separator.fields(line), line, separator);
        while fields.last() == Some(&"") {
            fields.pop();
        }
        fields
    };
    let wide = line.split("  ").map(str::trim);
    let wide: Vec<&str> = wide.filter(|field| !field.is_empty()).collect();
    let separators = [
        separator,
        Separator::Tab,
        Separator::Semicolon,
        Separator::Comma,
    ];
    separators.into_iter().map(at).chain([wide])
}

/// Whether a field is a number, with either decimal mark.
fn is_number(field: &str) -> bool {
    field.replacen(',', ".", 1).parse::<f64>().is_ok()
}

/// Whether a field of a line of names is no number.
fn is_word(field: &str) -> bool {
    field.contains(char::is_alphabetic) && !field.starts_with(|c: char| c.is_ascii_digit())
}

fn bare_of_comment(line: &str) -> &str {
    line.trim_start_matches(['#', '%']).trim()
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

/// Whether these are headers of a table of `width` columns: words, about as many as columns, and no number, as in a
/// setting.
fn is_head(fields: &[&str], separator: Separator, width: usize) -> bool {
    let slack = match separator {
        // A line of prose consists of words too.
        Separator::Space => 0,
        _ => 1,
    };
    let has_letters = |field: &&str| field.contains(char::is_alphabetic);
    fields.len() >= 2
        && fields.len().abs_diff(width) <= slack
        && fields.iter().any(has_letters)
        && !fields.iter().any(|field| is_number(field))
}

/// Whether every field is a unit, a placeholder or empty, and at least one is a unit.
fn is_line_of_units(fields: &[&str]) -> bool {
    let is_unit = |field: &&str| kind(bare(field)) != HeaderUnit::None;
    let is_none = |field: &&str| matches!(bare(field), "" | "-" | "#" | "1");
    fields.iter().any(&is_unit) && fields.iter().all(|f| is_unit(f) || is_none(f))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn above(lines: &[&str], separator: Separator, width: usize) -> Vec<HeaderField> {
        let is_named = false;
        LinesAbove {
            lines,
            separator,
            width,
            is_named,
        }
        .headers()
    }

    fn names(heads: &[HeaderField]) -> Vec<&str> {
        heads.iter().map(|head| head.name.as_str()).collect()
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

    #[test]
    fn headers_may_stand_a_few_lines_above_with_words_between() {
        let lines = ["Points = 40", "Depth (nm)\tLoad (uN)\tTime (s)", "eoh"];
        let heads = above(&lines, Separator::Tab, 3);
        assert_eq!(names(&heads), ["Depth", "Load", "Time"]);
        assert_eq!(heads[1].unit_text, "uN");
        // Split otherwise than the table.
        let lines = ["Load On Sample (mN)   Depth of Tip (nm)", "", "begin", ""];
        assert_eq!(
            names(&above(&lines, Separator::Space, 2)),
            ["Load On Sample", "Depth of Tip"]
        );
        let lines = ["Depth;Load", "---"];
        assert_eq!(names(&above(&lines, Separator::Tab, 2)), ["Depth", "Load"]);
        // Settings are no headers, nor is prose.
        for lines in [
            ["Operator\tSmith", "eoh"],
            ["Rate (Hz)\t100", "eoh"],
            ["k (N/m)\t0.2", ""],
        ] {
            assert!(above(&lines, Separator::Tab, 2).is_empty(), "{lines:?}");
        }
    }

    #[test]
    fn a_line_that_the_user_names_needs_no_unit() {
        let lines = ["U1\tU2", "eoh"];
        assert!(above(&lines, Separator::Tab, 2).is_empty());
        let (separator, is_named, width) = (Separator::Tab, true, 2);
        let lines = LinesAbove {
            lines: &lines,
            separator,
            width,
            is_named,
        };
        assert_eq!(names(&lines.headers()), ["U1", "U2"]);
    }

    #[test]
    fn the_nearest_line_counts_only_if_none_states_more() {
        // Origin: long names, units, comments.
        let lines = ["Depth\tLoad", "nm\tmN", "Sample A\tSample A"];
        let heads = above(&lines, Separator::Tab, 2);
        assert_eq!(
            (names(&heads), &*heads[0].unit_text),
            (vec!["Depth", "Load"], "nm")
        );
        // The names of another table do not count.
        let lines = ["Depth (nm)\tLoad (mN)", "1\t2", "a\tb"];
        assert_eq!(names(&above(&lines, Separator::Tab, 2)), ["a", "b"]);
    }

    #[test]
    fn labelled_lines_give_names_and_units() {
        let lines = [
            "# segment: extend",
            "# columns: height vDeflection time",
            "# fancyNames: \"Height (measured)\" \"Vertical Deflection\" \"Series Time\"",
            "# springConstant: 0.06",
            "# calibrationSlots: nominal force elapsed",
            "# units: m N s",
            "#",
        ];
        let heads = above(&lines, Separator::Space, 3);
        assert_eq!(
            names(&heads),
            ["Height (measured)", "Vertical Deflection", "Series Time"]
        );
        let units: Vec<_> = heads.iter().map(|head| head.unit_text.as_str()).collect();
        assert_eq!(units, ["m", "N", "s"]);
    }
}
