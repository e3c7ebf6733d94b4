//! A table of coefficients as the cache keeps it: the distinct ones, without the grid, which belongs to the key.

use super::{CoefficientTable, check};
use crate::cache::encoding::{Decoder, Encoder, WIDTH};
use crate::error::InfluenceError;

impl CoefficientTable {
    /// Length of the encoded table of a grid.
    ///
    /// # Errors
    ///
    /// As [`CoefficientTable::from_fn`] for a side or a size that no table has.
    pub(crate) fn encoded_length(element_side: f64, size: usize) -> Result<usize, InfluenceError> {
        check(element_side, size)?;
        Ok(WIDTH * (size * (size + 1) / 2))
    }

    /// The coefficients as bytes.
    pub(crate) fn encode(&self) -> Vec<u8> {
        let mut encoder = Encoder::default();
        encoder.reals(&self.triangle);
        encoder.into_bytes()
    }

    /// The table of this grid, or none if what is read is not in order.
    pub(crate) fn decode(
        element_side: f64,
        size: usize,
        decoder: &mut Decoder<'_>,
    ) -> Option<Self> {
        let triangle = decoder.reals(size * (size + 1) / 2)?;
        decoder.finish(Self {
            element_side,
            size,
            triangle,
        })
    }
}
