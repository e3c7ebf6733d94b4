//! The numbers of a contact, with what each independent source adds to their uncertainties.

use super::{IndentationError, IndentationNumber, Uncertain};

/// Number of all numbers.
const COUNT: usize = IndentationNumber::ALL.len();

/// The numbers, in the order of [`IndentationNumber::ALL`].
pub(super) type Values = [Option<f64>; COUNT];

/// The numbers of an indentation.
#[derive(Debug, Clone, PartialEq)]
pub struct IndentationNumbers {
    values: Values,
    /// What each independent source adds to each number.
    parts: Vec<[f64; COUNT]>,
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
        let parts = self.parts.iter();
        parts
            .map(|part| part[one.place()] * part[other.place()])
            .sum()
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
        numbers: &dyn Fn(f64) -> Result<Values, IndentationError>,
    ) -> Result<(), IndentationError> {
        let [above, below] = [numbers(1.0)?, numbers(-1.0)?];
        let part = |k: usize| match (above[k], below[k]) {
            (Some(above), Some(below)) => 0.5 * (above - below),
            _ => 0.0,
        };
        self.parts.push(std::array::from_fn(part));
        Ok(())
    }

    pub(super) fn add_source(
        &mut self,
        uncertain: Uncertain,
        numbers: &dyn Fn(f64) -> Result<Values, IndentationError>,
    ) -> Result<(), IndentationError> {
        if uncertain.sd > 0.0 {
            self.add(numbers)?;
        }
        Ok(())
    }
}
