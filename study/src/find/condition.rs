//! A condition on a number of the result: `max_pressure < 2 GPa`.

use std::sync::Arc;

use pellicle::display::DisplayUnit;
use pellicle::input::diagnosis::{Diagnosis, Fault};
use pellicle::input::span::{Source, Span};
use pellicle::input::units::Units;

use super::number::text_of;
use crate::result_column::ResultColumn;

const WANTED: &str = "a number of the result and its limit, such as \"max_pressure < 2 GPa\"";

/// The side of the limit on which the condition holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Below the limit.
    Below,
    /// Above the limit.
    Above,
}

/// A condition on a number of the result.
#[derive(Debug, Clone)]
pub struct Condition {
    /// The number.
    pub result: ResultColumn,
    /// The side of the limit on which it holds.
    pub side: Side,
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
        let Some((place, sign)) = whole.char_indices().find(|(_, c)| "<>≤≥".contains(*c))
        else {
            return Err(wrong(whole, format!("`{whole}`"), WANTED.into()));
        };
        let (name, rest) = (&whole[..place], &whole[place + sign.len_utf8()..]);
        let limit = rest.strip_prefix('=').unwrap_or(rest).trim();
        let name = name.trim();
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
            side: if "<≤".contains(sign) {
                Side::Below
            } else {
                Side::Above
            },
            limit,
            units,
        })
    }

    /// The sign between number and limit.
    #[must_use]
    pub fn sign(&self) -> char {
        match self.side {
            Side::Below => '<',
            Side::Above => '>',
        }
    }

    /// Describes the condition: `max pressure < 2.0000 GPa`.
    #[must_use]
    pub fn words(&self) -> String {
        let limit = self.value_words(self.limit);
        format!("{} {} {limit}", self.result.name, self.sign())
    }

    /// Writes a value of the number, with its unit.
    #[must_use]
    pub fn value_words(&self, value: f64) -> String {
        let scale = DisplayUnit::of_dimension(value, self.result.dimension(), self.units);
        scale.with_unit(value).trim_end().to_owned()
    }
}
