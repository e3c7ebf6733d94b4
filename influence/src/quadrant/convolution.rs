//! The product `K p` on a quadrant, from the pressures next to the axis to the displacements of as much of it as is wanted.

use super::plane::EvenPlane;
use crate::coefficient_table::CoefficientTable;
use crate::padding::half_length;
use crate::spectrum::Spectrum;

/// Plans, spectrum and buffers for pressures on the first m × m elements of a quadrant and displacements of the first M × M.
///
/// Memory: 32 h² bytes for the spectrum, 16 h M for the half-transformed field, where 2h ≥ m + M; for each thread 900 h bytes of scratch.
pub(crate) struct QuadrantConvolution {
    plane: EvenPlane<f64>,
    spectrum: Spectrum,
}

impl QuadrantConvolution {
    /// The convolution with the coefficients of `table`, which must reach across twice `shown` elements.
    pub(crate) fn new(table: &CoefficientTable, loaded: usize, shown: usize) -> Self {
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

    /// Displacements along a side, M.
    pub(crate) fn shown(&self) -> usize {
        self.plane.shown()
    }

    /// Writes the M² displacements of the m² pressures.
    ///
    /// # Panics
    /// If a field has another length.
    pub(crate) fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
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
