//! The fields on planes under a pressure on a grid, by convolution.
//!
//! The transform of the pressure is made once. For each plane the nine fields of one element are tabulated at the
//! offsets of a quarter of the grid, transformed, multiplied and transformed back. A field of one load is even or odd
//! in each offset, and so is its spectrum; a traction in any direction is the sum of one along x and one along y.

use pellicle_kernel::Foundation;
use rustfft::num_complex::Complex64;

use super::depth::Depth;
use super::element::ElementFields;
use super::element_table::ElementTable;
use super::state::{FIELDS, SurfaceLoad};
use crate::error::InfluenceError;
use crate::operator::Spectrum;
use crate::transform::Parity::{Even, Odd};
use crate::transform::{FourierLines, Parity, PlaneSpectrum, PlaneTransform, half_length};

/// Parities along x and y of the fields under a pressure, in the order of `SubsurfaceState`.
pub(super) const UNDER_PRESSURE: [[Parity; 2]; FIELDS] = [
    [Odd, Even],
    [Even, Odd],
    [Even, Even],
    [Even, Even],
    [Even, Even],
    [Even, Even],
    [Odd, Odd],
    [Odd, Even],
    [Even, Odd],
];

/// Parities of the fields under a traction along x: the other one along x.
pub(super) fn under_traction(field: usize) -> [Parity; 2] {
    let [x, y] = UNDER_PRESSURE[field];
    [x.other(), y]
}

/// The field that takes the place of each if x and y change places.
const TRANSPOSED: [usize; FIELDS] = [1, 0, 2, 4, 3, 5, 6, 8, 7];

/// The loaded square of elements and the one around it under which fields are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Squares {
    /// Loaded elements along a side.
    pub loaded: usize,
    /// Elements along a side under whose centres the fields are wanted, no fewer.
    pub shown: usize,
    /// Of these, those before the first loaded one along x and y.
    pub before: [usize; 2],
}

/// The loads on a square of elements, transformed, and the buffers for the fields on planes below.
pub struct PlaneFields {
    foundation: Foundation,
    element_side: f64,
    /// Factors of a traction along x and y per pressure.
    friction: [f64; 2],
    transform: PlaneTransform<FourierLines<f64>>,
    pressure: PlaneSpectrum,
    /// M, half the padded length.
    half: usize,
    /// Offsets along a side.
    offsets: usize,
    /// The fields of one element under a pressure and, where there is friction, under a traction.
    normal: ElementTable,
    tangential: Option<ElementTable>,
    /// One field on the plane.
    shown: Vec<f64>,
}

impl PlaneFields {
    /// Loads a foundation by the `pressure` (Pa) on a square of elements of side `element_side` (m), and by a traction
    /// of `friction` times the pressure along x and y, which drags the surface with it.
    ///
    /// # Panics
    /// If the pressure has not one value per loaded element, or the loaded square does not lie within the shown one.
    #[must_use]
    pub fn new(
        foundation: &Foundation,
        element_side: f64,
        squares: Squares,
        pressure: &[f64],
        friction: [f64; 2],
    ) -> Self {
        let Squares {
            loaded,
            shown,
            before,
        } = squares;
        assert!(
            before.iter().all(|before| before + loaded <= shown),
            "{loaded} loaded elements from {before:?} on within {shown}"
        );
        // The largest offset of a shown element from a loaded one is below this.
        let reach = before.map(|before| (before + loaded).max(shown - before));
        let offsets = reach[0].max(reach[1]);
        let half = half_length(offsets);
        let lines = FourierLines::padded(loaded, shown, before, half);
        let mut transform = PlaneTransform::new(lines);
        transform.load(pressure, 1.0);
        Self {
            foundation: foundation.clone(),
            element_side,
            friction,
            pressure: transform.spectrum(),
            transform,
            half,
            offsets,
            normal: ElementTable::new(offsets),
            tangential: friction
                .iter()
                .any(|factor| *factor != 0.0)
                .then(|| ElementTable::new(offsets)),
            shown: vec![0.0; shown * shown],
        }
    }

