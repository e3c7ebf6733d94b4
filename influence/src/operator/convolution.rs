//! The product `K p` as a convolution: by the transform of the pressure, the spectrum of the coefficients, and back.

use super::elastic::ElasticOperator;
use super::spectrum::Spectrum;
use crate::coefficient_table::CoefficientTable;
use crate::sector::Sector;
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
        assert!(
            (1..=shown).contains(&loaded) && 2 * shown <= table.size(),
            "pressures on {loaded} elements of {shown}, these on a quadrant of {}",
            table.size()
        );
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
    /// For pressures on a window of `loaded` elements a row and displacements on one of `shown`, both halves of
    /// squares; the first pressure lies `above` rows below the first displacement.
    fn on_half(table: &CoefficientTable, [loaded, shown]: [usize; 2], above: usize) -> Self {
        assert!(
            (1..=shown).contains(&loaded) && 2 * shown <= table.size(),
            "pressures on {loaded} elements of {shown}, these on a half of {}",
            table.size()
        );
        let [pressures, displacements] = [loaded, shown].map(|of| Sector::Half.lengths(of));
        // No offset along x is larger than this, and along y than loaded + shown.
        let reach = (above + pressures[0]).max(displacements[0] - above);
        let length = half_length(reach.max(loaded + shown).div_ceil(2));
        let half = 2 * length;
        Self {
            transform: PlaneTransform::new(HalfLines::padded(
                pressures,
                displacements,
                above,
                length,
            )),
            spectrum: Spectrum::new(table, (2 * shown).min(half + 1), half),
        }
    }
}

impl<L: Lines<Real = f64>> Convolution<L> {
    /// Displacements of a row.
    fn shown(&self) -> usize {
        let [_, of_row] = self.transform.lines().shown();
        of_row
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.transform.load(pressure, 1.0);
        self.transform
            .multiply(|frequency| self.spectrum.column(frequency));
        self.transform.restore(displacement, 1.0);
    }
}

/// `u = K p` in O(N² log N), by a zero-padded real FFT, never a periodic one.
///
/// Memory: 8 bytes an element of the grid for the spectrum, 16 for the half-transformed field, and for each thread
/// 600 N bytes of scratch. Accuracy: rounding, some 1e-15 of the largest displacement; within 1e-13 of
/// [`crate::DenseOperator`] (test `both_operators_agree_to_rounding`). Uses the current rayon pool; the result does
/// not depend on it, bit for bit.
pub struct ConvolutionOperator(Convolution<FourierLines<f64>>);

impl ConvolutionOperator {
    /// The operator of the grid the table was made for.
    #[must_use]
    pub fn new(table: &CoefficientTable) -> Self {
        Self::windowed(table, table.size())
    }

    /// The operator of a window of `size` × `size` elements of that grid; the coefficients depend on the offset alone.
    ///
    /// # Panics
    /// If `size` is above the table's.
    #[must_use]
    pub fn windowed(table: &CoefficientTable, size: usize) -> Self {
        Self(Convolution::on_grid(table, [size; 2], [0; 2]))
    }
}

impl ElasticOperator for ConvolutionOperator {
    fn size(&self) -> usize {
        self.0.shown()
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.0.apply_into(pressure, displacement);
    }
}

/// `u = K p` for a pressure that is symmetric in x and y: on the quadrant x, y > 0, element (0, 0) of which lies at
/// the axis.
///
/// Each element (i, j) presses together with its three mirror images, and its displacement is that of all four: M ×
/// M elements stand for 2M × 2M. Every transform is half as long along each axis, and real where it was complex, so
/// a product takes a quarter to a third of the time.
///
/// Memory: 32 bytes an element for the spectrum, 16 for the half-transformed field, and for each thread 900 M bytes
/// of scratch. Accuracy: rounding, as [`ConvolutionOperator`], with which it agrees on the whole grid (test
/// `a_quadrant_moves_as_the_whole_surface_does`). Uses the current rayon pool; the result does not depend on it,
/// bit for bit.
pub struct QuadrantOperator(Convolution<EvenLines<f64>>);

