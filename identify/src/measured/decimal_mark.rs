//! Numbers of a text: their decimal mark, and marks that group their digits by thousands.

/// The mark between the integer and the fractional part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DecimalMark {
    /// `0.5`.
    Point,
    /// `0,5`.
    Comma,
}

/// A number whose digits are grouped, as in `1,009.5`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GroupedNumber {
    pub(super) value: f64,
    /// Whether it can be nothing else: `1,009` may be a decimal fraction.
    pub(super) is_certain: bool,
}

impl DecimalMark {
    /// Parses the number of a field, which may be NaN or infinite; none if it is not a number, or if it is one only
    /// with the other mark.
    #[must_use]
    pub fn number(self, field: &str) -> Option<f64> {
        let plain = match self {
            Self::Point => field.parse().ok(),
            Self::Comma if field.contains('.') => None,
            Self::Comma => field.replacen(',', ".", 1).parse().ok(),
        };
        let grouped = || self.grouped(field).filter(|number| number.is_certain);
        plain.or_else(|| grouped().map(|number| number.value))
    }

    /// Parses a number whose digits before the decimal mark are in groups of three: `1,009.5`, `1'009`, `1 009 000`.
    pub(super) fn grouped(self, field: &str) -> Option<GroupedNumber> {
        let [own, other] = self.marks();
        let digits = field.trim_start_matches(['-', '+']);
        let (sign, digits) = field.split_at(field.len() - digits.len());
        let end = digits.find([own, 'e', 'E']).unwrap_or(digits.len());
        let (whole, rest) = digits.split_at(end);
        let mark = whole.chars().find(|c| !c.is_ascii_digit())?;
        let is_mark = mark == other
            || matches!(
                mark,
                '\'' | '\u{2019}' | ' ' | '\u{a0}' | '\u{2009}' | '\u{202f}'
            );
        let groups: Vec<&str> = whole.split(mark).collect();
        let (first, others) = groups.split_first()?;
        // No group of thousands begins a number with a zero: `0,523` is a fraction.
        let is_first = (1..=3).contains(&first.len()) && !first.starts_with('0');
        let is_digits = |group: &str| group.bytes().all(|byte| byte.is_ascii_digit());
        let is_grouped = is_first
            && is_digits(first)
            && others
                .iter()
                .all(|group| group.len() == 3 && is_digits(group));
        if !is_mark || !is_grouped {
            return None;
        }
        let rest = rest.replacen(own, ".", 1);
        let value = format!("{sign}{}{rest}", groups.concat()).parse().ok()?;
        let is_certain = mark != other || rest.starts_with('.') || others.len() > 1;
        Some(GroupedNumber { value, is_certain })
    }

    /// Whether a field is a number with this mark, which shows that the other one groups digits.
    pub(super) fn is_in(self, field: &str) -> bool {
        let [own, _] = self.marks();
        field.contains(own) && self.number(field).is_some()
    }

    /// This mark and the other one.
    fn marks(self) -> [char; 2] {
        match self {
            Self::Point => ['.', ','],
            Self::Comma => [',', '.'],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn with_decimal_commas_a_point_is_not_part_of_a_number() {
        assert_eq!(DecimalMark::Comma.number("-1,25e-3"), Some(-1.25e-3));
        assert_eq!(DecimalMark::Comma.number("1.25"), None);
        assert_eq!(DecimalMark::Point.number("1,25"), None);
        assert!(DecimalMark::Point.number("NaN").is_some_and(f64::is_nan));
    }

    #[test]
    fn digits_may_be_grouped_by_thousands() {
        let point = [
            "1,009.5",
            "1'009.5",
            "1\u{2019}009.5",
            "1\u{a0}009.5",
            "1 009.5",
        ];
        for field in point {
            assert_eq!(DecimalMark::Point.number(field), Some(1009.5), "{field}");
        }
        for field in ["-1.234.567", "-1'234'567,0", "-1 234 567e0"] {
            assert_eq!(
                DecimalMark::Comma.number(field),
                Some(-1_234_567.0),
                "{field}"
            );
        }
        for (mark, field) in [(DecimalMark::Point, "1,009"), (DecimalMark::Comma, "1.009")] {
            assert_eq!(mark.number(field), None);
            let grouped = mark.grouped(field);
            let wanted = GroupedNumber {
                value: 1009.0,
                is_certain: false,
            };
            assert_eq!(grouped, Some(wanted));
        }
        for field in [
            "0,523.5",
            "1,09.5",
            "1,0095",
            "1,009,5",
            "1,009.5.1",
            "10:41",
            "1'009'5",
            "2019-04",
            "1234,567.0",
        ] {
            assert_eq!(DecimalMark::Point.grouped(field), None, "{field}");
        }
    }
}
