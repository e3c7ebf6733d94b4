//! The pressure on a grid, transformed once, and the fields that are its products with spectra.
//!
//! If the pressure is symmetric in x and y, a quadrant stands for the grid. The part of a field of each parity is then
//! determined by its quadrant, too: even ones by cosine transforms, odd ones by sine transforms.

use rayon::prelude::*;

use super::parity::{ParityPart, write_products};
use crate::sector::{Sector, SectorGrid};
use crate::transform::{
    EvenLines, FourierLines, Lines, Parity, PlaneSpectrum, PlaneTransform, half_length,
};

/// The loaded square of elements and the square around it on which fields are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Squares {
    /// Loaded elements along a side.
    pub loaded: usize,
    /// Elements along a side under whose centres the fields are wanted; at least as many.
    pub shown: usize,
    /// The number of these before the first loaded one along x and y.
    pub before: [usize; 2],
}

impl Squares {
    /// Exclusive upper bound on the offset of a shown element from a loaded one.
    pub(super) fn offsets(&self) -> usize {
        let reach = self
            .before
            .map(|before| (before + self.loaded).max(self.shown - before));
        reach[0].max(reach[1])
    }

    /// Whether a pressure and both squares are symmetric in x and y, and of an even number of elements.
    fn are_mirrored(&self, pressure: &[f64]) -> bool {
        let Self {
            loaded,
            shown,
            before,
        } = *self;
        let is_centred = before.iter().all(|before| 2 * before + loaded == shown);
        if !is_centred || !loaded.is_multiple_of(2) {
            return false;
        }
        let rows = || pressure.chunks_exact(loaded);
        let is_mirrored = |row: &[f64]| row.iter().eq(row.iter().rev());
        rows().all(is_mirrored) && rows().eq(rows().rev())
    }
}

/// A pressure and the plans for its products.
pub enum TransformedPressure {
    /// Any pressure.
    Whole(Transformed<FourierLines<f64>>),
    /// A symmetric pressure, and a buffer for a quadrant of a field.
    Quadrant(Transformed<EvenLines<f64>>, Vec<f64>),
}

pub struct Transformed<L: Lines<Real = f64>> {
    transform: PlaneTransform<L>,
    pressure: PlaneSpectrum,
}

impl<L: Lines<Real = f64>> Transformed<L> {
    fn new(lines: L, pressure: &[f64]) -> Self {
        let mut transform = PlaneTransform::new(lines);
        transform.load(pressure, 1.0);
        Self {
            pressure: transform.spectrum(),
            transform,
        }
    }
}

impl TransformedPressure {
    /// Transforms the pressure; also returns M, half the padded length of the spectra.
    pub fn new(squares: Squares, pressure: &[f64]) -> (Self, usize) {
        let Squares {
            loaded,
            shown,
            before,
        } = squares;
        if squares.are_mirrored(pressure) {
            let (loaded, shown) = (loaded / 2, shown / 2);
            let length = half_length((loaded + shown).div_ceil(2));
            let lines = EvenLines::padded(loaded, shown, length);
            let quadrant = SectorGrid::new(Sector::Quadrant, loaded).cut(pressure);
            let transformed = Transformed::new(lines, &quadrant);
            return (
                Self::Quadrant(transformed, vec![0.0; shown * shown]),
                2 * length,
            );
        }
        let half = half_length(squares.offsets());
        let lines = FourierLines::padded(loaded, shown, before, half);
        (Self::Whole(Transformed::new(lines, pressure)), half)
    }

    /// Writes the field on the shown square, the sum of the parts.
    pub fn convolve(&mut self, parts: &[ParityPart], field: &mut [f64]) {
        match self {
            Self::Whole(Transformed {
                transform,
                pressure,
            }) => {
                transform.take_product(pressure, Parity::Even, |_, which, from, column| {
                    write_products(parts, which, from, column);
                });
                transform.restore(field, 1.0);
            }
            Self::Quadrant(
                Transformed {
                    transform,
                    pressure,
                },
                quadrant,
            ) => {
                field.fill(0.0);
                for part in parts {
                    let [x, y] = part.parities;
                    transform.take_product(pressure, x, |lines, which, from, column| {
                        part.write_pair_of_products(lines, which, from, column);
                    });
                    transform.restore_with(y, quadrant, 1.0);
                    unfold(quadrant, part.parities, field);
                }
            }
        }
    }
}

/// Adds the field with this quadrant, in which numbers of odd lines have the signs `(−1)ⁿ`.
fn unfold(quadrant: &[f64], [parity_x, parity_y]: [Parity; 2], field: &mut [f64]) {
    let half = quadrant.len().isqrt();
    let sign = |parity: Parity, n: usize| {
        if n.is_multiple_of(2) {
            1.0
        } else {
            parity.sign()
        }
    };
    let rows = field.par_chunks_exact_mut(2 * half).enumerate();
    rows.for_each(|(place, row)| {
        let (i, of_row) = if place < half {
            let i = half - 1 - place;
            (i, parity_x.sign() * sign(parity_x, i))
        } else {
            (place - half, sign(parity_x, place - half))
        };
        let values = &quadrant[i * half..][..half];
        let (images, own) = row.split_at_mut(half);
        let own = own.iter_mut().zip(images.iter_mut().rev());
        for (j, ((entry, image), value)) in own.zip(values).enumerate() {
            let value = of_row * sign(parity_y, j) * value;
            *entry += value;
            *image += parity_y.sign() * value;
        }
    });
}
