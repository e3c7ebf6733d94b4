//! The product `K p` as a convolution: by the transform of the pressure, the spectrum of the coefficients, and back.

use super::elastic::ElasticOperator;
use super::spectrum::Spectrum;
use crate::coefficient_table::CoefficientTable;
use crate::sector::{Sector, SectorGrid};
use crate::transform::{EvenLines, FourierLines, HalfLines, Lines, PlaneTransform, half_length};

/// From a square of pressures to the square of displacements around it.
struct Convolution<L: Lines> {
    transform: PlaneTransform<L>,
    spectrum: Spectrum,
}

impl Convolution<FourierLines<f64>> {
    /// For `loaded` pressures along a side and `shown` displacements, the first of which lies `before` the first
    /// pressure.
    fn on_grid(table: &CoefficientTable, [loaded, shown]: [usize; 2], before: [usize; 2]) -> Self {
        let reach = before.map(|before| (before + loaded).max(shown - before));
        // No offset of a displacement from a pressure is larger, so that none is taken for another.
        let half = half_length(reach[0].max(reach[1]));
        Self {
            transform: PlaneTransform::new(FourierLines::padded(loaded, shown, before, half)),
            spectrum: Spectrum::new(table, shown.min(half + 1), half),
        }
    }
}

impl Convolution<EvenLines<f64>> {
    /// For `loaded` pressures from the axis on and `shown` displacements of a quadrant.
    fn on_quadrant(table: &CoefficientTable, [loaded, shown]: [usize; 2]) -> Self {
        let length = half_length((loaded + shown).div_ceil(2));
        Self {
            transform: PlaneTransform::new(EvenLines::padded(loaded, shown, length)),
            // From one end of the pressures to the other of the displacements no offset is larger than loaded +
            // shown − 1.
            spectrum: Spectrum::new(table, loaded + shown, 2 * length),
        }
    }
}

impl Convolution<HalfLines<f64>> {
    /// For pressures on a `loaded` half of a square and displacements on a `shown` one; the first pressure lies `above`
    /// rows below the first displacement.
    fn on_half(table: &CoefficientTable, [loaded, shown]: [SectorGrid; 2], above: usize) -> Self {
        let [pressures, displacements] = [loaded, shown].map(SectorGrid::lengths);
        // No offset along x is larger than this, and along y than loaded + shown.
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

/// Without the plans and buffers, which nobody wants to read.
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
    /// For pressures on a window of `size` elements a row, the first of which is the element `origin`, and
    /// displacements on the `shown` elements.
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

/// `u = K p` on a grid in O(N² log N), by a zero-padded real FFT, never a periodic one.
///
/// On a [sector](SectorGrid) of a grid each element presses together with its mirror images, and its displacement is
/// that of all. Transforms are half as long along an axis that mirrors, and real where they were complex: a product
/// takes half the time on a half, a quarter to a third of it on a quadrant. Both agree with the whole grid to rounding
/// (tests `a_half_moves_as_the_whole_surface_does`, `a_quadrant_moves_as_the_whole_surface_does`).
///
/// Memory: 8 bytes an element of the whole grid for the spectrum, 16 one of the sector for the half-transformed field,
/// and for each thread 600 N bytes of scratch, 900 on a quadrant. Accuracy: rounding, some 1e-15 of the largest
/// displacement; within 1e-13 of [`crate::DenseOperator`] (test `both_operators_agree_to_rounding`). Uses the current
/// rayon pool; the result does not depend on it, bit for bit.
#[derive(Debug)]
pub struct ConvolutionOperator {
    grid: SectorGrid,
    convolution: SectorConvolution,
}

impl ConvolutionOperator {
    /// The operator of the grid the table was made for.
    #[must_use]
    pub fn new(table: &CoefficientTable) -> Self {
        Self::on(table, SectorGrid::whole(table.size()))
    }

    /// The operator of a window of that grid, or of a sector of one; the coefficients depend on the offset alone.
    ///
    /// # Panics
    /// If there are no elements, or the table does not reach across the whole grid.
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
/// The transforms are as long as the window and the grid together, not as twice the grid: with a window of half the
/// side a product takes half the time of [`ConvolutionOperator`]'s, and agrees with it to rounding (test
/// `under_a_window_the_grid_moves_as_under_the_whole_pressure`). Uses the current rayon pool; the result does not
/// depend on it, bit for bit.
#[derive(Debug)]
pub struct WindowOperator(SectorConvolution);

impl WindowOperator {
    /// For a window of `size` elements a row, the first of which is the element `origin` of the `shown` ones; a
    /// sector's windows begin at its axes, in which their pressures are mirrored, and are such parts of squares as it
    /// is.
    ///
    /// # Panics
    /// If the window is empty or does not lie within the `shown` elements, or the table does not reach across the whole
    /// grid.
    #[must_use]
    pub fn new(
        table: &CoefficientTable,
        shown: SectorGrid,
        origin: [usize; 2],
        size: usize,
    ) -> Self {
        Self(SectorConvolution::new(table, shown, origin, size))
    }

    /// Writes the displacements (m, positive into the body; those of the grid) of the pressures (Pa, compressive
    /// positive; those of the window), both row after row.
    ///
    /// # Panics
    /// If a field has not one value per element.
    pub fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.0.apply_into(pressure, displacement);
    }
}