    /// Calls `take` with each of the nine fields at a depth, in the order of
    /// [`SubsurfaceState`](super::SubsurfaceState): at the centres of the shown elements, row after row, displacements
    /// in m and stresses in Pa; NaN where they are unbounded.
    ///
    /// # Errors
    /// As [`ElementFields::new`].
    pub fn fields_on(
        &mut self,
        depth: Depth,
        mut take: impl FnMut(usize, &[f64]),
    ) -> Result<(), InfluenceError> {
        let (side, offsets) = (self.element_side, self.offsets);
        let diagonal = std::f64::consts::SQRT_2 * side * offsets as f64;
        let fields = ElementFields::new(&self.foundation, side, depth, diagonal)?;
        self.normal.fill(&fields, SurfaceLoad::Pressure);
        if let Some(tangential) = &mut self.tangential {
            tangential.fill(&fields, SurfaceLoad::Traction);
        }
        for field in 0..FIELDS {
            let parts = self.parts(field);
            let weigh = |which, column: &mut [Complex64]| weigh(&parts, which, column);
            self.transform.take_product(&self.pressure, weigh);
            self.transform.restore(&mut self.shown, 1.0);
            if self.tangential.is_some() && !fields.is_bounded(field) {
                self.shown.fill(f64::NAN);
            }
            take(field, &self.shown);
        }
        Ok(())
    }

    /// The spectra whose sum is that of a field.
    fn parts(&self, field: usize) -> Vec<ParityPart> {
        let part = |quarter: &[f64], parities, factor| ParityPart {
            spectrum: Spectrum::of_quarter(quarter, parities, self.offsets, self.half),
            parities,
            factor,
        };
        let mut parts = vec![part(self.normal.field(field), UNDER_PRESSURE[field], 1.0)];
        if let Some(tangential) = &self.tangential {
            let [along_x, along_y] = self.friction;
            parts.push(part(
                tangential.field(field),
                under_traction(field),
                along_x,
            ));
            // x and y change places.
            let other = TRANSPOSED[field];
            let transposed = transposed(tangential.field(other), self.offsets);
            let [x, y] = under_traction(other);
            parts.push(part(&transposed, [y, x], along_y));
        }
        parts
    }
}

/// A square field with x and y in each other's place.
pub(super) fn transposed(field: &[f64], size: usize) -> Vec<f64> {
    let row = |m: usize| (0..size).map(move |n| field[n * size + m]);
    (0..size).flat_map(row).collect()
}

/// A spectrum of one parity.
struct ParityPart {
    spectrum: Spectrum,
    parities: [Parity; 2],
    factor: f64,
}

/// Multiplies one part of the column of this frequency along y by the sum of the spectra.
fn weigh(parts: &[ParityPart], [frequency, which]: [usize; 2], column: &mut [Complex64]) {
    let length = column.len();
    let rising = length / 2 + 1 - which * (1 - length % 2);
    for (k, entry) in column.iter_mut().enumerate() {
        // Frequencies above the middle are the mirror images of those below.
        let (place, sign) = if k < rising {
            (k, 1.0)
        } else {
            (length - which - k, -1.0)
        };
        let values = parts
            .iter()
            .map(|part| part.value([frequency, which], place, sign));
        *entry *= values.sum::<Complex64>();
    }
}

impl ParityPart {
    /// The spectrum at one frequency along y and a place among the even or odd ones along x, or at its mirror image.
    fn value(&self, [frequency, which]: [usize; 2], place: usize, sign: f64) -> Complex64 {
        let value = self.factor * self.spectrum.column(frequency)[which][place];
        let [x, y] = self.parities;
        let value = if x == Odd { sign * value } else { value };
        x.phase() * y.phase() * value
    }
}

impl Parity {
    fn other(self) -> Self {
        match self {
            Even => Odd,
            Odd => Even,
        }
    }

    /// The factor of a value at a mirror image, whose sign is −1.
    pub(super) fn sign(self, sign: f64) -> f64 {
        match self {
            Even => 1.0,
            Odd => sign,
        }
    }

    /// The factor of a spectrum.
    fn phase(self) -> Complex64 {
        match self {
            Even => Complex64::ONE,
            Odd => -Complex64::I,
        }
    }
}
