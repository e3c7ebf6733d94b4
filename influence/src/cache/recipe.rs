//! How each kind of data is named, computed, written and read.

use pellicle_kernel::Foundation;

use super::encoding::Decoder;
use super::key::{Key, Kind};
use super::memory::{Memory, Shelf};
use crate::{CoefficientTable, InfluenceError, RadialTables};

/// Bytes that radial tables may take: twenty times the largest seen.
const LARGEST_TABLES: usize = 1 << 21;

/// Data that can be had in two ways: computed, or decoded.
pub(super) trait Recipe {
    type Product;

    fn key(&self) -> Key;

    /// Whether computing takes no longer than reading; `smallest` is the smallest grid for which it does.
    fn is_immediate(&self, smallest: usize) -> bool;

    /// Bound of the encoded length.
    fn largest_payload(&self) -> usize;

    fn compute(&self) -> Result<Self::Product, InfluenceError>;

    fn encode(product: &Self::Product) -> Vec<u8>;

    /// The data, or none if what is read is not in order.
    fn decode(&self, decoder: &mut Decoder<'_>) -> Option<Self::Product>;

    fn shelf(memory: &Memory) -> &Shelf<Self::Product>;
}

/// Radial tables of a foundation.
pub(super) struct TablesOf<'a>(pub &'a Foundation);

impl Recipe for TablesOf<'_> {
    type Product = RadialTables;

    fn key(&self) -> Key {
        Key::new(self.0, Kind::Tables)
    }

    fn is_immediate(&self, _smallest: usize) -> bool {
        !RadialTables::are_needed_for(self.0)
    }

    fn largest_payload(&self) -> usize {
        LARGEST_TABLES
    }

    fn compute(&self) -> Result<RadialTables, InfluenceError> {
        RadialTables::build(self.0)
    }

    fn encode(product: &RadialTables) -> Vec<u8> {
        product.encode()
    }

    fn decode(&self, decoder: &mut Decoder<'_>) -> Option<RadialTables> {
        RadialTables::decode(self.0, decoder)
    }

    fn shelf(memory: &Memory) -> &Shelf<RadialTables> {
        &memory.tables
    }
}

/// Coefficients of a grid.
pub(super) struct CoefficientsOf<'a> {
    tables: &'a RadialTables,
    element_side: f64,
    size: usize,
    payload: usize,
}

impl<'a> CoefficientsOf<'a> {
    /// Refuses a grid that has no table.
    pub(super) fn new(
        tables: &'a RadialTables,
        element_side: f64,
        size: usize,
    ) -> Result<Self, InfluenceError> {
        Ok(Self {
            tables,
            element_side,
            size,
            payload: CoefficientTable::encoded_length(element_side, size)?,
        })
    }
}

impl Recipe for CoefficientsOf<'_> {
    type Product = CoefficientTable;

    fn key(&self) -> Key {
        let (element_side, size) = (self.element_side, self.size);
        Key::new(
            self.tables.foundation(),
            Kind::Coefficients { element_side, size },
        )
    }

    fn is_immediate(&self, smallest: usize) -> bool {
        self.size < smallest
    }

    fn largest_payload(&self) -> usize {
        self.payload
    }

    fn compute(&self) -> Result<CoefficientTable, InfluenceError> {
        CoefficientTable::assemble(self.tables, self.element_side, self.size)
    }

    fn encode(product: &CoefficientTable) -> Vec<u8> {
        product.encode()
    }

    fn decode(&self, decoder: &mut Decoder<'_>) -> Option<CoefficientTable> {
        CoefficientTable::decode(self.element_side, self.size, decoder)
    }

    fn shelf(memory: &Memory) -> &Shelf<CoefficientTable> {
        &memory.coefficients
    }
}
