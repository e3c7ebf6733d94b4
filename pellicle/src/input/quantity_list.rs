//! Lists of quantities, written one by one or as a range.

use super::diagnosis::Diagnosis;
use super::dimension::{Dimension, Sign};
use super::spacing::{self, Spacing};
use super::table_reader::TableReader;
use super::value_reader::ValueReader;

/// The kind of quantity in a list, and the largest number of items.
#[derive(Debug, Clone, Copy)]
pub struct QuantityList {
    /// Dimension of the items.
    pub dimension: Dimension,
    /// Sign of the items.
    pub sign: Sign,
    /// The largest number of items; more is a mistake.
    pub most: usize,
}

impl QuantityList {
    /// Reads one value.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if it is not such a quantity.
    pub fn item(&self, field: &ValueReader<'_>) -> Result<f64, Diagnosis> {
        field.quantity(self.dimension, self.sign)
    }

    /// Reads the values of a list, or of a table of `from`, `to`, `count` and `spacing`.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first item, end or number of values that is wrong.
    pub fn read(&self, field: &ValueReader<'_>) -> Result<Vec<f64>, Diagnosis> {
        self.read_checked(field, |_, value| Ok(value))
    }

    /// Reads the values, with a check of each item or of the ends of a range.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first item, end or number of values that is wrong.
    pub fn read_checked(
        &self,
        field: &ValueReader<'_>,
        check: impl Fn(&ValueReader<'_>, f64) -> Result<f64, Diagnosis>,
    ) -> Result<Vec<f64>, Diagnosis> {
        if field.is_table() {
            return self.range(&field.clone().table()?, check);
        }
        let items = field.list("a list of values, or a table of from, to, count and spacing")?;
        if items.len() > self.most {
            return Err(field.wanted(format!("at most {} values", self.most)));
        }
        let checked = |item| check(item, self.item(item)?);
        items.iter().map(checked).collect()
    }

    fn range(
        &self,
        table: &TableReader<'_>,
        check: impl Fn(&ValueReader<'_>, f64) -> Result<f64, Diagnosis>,
    ) -> Result<Vec<f64>, Diagnosis> {
        table.only(&spacing::KEYS)?;
        let spacing = Spacing::read(table)?;
        let sign = match spacing {
            Spacing::Log => Sign::Positive,
            Spacing::Linear => self.sign,
        };
        let end = |key| {
            let field = table.required(key, &sign.wanted(self.dimension))?;
            check(&field, field.quantity(self.dimension, sign)?)
        };
        let count = table.required("count", "how many values, an integer")?;
        let count = count.count(2..=self.most, " values")?;
        Ok(spacing.between(end("from")?, end("to")?, count))
    }
}
