//! The displacement of a whole grid by pressures on a part of it.

use crate::CoefficientTable;
use crate::convolution::{Convolution, Layout};
use crate::quadrant::QuadrantConvolution;

/// `u = K p` on a grid, or the quadrant of one, for pressures that vanish outside a square window of it.
///
/// The transforms are as long as the window and the grid together, not as twice the grid: under a window of half the side a product takes half the time
/// of [`crate::ConvolutionOperator`]'s, and agrees with it to rounding (test `under_a_window_the_grid_moves_as_under_the_whole_pressure`).
/// Uses the current rayon pool; the result does not depend on it, bit for bit.
pub struct SpreadOperator(Extent);

/// What the displacements are those of.
enum Extent {
    Grid(Convolution),
    Quadrant(QuadrantConvolution),
}

impl SpreadOperator {
    /// For a window of `size` × `size` elements, the first of which is the element `origin`, of a grid of `grid` × `grid`.
    ///
    /// # Panics
    /// If the window is empty or does not lie within the grid, or the grid is larger than the table's.
    #[must_use]
    pub fn new(table: &CoefficientTable, grid: usize, origin: [usize; 2], size: usize) -> Self {
        let lies_within = origin.iter().all(|first| first + size <= grid);
        assert!(
            size > 0 && lies_within && grid <= table.size(),
            "a window of {size} elements from {origin:?} within {grid}, these within {}",
            table.size()
        );
        let layout = Layout {
            loaded: size,
            shown: grid,
            before: origin,
        };
        Self(Extent::Grid(Convolution::new(table, layout)))
    }

    /// For pressures on the `size` × `size` elements next to the axis of a quadrant of `quadrant` × `quadrant`, as a
    /// [`QuadrantOperator`](crate::QuadrantOperator) has them: all mirrored in both axes.
    ///
    /// # Panics
    /// If the window is empty or larger than the quadrant, or the table does not reach across twice the quadrant.
    #[must_use]
    pub fn on_quadrant(table: &CoefficientTable, quadrant: usize, size: usize) -> Self {
        Self(Extent::Quadrant(QuadrantConvolution::new(
            table, size, quadrant,
        )))
    }

    /// Writes the displacements (m, positive into the body; those of the grid) of the pressures (Pa, compressive positive; those of the window), both
    /// row after row.
    ///
    /// # Panics
    /// If a field has not one value per element.
    pub fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        match &mut self.0 {
            Extent::Grid(convolution) => convolution.apply_into(pressure, displacement),
            Extent::Quadrant(convolution) => convolution.apply_into(pressure, displacement),
        }
    }
}

impl std::fmt::Debug for SpreadOperator {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let shown = match &self.0 {
            Extent::Grid(convolution) => convolution.shown(),
            Extent::Quadrant(convolution) => convolution.shown(),
        };
        formatter
            .debug_struct("SpreadOperator")
            .field("size", &shown)
            .finish_non_exhaustive()
    }
}
