//! The elasticity of a surface of square elements, which provides operators and symbols for any part of a grid.

use std::sync::Arc;

use crate::bodies::ElasticBodies;
use crate::coefficient_table::CoefficientTable;
use crate::filter::PeriodicSymbol;
use crate::operator::{ConvolutionOperator, PeriodicOperator, ScatteredOperator, WindowOperator};
use crate::sector::SectorGrid;
use crate::transform::half_length;

/// The influence coefficients of elements of one size, and the operators of square windows of a grid.
///
/// The coefficients depend only on the offset, so one table serves every window: [`Self::operator`] makes `K p` for a
/// window of any size up to the table's, at that window's cost.
///
/// ```
/// use std::sync::Arc;
/// use pellicle_influence::{CoefficientTable, ElasticOperator, SurfaceElasticity, love};
/// use pellicle_kernel::{Foundation, Material};
///
/// let steel = Material::new(210e9, 0.3)?;
/// let table = CoefficientTable::from_fn(1e-6, 64, |offset| love::coefficient(&steel, 1e-6, offset))?;
/// let surface = SurfaceElasticity::new(Arc::new(table), Foundation::half_space(steel));
/// let mut displacement = vec![0.0; 16 * 16];
/// surface.operator(16).apply_into(&[1e9; 16 * 16], &mut displacement);
/// assert!(displacement[8 * 16 + 8] > displacement[0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct SurfaceElasticity {
    table: Arc<CoefficientTable>,
    /// The smallest coefficient at or beyond each offset.
    least_from: Arc<[f64]>,
    bodies: ElasticBodies,
}

impl SurfaceElasticity {
    /// The elasticity of the bodies, or of a foundation alone, whose coefficients are in `table`.
    #[must_use]
    pub fn new(table: Arc<CoefficientTable>, bodies: impl Into<ElasticBodies>) -> Self {
        let least_from = table.least_from().into();
        Self {
            table,
            least_from,
            bodies: bodies.into(),
        }
    }

    /// The smallest coefficient (m/Pa) of elements at least `offset` away along one axis or the other; +∞ beyond the
    /// table. See [`CoefficientTable::least_from`].
    #[must_use]
    pub fn least_coefficient_from(&self, offset: usize) -> f64 {
        let least = self.least_from.get(offset);
        least.copied().unwrap_or(f64::INFINITY)
    }

    /// Elements per side of the largest window.
    #[must_use]
    pub fn size(&self) -> usize {
        self.table.size()
    }

    /// The coefficient `k` of two elements `offset` apart, m/Pa.
    ///
    /// # Panics
    /// If an offset is not below [`Self::size`].
    #[must_use]
    #[inline]
    pub fn coefficient(&self, offset: [usize; 2]) -> f64 {
        self.table.coefficient(offset)
    }

    /// The sum (m/Pa) of the coefficients of one element and of another with its mirror images: `K` of a sector.
    ///
    /// # Panics
    /// As [`Self::coefficient`].
    #[must_use]
    pub fn coefficient_on(&self, grid: SectorGrid, from: [usize; 2], to: [usize; 2]) -> f64 {
        let offsets = grid.offsets(from, to);
        offsets.map(|offset| self.coefficient(offset)).sum()
    }

    /// The smallest size ≥ `size` whose products are fast: padding takes it to twice its length and no further.
    #[must_use]
    pub fn fast_size(size: usize) -> usize {
        half_length(size)
    }

    /// `K p` on a window of `size` × `size` elements.
    ///
    /// # Panics
    /// If `size` is above [`Self::size`].
    #[must_use]
    pub fn operator(&self, size: usize) -> ConvolutionOperator {
        self.operator_on(SectorGrid::whole(size))
    }

    /// `K p` on a window of the grid or a sector of one.
    ///
    /// # Panics
    /// As [`ConvolutionOperator::on`].
    #[must_use]
    pub fn operator_on(&self, grid: SectorGrid) -> ConvolutionOperator {
        ConvolutionOperator::on(&self.table, grid)
    }

    /// `C(k)` of the longest wave in a periodic cell of `size` elements along its longer side, m/Pa: the order of
    /// magnitude of the indentation by a pressure on the cell alone.
    #[must_use]
    pub fn cell_response(&self, size: usize) -> f64 {
        let side = size as f64 * self.table.element_side();
        self.bodies.compliance(std::f64::consts::TAU / side)
    }

    /// Displacement of a periodic cell per uniform pressure, m/Pa; see [`ElasticBodies::mean_compliance`].
    #[must_use]
    pub fn mean_compliance(&self) -> f64 {
        self.bodies.mean_compliance()
    }

    /// `K p` of a periodic cell of `lengths` elements along x and y.
    #[must_use]
    pub fn periodic_operator(&self, lengths: [usize; 2]) -> PeriodicOperator {
        PeriodicOperator::new(&self.bodies, self.table.element_side(), lengths)
    }

    /// `K p` on the `shown` elements for pressures on a window of `size` elements per row, the first of
    /// which is `origin`.
    ///
    /// # Panics
    /// As [`WindowOperator::new`].
    #[must_use]
    pub fn under_window(
        &self,
        shown: SectorGrid,
        origin: [usize; 2],
        size: usize,
    ) -> WindowOperator {
        WindowOperator::new(&self.table, shown, origin, size)
    }

    /// `K p` among some elements, given by ascending indices, of a window of `size` × `size`; `None` if the window
    /// is too small for a gain.
    ///
    /// # Panics
    /// As [`ScatteredOperator::new`].
    #[must_use]
    pub fn among(&self, size: usize, elements: &[u32]) -> Option<ScatteredOperator> {
        ScatteredOperator::new(&self.table, size, elements)
    }

    /// The analytic symbol on a periodic grid of `size` × `size` elements, for preconditioners.
    #[must_use]
    pub fn symbol(&self, size: usize) -> PeriodicSymbol {
        PeriodicSymbol::new(&self.bodies, self.table.element_side(), size)
    }

    /// The same for a periodic cell of `lengths` elements along x and y, quicker for many layers.
    #[must_use]
    pub fn cell_symbol(&self, lengths: [usize; 2]) -> PeriodicSymbol {
        PeriodicSymbol::of_cell(&self.bodies, self.table.element_side(), lengths)
    }
}
