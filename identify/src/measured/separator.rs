//! Lines split into fields at a separator.

use super::decimal_mark::{DecimalMark, GroupedNumber};

/// The separator between the fields of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Separator {
    /// One tab.
    Tab,
    /// One semicolon.
    Semicolon,
    /// One comma.
    Comma,
    /// Any number of blanks and tabs.
    Space,
}

impl Separator {
    /// All separators; if several fit equally well, the first is taken.
    pub const ALL: [Self; 4] = [Self::Tab, Self::Semicolon, Self::Comma, Self::Space];

    /// Splits a line into fields, without the blanks and quotation marks around them; separators between quotation
    /// marks are ignored.
    #[must_use]
    pub fn fields(self, line: &str) -> Vec<&str> {
        if line.contains('"') {
            return self.quoted_fields(line);
        }
        match self {
            Self::Tab => line.split('\t').map(str::trim).collect(),
            Self::Semicolon => line.split(';').map(str::trim).collect(),
            Self::Comma => line.split(',').map(str::trim).collect(),
            Self::Space => line.split_whitespace().collect(),
        }
    }

    fn quoted_fields(self, line: &str) -> Vec<&str> {
        let mut is_quoted = false;
        let fields = line.split(|c: char| {
            is_quoted ^= c == '"';
            !is_quoted && self.is(c)
        });
        let fields = fields.map(|field| field.trim().trim_matches('"').trim());
        match self {
            Self::Space => fields.filter(|field| !field.is_empty()).collect(),
            _ => fields.collect(),
        }
    }

    /// The number that two neighbouring fields make if this separator groups the digits of one, as in `1,009.5`.
    pub(super) fn joined(
        self,
        [left, right]: [&str; 2],
        decimal: DecimalMark,
    ) -> Option<GroupedNumber> {
        let mark = match self {
            Self::Comma => ',',
            Self::Space => ' ',
            Self::Tab | Self::Semicolon => return None,
        };
        decimal.grouped(&format!("{left}{mark}{right}"))
    }

    fn is(self, c: char) -> bool {
        match self {
            Self::Tab => c == '\t',
            Self::Semicolon => c == ';',
            Self::Comma => c == ',',
            Self::Space => c.is_whitespace(),
        }
    }

    /// Number of lines examined to find the separator, spread evenly over the whole file.
    const SAMPLE: usize = 2000;

    /// Finds the separator with which the most lines are rows of numbers, and the number of these lines; none if there
    /// are none.
    #[must_use]
    pub fn of(lines: &[&str], decimal: DecimalMark) -> Option<(Self, usize)> {
        let step = lines.len().div_ceil(Self::SAMPLE).max(1);
        let rows = |separator: Self| {
            let sample = lines.iter().step_by(step);
            sample
                .filter(|line| separator.is_clean_row(line, decimal))
                .count()
        };
        // Between quotation marks a comma is no separator.
        let quoted = || lines.iter().any(|line| line.contains("\",\""));
        let usable = |separator: &Self| {
            *separator != Self::Comma || decimal == DecimalMark::Point || quoted()
        };
        let counts = Self::ALL.into_iter().filter(usable);
        let mut best = None;
        for (separator, count) in counts.map(|separator| (separator, rows(separator))) {
            if count > best.map_or(0, |(_, most)| most) {
                best = Some((separator, count));
            }
        }
        best
    }

    /// Whether every field of a line is a number, a word or empty, and at least two are numbers.
    fn is_clean_row(self, line: &str, decimal: DecimalMark) -> bool {
        let mut numbers = 0;
        for field in self.fields(line) {
            if decimal.number(field).is_some() {
                numbers += 1;
            } else if field.starts_with(|c: char| c.is_ascii_digit() || ",.+".contains(c))
                && !is_time(field)
            {
                return false;
            }
        }
        numbers >= 2
    }
}

/// Whether a field is a time of day, a date or both: `10:41:06.5`, `10:41 AM`, `12.03.2018`, `2019-04-29T10:41:06`.
fn is_time(field: &str) -> bool {
    let is_part = |c: char| c.is_ascii_digit() || ":.-/TZ APMapm".contains(c);
    field.contains(':') && field.chars().all(is_part) || is_date(field)
}

/// Whether a field is a date of three numbers, the middle one of which has at most two digits, unlike thousands.
fn is_date(field: &str) -> bool {
    let is_number = |part: &str| part.bytes().all(|c| c.is_ascii_digit());
    ['.', '/', '-'].into_iter().any(|mark| {
        let parts: Vec<&str> = field.split(mark).collect();
        let lengths = [1..=4, 1..=2, 1..=4];
        parts.len() == lengths.len()
            && parts
                .iter()
                .zip(lengths)
                .all(|(part, length)| is_number(part) && length.contains(&part.len()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotation_marks_hide_a_separator() {
        let fields = Separator::Comma.fields("\"Depth, nm\" , 3,,\"4\"");
        assert_eq!(fields, ["Depth, nm", "3", "", "4"]);
        assert_eq!(
            Separator::Space.fields(" \"a b\"  3\t4 "),
            ["a b", "3", "4"]
        );
    }

    #[test]
    fn the_separator_is_the_one_that_gives_numbers() {
        use DecimalMark::{Comma, Point};
        let of = |line, decimal| Some(Separator::of(&[line], decimal)?.0);
        assert_eq!(of("1.5,2.5,load", Point), Some(Separator::Comma));
        assert_eq!(of("1,5;2,5", Comma), Some(Separator::Semicolon));
        assert_eq!(of("1,5;2,5", Point), None);
        assert_eq!(of("1,5\t2,5", Comma), Some(Separator::Tab));
        assert_eq!(of("1,5\t2,5", Point), None);
        assert_eq!(of("\"1,5\",\"2,5\"", Comma), Some(Separator::Comma));
        assert_eq!(of("1,5,2,5", Comma), None);
        assert_eq!(of(" 1.5   -2e-3 ", Point), Some(Separator::Space));
        assert_eq!(of("1.0, 2.0", Point), Some(Separator::Comma));
        assert_eq!(of("Date: 3", Point), None);
        assert_eq!(of("10:41:06.5,1.0,2.0", Point), Some(Separator::Comma));
        for times in [
            "12.03.2018;10:22",
            "3/12/2018;10:22:07 AM",
            "2018-03-12 10:22;x",
            "12.03.18;12-3-2018",
        ] {
            let row = format!("{times};1.5;2.5");
            let found = Separator::of(&[&row], Point);
            assert_eq!(found, Some((Separator::Semicolon, 1)), "{times}");
        }
        assert_eq!(of("1.234.567;1.5;2.5", Point), None);
    }
}
