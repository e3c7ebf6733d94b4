//! The product `K p` as a solver sees it, and its forms: by convolution on the whole grid, on a half or a
//! quadrant of it, on a periodic cell, among scattered elements, or summed directly.

mod convolution;
mod dense;
mod periodic;
mod scattered;
mod spectrum;

pub use convolution::{ConvolutionOperator, WindowOperator};
pub use dense::DenseOperator;
pub(crate) use periodic::ComplianceTable;
pub use periodic::PeriodicOperator;
pub use scattered::{ScatteredOperator, scattered_work};
pub(crate) use spectrum::{QuarterTransform, Spectrum};

/// The linear map `u = K p` from the pressures to the displacements of the N × N square elements of a grid.
///
/// Fields have N² entries; entry `i N + j` belongs to the element i along x and j along y. Pressure is in Pa, positive
/// in compression; displacement in m, positive into the body.
///
/// ```
/// use pellicle_influence::ElasticOperator;
///
/// /// Independent springs of one compliance, m/Pa.
/// struct Springs { size: usize, compliance: f64 }
///
/// impl ElasticOperator for Springs {
///     fn size(&self) -> usize { self.size }
///     fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
///         for (u, p) in displacement.iter_mut().zip(pressure) {
///             *u = self.compliance * p;
///         }
///     }
/// }
///
/// let mut u = [0.0; 4];
/// Springs { size: 2, compliance: 0.5 }.apply_into(&[2.0; 4], &mut u);
/// assert_eq!(u, [1.0; 4]); // exact in binary
/// ```
pub trait ElasticOperator: Send {
    /// Number of elements N per row, along one side of the grid.
    fn size(&self) -> usize;

    /// Writes `u = K p`; both fields have N² entries.
    ///
    /// # Panics
    ///
    /// An implementation may panic if a field does not have N² entries.
    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]);
}
