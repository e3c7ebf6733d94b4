//! The product `K p` on a quadrant.

use super::plane::EvenPlane;
use crate::coefficient_table::CoefficientTable;
use crate::operator::ElasticOperator;
use crate::padding::half_length;
use crate::spectrum::Spectrum;

/// `u = K p` for a pressure that is its own mirror image in both axes: on the quadrant x, y > 0, element (0, 0) of which lies at the axis.
///
/// What the quadrant's element (i, j) presses with, its three mirror images press with too; its displacement is that of all four. Of a grid of 2M × 2M elements
/// the quadrant has M × M, and those with pressure are the m × m next to the axis.
///
/// Memory: 32 h² bytes for the spectrum, 16 h M for the half-transformed field, where 2h ≥ m + M; for each thread 900 h bytes of scratch.
/// Accuracy: rounding, as [`crate::ConvolutionOperator`], with which it agrees on the whole grid (test
/// `a_quadrant_moves_as_the_whole_surface_does`). Uses the current rayon pool; the result does not depend on it, bit for bit.
pub struct QuadrantOperator {
    plane: EvenPlane<f64>,
    spectrum: Spectrum,
}

impl QuadrantOperator {
    /// For pressures on the first `loaded` × `loaded` elements of a quadrant, displacements of the first `shown` × `shown`.
    ///
    /// # Panics
    /// If `loaded` is 0 or above `shown`, or the table does not reach across twice `shown` elements.
    #[must_use]
    pub fn new(table: &CoefficientTable, loaded: usize, shown: usize) -> Self {
        assert!(
            (1..=shown).contains(&loaded) && 2 * shown <= table.size(),
            "pressures on {loaded} elements of {shown}, these on a quadrant of {}",
            table.size()
        );
        let length = half_length((loaded + shown).div_ceil(2));
        Self {
            plane: EvenPlane::padded(loaded, shown, length),
            // From one end of the pressures to the other of the displacements no offset is larger than m + M − 1.
            spectrum: Spectrum::new(table, loaded + shown, 2 * length),
        }
    }
}

impl ElasticOperator for QuadrantOperator {
    /// Displacements along a side, M; there may be fewer pressures.
    fn size(&self) -> usize {
        self.plane.shown()
    }

    /// Writes the M² displacements (m) of the m² pressures (Pa).
    ///
    /// # Panics
    /// If a field has another length.
    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.plane.load(pressure, 1.0);
        let length = self.plane.length();
        self.plane.multiply(|column| {
            // Even frequencies of the padded field before odd ones.
            let frequency = if column < length {
                2 * column
            } else {
                2 * (column - length) + 1
            };
            let (even, odd) = self.spectrum.column(frequency);
            [&even[..length], odd]
        });
        self.plane.restore(displacement, 1.0);
    }
}

impl std::fmt::Debug for QuadrantOperator {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("QuadrantOperator")
            .field("loaded", &self.plane.loaded())
            .field("shown", &self.plane.shown())
            .finish_non_exhaustive()
    }
}
