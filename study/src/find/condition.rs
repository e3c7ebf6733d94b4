//! A condition on a number of the result: `max_pressure < 2 GPa`.

use std::sync::Arc;

use pellicle::display::DisplayUnit;
use pellicle::input::diagnosis::{Diagnosis, Fault};
use pellicle::input::span::{Source, Span};
use pellicle::input::units::Units;

use super::number::text_of;
use crate::result_column::ResultColumn;

const WANTED: &str = "a number of the result and its limit, such as \"max_pressure < 2 GPa\"";

/// How a number and its limit are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Comparison {
    /// `<`
    Below,
    /// `≤`
    AtMost,
    /// `>`
    Above,
    /// `≥`
    AtLeast,
}

impl Comparison {
    /// The comparison at the beginning of a text, and the rest.
    fn read(text: &str) -> Option<(Self, &str)> {
        let of = [
            ("<=", Self::AtMost),
            (">=", Self::AtLeast),
            ("≤", Self::AtMost),
            ("≥", Self::AtLeast),
            ("<", Self::Below),
            (">", Self::Above),
        ];
        of.into_iter()
            .find_map(|(sign, comparison)| Some((comparison, text.strip_prefix(sign)?)))
    }

    /// Whether it holds of small numbers.
    #[must_use]
    pub fn is_upper_limit(self) -> bool {
        matches!(self, Self::Below | Self::AtMost)
    }

    /// Whether a number at the limit counts as one below it: of an area that is to be above zero, one of zero.
    #[must_use]
    pub fn counts_limit_below(self) -> bool {
        matches!(self, Self::AtMost | Self::Above)
    }

    /// Its sign.
    #[must_use]
    pub fn sign(self) -> char {
        match self {
            Self::Below => '<',
            Self::AtMost => '≤',
            Self::Above => '>',
            Self::AtLeast => '≥',
        }
    }
}

/// A condition on a number of the result.
#[derive(Debug, Clone)]
pub struct Condition {
    /// The number.
    pub result: ResultColumn,
    /// How the number is compared with the limit.
    pub comparison: Comparison,
    /// The limit, in SI units or the case's own.
    pub limit: f64,
    /// The units of the case.
    pub units: Units,
}

impl Condition {
    /// Reads a condition on one of the numbers of a case.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if there is no such number, or its limit has another unit.
    pub fn read(text: &Arc<Source>, columns: &[String], units: Units) -> Result<Self, Diagnosis> {
        let whole = text.inner().as_str();
        let span = |part: &str| {
            let start = part.as_ptr() as usize - whole.as_ptr() as usize;
            Span::new(text, start..start + part.len())
        };
        let wrong = |part: &str, found: String, wanted: String| {
            Diagnosis::of_text(span(part), Fault::Wrong { found, wanted })
        };
        let compared = || {
            let place = whole.find(['<', '>', '≤', '≥'])?;
            let (comparison, limit) = Comparison::read(&whole[place..])?;
            Some((whole[..place].trim(), comparison, limit.trim()))
        };
        let Some((name, comparison, limit)) = compared() else {
            return Err(wrong(whole, format!("`{whole}`"), WANTED.into()));
        };
        let result = ResultColumn::named(name, columns).map_err(|(found, wanted)| {
            let diagnosis = wrong(name, found, wanted);
            match ResultColumn::closest(name, columns) {
                Some(known) => diagnosis.with_help(format!("did you mean `{known}`?")),
                None => diagnosis,
            }
        })?;
        let limit = text_of(limit, result.dimension(), units)
            .map_err(|wanted| wrong(limit, format!("`{limit}`"), wanted))?;
        Ok(Self {
            result,
            comparison,
            limit,
            units,
        })
    }

    /// Whether it holds for a number.
    #[must_use]
    pub fn holds(&self, number: f64) -> bool {
        match self.comparison {
            Comparison::Below => number < self.limit,
            Comparison::AtMost => number <= self.limit,
            Comparison::Above => number > self.limit,
            Comparison::AtLeast => number >= self.limit,
        }
    }

    /// Describes the condition: `max pressure < 2.0000 GPa`.
    #[must_use]
    pub fn words(&self) -> String {
        let limit = self.value_words(self.limit);
        format!("{} {} {limit}", self.result.name, self.comparison.sign())
    }

    /// Writes a value of the number, with its unit.
    #[must_use]
    pub fn value_words(&self, value: f64) -> String {
        let scale = DisplayUnit::of_dimension(value, self.result.dimension(), self.units);
        scale.with_unit(value).trim_end().to_owned()
    }
}
