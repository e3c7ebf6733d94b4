//! The product `K p` as a convolution: the transform of the pressure, times the spectrum of the coefficients, and back.

use super::ElasticOperator;
use super::spectrum::Spectrum;
use crate::coefficient_table::CoefficientTable;
use crate::sector::{Sector, SectorGrid};
use crate::transform::{EvenLines, FourierLines, HalfLines, Lines, PlaneTransform, half_length};

/// The map from a square of pressures to the square of displacements around it.
struct Convolution<L: Lines> {
    transform: PlaneTransform<L>,
    spectrum: Spectrum,
}

impl Convolution<FourierLines<f64>> {
    /// The convolution for `loaded` pressures along a side and `shown` displacements, of which `before`
    /// precede the first pressure.
    fn on_grid(table: &CoefficientTable, [loaded, shown]: [usize; 2], before: [usize; 2]) -> Self {
        let reach = before.map(|before| (before + loaded).max(shown - before));
        // No offset between a displacement and a pressure is larger, so none wraps onto another.
        let half = half_length(reach[0].max(reach[1]));
        Self {
            transform: PlaneTransform::new(FourierLines::padded(loaded, shown, before, half)),
            spectrum: Spectrum::new(table, shown.min(half + 1), half),
        }
    }
}

impl Convolution<EvenLines<f64>> {
    /// The convolution for `loaded` pressures from the axis and `shown` displacements of a quadrant.
    fn on_quadrant(table: &CoefficientTable, [loaded, shown]: [usize; 2]) -> Self {
        let length = half_length((loaded + shown).div_ceil(2));
        Self {
            transform: PlaneTransform::new(EvenLines::padded(loaded, shown, length)),
            // No offset between a pressure and a displacement exceeds loaded + shown − 1.
            spectrum: Spectrum::new(table, loaded + shown, 2 * length),
        }
    }
}

impl Convolution<HalfLines<f64>> {
    /// The convolution for pressures on a `loaded` half of a square and displacements on a `shown` one; the first
    /// pressure lies `above` rows below the first displacement.
    fn on_half(table: &CoefficientTable, [loaded, shown]: [SectorGrid; 2], above: usize) -> Self {
        let [pressures, displacements] = [loaded, shown].map(SectorGrid::lengths);
        // No offset exceeds this along x, and none exceeds loaded + shown along y.
        let reach = (above + pressures[0]).max(displacements[0] - above);
        let length = half_length(reach.max(loaded.size() + shown.size()).div_ceil(2));
        let half = 2 * length;
        let lines = HalfLines::padded(pressures, displacements, above, length);
        Self {
            transform: PlaneTransform::new(lines),
            spectrum: Spectrum::new(table, shown.whole_size().min(half + 1), half),
        }
    }
}

impl<L: Lines<Real = f64>> Convolution<L> {
    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.transform.load(pressure, 1.0);
        self.transform
            .multiply(|frequency| self.spectrum.column(frequency));
        self.transform.restore(displacement, 1.0);
    }
}

/// Omits the plans and buffers.
impl<L: Lines<Real = f64>> std::fmt::Debug for Convolution<L> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut shown = formatter.debug_struct("Convolution");
        shown
            .field("shown", &self.transform.lines().shown())
            .finish_non_exhaustive()
    }
}

/// The convolution on a whole grid or on a sector of it.
#[derive(Debug)]
enum SectorConvolution {
    Whole(Convolution<FourierLines<f64>>),
    Half(Convolution<HalfLines<f64>>),
    Quadrant(Convolution<EvenLines<f64>>),
}

