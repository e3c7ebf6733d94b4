//! The numbers of a contact, with what each independent source adds to their uncertainties.

use super::{IndentationError, IndentationNumber, Uncertain};

/// Number of all numbers.
const COUNT: usize = IndentationNumber::ALL.len();

/// The numbers, in the order of [`IndentationNumber::ALL`].
pub(super) type Values = [Option<f64>; COUNT];

/// Where an uncertainty comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// The curve itself: its noise, its drift, its zero.
    Own,
    /// A number of the settings, which all curves share.
    Common(&'static str),
}

/// The numbers of an indentation.
#[derive(Debug, Clone, PartialEq)]
pub struct IndentationNumbers {
    values: Values,
    /// What each independent source adds to each number.
    parts: Vec<(Source, [f64; COUNT])>,
}

impl IndentationNumbers {
    /// A number with its standard uncertainty; none if there is no such number.
    #[must_use]
    pub fn get(&self, of: IndentationNumber) -> Option<Uncertain> {
        let value = self.values[of.place()]?;
        Some(Uncertain {
            value,
            sd: self.covariance(of, of).sqrt(),
        })
    }

    /// The covariance of two numbers.
    #[must_use]
    pub fn covariance(&self, one: IndentationNumber, other: IndentationNumber) -> f64 {
        self.products(one, other, |_| true)
    }

    /// The covariance of two numbers from their own curve alone.
    #[must_use]
    pub fn own_covariance(&self, one: IndentationNumber, other: IndentationNumber) -> f64 {
        self.products(one, other, |from| from == Source::Own)
    }

    /// The sum of the products of what the chosen sources add to two numbers. That of no terms is −0, of which a square
    /// root would keep the sign.
    fn products(
        &self,
        one: IndentationNumber,
        other: IndentationNumber,
        is_chosen: impl Fn(Source) -> bool,
    ) -> f64 {
        let chosen = self.parts.iter().filter(|(from, _)| is_chosen(*from));
        let products = chosen.map(|(_, part)| part[one.place()] * part[other.place()]);
        products.fold(0.0, |sum, product| sum + product)
    }

    /// What each source that all curves share adds to a number, with its name: one standard uncertainty of it.
    pub fn common_parts(&self, of: IndentationNumber) -> impl Iterator<Item = (&'static str, f64)> {
        let parts = self.parts.iter();
        parts.filter_map(move |(from, part)| match from {
            Source::Common(name) => Some((*name, part[of.place()])),
            Source::Own => None,
        })
    }

    /// Numbers without uncertainty.
    pub(super) fn exact(values: Values) -> Self {
        Self {
            values,
            parts: Vec::new(),
        }
    }

    /// Adds an independent source by the numbers one standard uncertainty to each of its sides.
    pub(super) fn add(
        &mut self,
        source: Source,
        numbers: &dyn Fn(f64) -> Result<Values, IndentationError>,
    ) -> Result<(), IndentationError> {
        let [above, below] = [numbers(1.0)?, numbers(-1.0)?];
        let part = |k: usize| match (above[k], below[k]) {
            (Some(above), Some(below)) => 0.5 * (above - below),
            _ => 0.0,
        };
        self.parts.push((source, std::array::from_fn(part)));
        Ok(())
    }

    pub(super) fn add_source(
        &mut self,
        source: Source,
        uncertain: Uncertain,
        numbers: &dyn Fn(f64) -> Result<Values, IndentationError>,
    ) -> Result<(), IndentationError> {
        if uncertain.sd > 0.0 {
            self.add(source, numbers)?;
        }
        Ok(())
    }
}
