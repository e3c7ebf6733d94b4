//! Multiplication by a function of the symbol, on the quadrant of a periodic grid.

use super::plane::EvenPlane;

/// Multiplies the Fourier series of a field that is its own mirror image in both axes, of the period of 2M × 2M elements, of which the quadrant of M × M elements is given
/// and wanted; in single precision, as preconditioners need it.
pub struct QuadrantFilter {
    plane: EvenPlane<f32>,
    /// Frequency after frequency along one axis, of each all along the other.
    multipliers: Vec<f32>,
}

impl QuadrantFilter {
    /// For a quadrant of `size` × `size` elements; multiplies by 0 until it is told by what.
    #[must_use]
    pub fn new(size: usize) -> Self {
        Self {
            plane: EvenPlane::periodic(size),
            multipliers: vec![0.0; size * size],
        }
    }

    /// Elements along a side of the quadrant, M.
    #[must_use]
    pub fn size(&self) -> usize {
        self.plane.shown()
    }

    /// Takes `multiplier(i, j)` as the factor of the frequencies i and j along the axes, each 0 … M−1, from now on; it must be symmetric.
    pub fn multiply_by(&mut self, multiplier: impl Fn([usize; 2]) -> f32) {
        let size = self.size();
        // There and back the transforms multiply by (2M)².
        let scale = 0.25 / (size * size) as f32;
        for (index, factor) in self.multipliers.iter_mut().enumerate() {
            *factor = scale * multiplier([index / size, index % size]);
        }
    }

    /// `field ← F⁻¹ multiplier F field`, scaled by `scale` on the way in and by `scale_back` on the way out; M² values.
    ///
    /// # Panics
    /// If the field has not M² values.
    pub fn apply(&mut self, field: &mut [f64], scale: f64, scale_back: f64) {
        let size = self.size();
        self.plane.load(field, scale);
        self.plane
            .multiply(|column| [&self.multipliers[column * size..][..size], &[]]);
        self.plane.restore(field, scale_back);
    }
}

impl std::fmt::Debug for QuadrantFilter {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("QuadrantFilter")
            .field("size", &self.size())
            .finish_non_exhaustive()
    }
}