impl QuadrantOperator {
    /// For `size` × `size` elements of a quadrant.
    ///
    /// # Panics
    /// If `size` is 0, or the table does not reach across twice as many elements.
    #[must_use]
    pub fn new(table: &CoefficientTable, size: usize) -> Self {
        Self(Convolution::on_quadrant(table, [size; 2]))
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

/// `u = K p` for a pressure that is symmetric in y: on the half y > 0, the first element of each row of which lies at
/// the axis.
///
/// Each element presses together with its mirror image: 2M rows of M elements stand for 2M × 2M, and a product takes
/// half the time. Memory and accuracy as [`QuadrantOperator`], with twice the elements (test
/// `a_half_moves_as_the_whole_surface_does`).
pub struct HalfOperator(Convolution<HalfLines<f64>>);

impl HalfOperator {
    /// For 2 · `size` rows of `size` elements.
    ///
    /// # Panics
    /// As [`QuadrantOperator::new`].
    #[must_use]
    pub fn new(table: &CoefficientTable, size: usize) -> Self {
        Self(Convolution::on_half(table, [size; 2], 0))
    }
}

impl ElasticOperator for HalfOperator {
    fn size(&self) -> usize {
        self.0.shown()
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.0.apply_into(pressure, displacement);
    }
}

/// `u = K p` on a grid, or a sector of one, for pressures that vanish outside a square window of it.
///
/// The transforms are as long as the window and the grid together, not as twice the grid: with a window of half the
/// side a product takes half the time of [`ConvolutionOperator`]'s, and agrees with it to rounding (test
/// `under_a_window_the_grid_moves_as_under_the_whole_pressure`). Uses the current rayon pool; the result does not
/// depend on it, bit for bit.
pub struct WindowOperator(ShownSurface);

/// The surface that moves.
enum ShownSurface {
    Grid(Convolution<FourierLines<f64>>),
    Half(Convolution<HalfLines<f64>>),
    Quadrant(Convolution<EvenLines<f64>>),
}

impl WindowOperator {
    /// For a window of `size` elements a row, the first of which is the element `origin`, of a sector of `shown`; a
    /// sector's windows begin at its axes, in which their pressures are mirrored, and are such parts of squares as it
    /// is.
    ///
    /// # Panics
    /// If the window is empty or does not lie within the sector, or the table does not reach across the whole grid.
    #[must_use]
    pub fn new(
        table: &CoefficientTable,
        (sector, shown): (Sector, usize),
        origin: [usize; 2],
        size: usize,
    ) -> Self {
        let [window, all] = [size, shown].map(|of| sector.lengths(of));
        let lies_within = (0..2).all(|axis| origin[axis] + window[axis] <= all[axis]);
        assert!(
            size > 0 && lies_within && sector.whole(shown) <= table.size(),
            "a window of {size} elements from {origin:?} within {shown}, these within {}",
            table.size()
        );
        Self(match sector {
            Sector::Whole => ShownSurface::Grid(Convolution::on_grid(table, [size, shown], origin)),
            Sector::Half => {
                let [above, before] = origin;
                assert_eq!(before, 0, "a half's window begins at the axis");
                ShownSurface::Half(Convolution::on_half(table, [size, shown], above))
            }
            Sector::Quadrant => {
                assert_eq!(origin, [0; 2], "a quadrant's window begins at the axis");
                ShownSurface::Quadrant(Convolution::on_quadrant(table, [size, shown]))
            }
        })
    }

    /// Writes the displacements (m, positive into the body; those of the grid) of the pressures (Pa, compressive
    /// positive; those of the window), both row after row.
    ///
    /// # Panics
    /// If a field has not one value per element.
    pub fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        match &mut self.0 {
            ShownSurface::Grid(convolution) => convolution.apply_into(pressure, displacement),
            ShownSurface::Half(convolution) => convolution.apply_into(pressure, displacement),
            ShownSurface::Quadrant(convolution) => convolution.apply_into(pressure, displacement),
        }
    }

    fn size(&self) -> usize {
        match &self.0 {
            ShownSurface::Grid(convolution) => convolution.shown(),
            ShownSurface::Half(convolution) => convolution.shown(),
            ShownSurface::Quadrant(convolution) => convolution.shown(),
        }
    }
}

/// Tells the size alone of operators whose plans and buffers nobody wants to read.
macro_rules! debug_of_size {
    ($($name:ident),*) => {$(
        impl std::fmt::Debug for $name {
            fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                let mut shown = formatter.debug_struct(stringify!($name));
                shown.field("size", &self.size()).finish_non_exhaustive()
            }
        }
    )*};
}

debug_of_size!(
    ConvolutionOperator,
    HalfOperator,
    QuadrantOperator,
    WindowOperator
);
