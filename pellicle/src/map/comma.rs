//! The meaning of commas in a text of heights: separators, decimal marks, or marks of thousands in its head.

use super::error::MapError;
use super::text::{is_missing, rows};

/// With fewer lines than this, two columns of integers are a small map.
const MIN_COLUMN_LINES: usize = 3;

/// The meaning of a comma in a text.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Comma {
    Separator,
    DecimalMark,
}

impl Comma {
    /// Determines the separator, which is the same on all lines: a comma, unless there are semicolons, or blanks
    /// without an adjacent comma.
    pub fn in_text(text: &str, head: usize) -> Self {
        let is_separated = |row: &str| {
            let mut words = row.split_whitespace();
            let mut before = words.next().unwrap_or(",");
            row.contains(';')
                || words.any(|word| {
                    let is_blank = !before.ends_with(',') && !word.starts_with(',');
                    before = word;
                    is_blank
                })
        };
        if rows(text).skip(head).any(|(_, row)| is_separated(row)) {
            Self::DecimalMark
        } else {
            Self::Separator
        }
    }

    /// Adds the numbers of a line.
    pub fn read(self, line: usize, row: &str, picture: &mut Vec<f64>) -> Result<(), MapError> {
        let row = row.trim_matches([' ', '\r']);
        let separator = match self {
            _ if row.contains(';') => ';',
            Self::Separator => ',',
            Self::DecimalMark => '\t',
        };
        if row.is_empty() {
            return Ok(());
        }
        let cells = row.strip_suffix(separator).unwrap_or(row).split(separator);
        for cell in cells {
            let mut words = cell.split_whitespace().peekable();
            if words.peek().is_none() {
                picture.push(f64::NAN);
            }
            for word in words {
                picture.push(number(line, word)?);
            }
        }
        Ok(())
    }
}

/// Returns the first line of a text whose commas may be decimal marks as well as separators: one number a line, or
/// pairs of integers of which a second one begins with a zero, as no integer does.
pub fn either(text: &str, head: usize) -> Option<String> {
    let is_integer = |text: &str| {
        let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
        !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
    };
    let is_either = |row: &str| {
        let parts = row.split_once(',');
        parts.is_some_and(|(whole, fraction)| {
            is_integer(whole) && is_integer(fraction) && !fraction.starts_with(['-', '+'])
        })
    };
    let lines = rows(text).skip(head);
    let lines: Vec<_> = lines.map(|(_, row)| row.trim()).collect();
    let mut lines = lines.into_iter().filter(|row| !row.is_empty()).peekable();
    let first = lines.peek()?.chars().take(40).collect();
    let count = lines.clone().count();
    let mut has_zero = false;
    let mut are_pairs = |row: &str| {
        let cells: Vec<_> = row.trim_end_matches(',').split(',').collect();
        let pairs = cells.chunks(2);
        cells.len().is_multiple_of(2)
            && pairs.into_iter().all(|pair| {
                has_zero |= pair[1].len() > 1 && pair[1].starts_with('0');
                is_either(&pair.join(","))
            })
    };
    let may_be_pairs = lines.clone().all(&mut are_pairs) && has_zero;
    (may_be_pairs || count >= MIN_COLUMN_LINES && lines.all(is_either)).then_some(first)
}

/// What a comma before three digits is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum ThreeDigits {
    /// A decimal mark, as in the heights.
    Decimal,
    /// A mark of thousands, as the heights have decimal points.
    Thousands,
    /// Either: the heights have neither.
    #[default]
    Unknown,
}

impl ThreeDigits {
    /// What the heights of a text show.
    pub fn beside(text: &str, head: usize) -> Self {
        let has = |mark: char| {
            rows(text).skip(head).any(|(_, row)| {
                let mut parts = row.split(mark);
                let digit = |c: char| c.is_ascii_digit();
                let before = parts.next().is_some_and(|part| part.ends_with(digit));
                before && parts.next().is_some_and(|part| part.starts_with(digit))
            })
        };
        let marks_decimals = Comma::in_text(text, head) == Comma::DecimalMark;
        match (has('.'), marks_decimals && has(',')) {
            (true, _) => Self::Thousands,
            (false, true) => Self::Decimal,
            (false, false) => Self::Unknown,
        }
    }

    /// A value with a point in place of a decimal comma, `10,00 µm`, and without one of thousands; none if it may be
    /// either.
    pub fn with_point(self, value: &str) -> Option<String> {
        let ends_in_digit = |text: &str| text.ends_with(|c: char| c.is_ascii_digit());
        let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
        let Some((whole, fraction)) = value.split_once(',') else {
            return Some(value.to_owned());
        };
        let has_others = value.contains('.') || fraction.contains(',');
        if !ends_in_digit(whole) || digits(fraction) == 0 || has_others {
            return Some(value.to_owned());
        }
        let may_be_thousands =
            digits(fraction) == 3 && digits(whole) == whole.len() && whole != "0";
        match self {
            Self::Thousands if may_be_thousands => Some(format!("{whole}{fraction}")),
            Self::Unknown if may_be_thousands => None,
            _ => Some(format!("{whole}.{fraction}")),
        }
    }
}

fn number(line: usize, word: &str) -> Result<f64, MapError> {
    if is_missing(word) {
        return Ok(f64::NAN);
    }
    let found = || word.chars().take(40).collect();
    let Some((whole, fraction)) = word.split_once(',') else {
        return word.parse().map_err(|_| MapError::NotANumber {
            line,
            found: found(),
        });
    };
    let is_decimal = !whole.is_empty() && !fraction.is_empty() && !word.contains('.');
    let parsed = format!("{whole}.{fraction}").parse().ok();
    parsed
        .filter(|_| is_decimal)
        .ok_or_else(|| MapError::Comma {
            line,
            found: found(),
        })
}
