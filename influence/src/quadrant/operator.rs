//! The product `K p` on a quadrant, as a solver sees it.

use super::convolution::QuadrantConvolution;
use crate::coefficient_table::CoefficientTable;
use crate::operator::ElasticOperator;

/// `u = K p` for a pressure that is its own mirror image in both axes: on the quadrant x, y > 0, element (0, 0) of which lies at the axis.
///
/// What the quadrant's element (i, j) presses with, its three mirror images press with too; its displacement is that of all four. M × M elements stand for
/// 2M × 2M.
///
/// Memory: 32 bytes an element for the spectrum, 16 for the half-transformed field, and for each thread 900 M bytes of scratch.
/// Accuracy: rounding, as [`crate::ConvolutionOperator`], with which it agrees on the whole grid (test
/// `a_quadrant_moves_as_the_whole_surface_does`). Uses the current rayon pool; the result does not depend on it, bit for bit.
pub struct QuadrantOperator(QuadrantConvolution);

impl QuadrantOperator {
    /// For `size` × `size` elements of a quadrant.
    ///
    /// # Panics
    /// If `size` is 0, or the table does not reach across twice as many elements.
    #[must_use]
    pub fn new(table: &CoefficientTable, size: usize) -> Self {
        Self(QuadrantConvolution::new(table, size, size))
    }
}

impl ElasticOperator for QuadrantOperator {
    fn size(&self) -> usize {
        self.0.shown()
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.0.apply_into(pressure, displacement);
    }
}

impl std::fmt::Debug for QuadrantOperator {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("QuadrantOperator")
            .field("size", &self.0.shown())
            .finish_non_exhaustive()
    }
}