impl SectorConvolution {
    /// The convolution for pressures on a window of `size` elements per row, the first of which is the element
    /// `origin`, and displacements of the `shown` elements.
    fn new(table: &CoefficientTable, shown: SectorGrid, origin: [usize; 2], size: usize) -> Self {
        let loaded = shown.with_size(size);
        let (window, all, mirrored) = (loaded.lengths(), shown.lengths(), shown.mirrored());
        let lies_within = (0..2).all(|axis| {
            let begins_at_axis = !mirrored[axis] || origin[axis] == 0;
            begins_at_axis && origin[axis] + window[axis] <= all[axis]
        });
        assert!(
            size > 0 && lies_within && shown.whole_size() <= table.size(),
            "a window of {size} elements from {origin:?} within {shown:?}, these within {}",
            table.size()
        );
        let lengths = [size, shown.size()];
        match shown.sector() {
            Sector::Whole => Self::Whole(Convolution::on_grid(table, lengths, origin)),
            Sector::Half => Self::Half(Convolution::on_half(table, [loaded, shown], origin[0])),
            Sector::Quadrant => Self::Quadrant(Convolution::on_quadrant(table, lengths)),
        }
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        match self {
            Self::Whole(convolution) => convolution.apply_into(pressure, displacement),
            Self::Half(convolution) => convolution.apply_into(pressure, displacement),
            Self::Quadrant(convolution) => convolution.apply_into(pressure, displacement),
        }
    }
}

/// `u = K p` on a grid in O(N² log N), by a real FFT that is zero-padded, not periodic.
///
/// On a [sector](SectorGrid) of a grid each element is loaded together with its mirror images, and its displacement is
/// due to all of them. Transforms are half as long along a mirrored axis, and real instead of complex: a product takes
/// half the time on a half, a quarter to a third of it on a quadrant. Both agree with the whole grid to rounding (tests
/// `a_half_is_displaced_like_the_whole_surface`, `a_quadrant_is_displaced_like_the_whole_surface`).
///
/// Memory: 8 bytes per element of the whole grid for the spectrum, 16 per element of the sector for the
/// half-transformed field, and 600 N bytes of scratch per thread, 900 N on a quadrant. Accuracy: rounding, some 1e-15
/// of the largest displacement; within 1e-13 of [`crate::DenseOperator`] (test `both_operators_agree_to_rounding`).
/// Uses the current rayon pool; the result has the same bits for every pool.
#[derive(Debug)]
pub struct ConvolutionOperator {
    grid: SectorGrid,
    convolution: SectorConvolution,
}

impl ConvolutionOperator {
    /// The operator of the grid for which the table was made.
    #[must_use]
    pub fn new(table: &CoefficientTable) -> Self {
        Self::on(table, SectorGrid::whole(table.size()))
    }

    /// The operator of a window of that grid, or of a sector of one; the coefficients depend only on the offset.
    ///
    /// # Panics
    /// If there are no elements, or the table does not span the whole grid.
    #[must_use]
    pub fn on(table: &CoefficientTable, grid: SectorGrid) -> Self {
        let convolution = SectorConvolution::new(table, grid, [0; 2], grid.size());
        Self { grid, convolution }
    }
}

impl ElasticOperator for ConvolutionOperator {
    fn size(&self) -> usize {
        self.grid.size()
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.convolution.apply_into(pressure, displacement);
    }
}

/// `u = K p` on a grid, or a sector of one, for pressures that vanish outside a square window of it.
///
/// The length of the transforms is that of the window and the grid together, not twice that of the grid: with a
/// window of half the side a product takes half the time of [`ConvolutionOperator`]'s, and agrees with it to rounding
/// (test `a_window_gives_the_displacement_of_the_whole_pressure`). Uses the current rayon pool; the result has
/// the same bits for every pool.
#[derive(Debug)]
pub struct WindowOperator(SectorConvolution);

impl WindowOperator {
    /// The operator for a window of `size` elements per row, the first of which is the element `origin` of the
    /// `shown` ones. In a sector, windows begin at its axes, in which their pressures are mirrored, and are the same
    /// part of a square as the sector.
    ///
    /// # Panics
    /// If the window is empty or does not lie within the `shown` elements, or the table does not span the whole grid.
    #[must_use]
    pub fn new(
        table: &CoefficientTable,
        shown: SectorGrid,
        origin: [usize; 2],
        size: usize,
    ) -> Self {
        Self(SectorConvolution::new(table, shown, origin, size))
    }

    /// Writes the displacements of the grid (m, positive into the body) under the pressures in the window (Pa, positive
    /// in compression), both row by row.
    ///
    /// # Panics
    /// If a field does not have one value per element.
    pub fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.0.apply_into(pressure, displacement);
    }
}
