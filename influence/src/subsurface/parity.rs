//! How the fields of an element continue beyond its axes, and products with the spectra of such fields.
//!
//! A field of one load is even or odd in each offset, and so is its spectrum, which is real but for a factor `−i` for each
//! axis in which the field is odd.

use rustfft::num_complex::Complex64;

use super::state::FIELDS;
use crate::operator::Spectrum;
use crate::transform::Parity;
use crate::transform::Parity::{Even, Odd};

/// Parities along x and y of the fields under a pressure, in the order of `SubsurfaceState`.
pub const UNDER_PRESSURE: [[Parity; 2]; FIELDS] = [
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
pub fn under_traction(field: usize) -> [Parity; 2] {
    let [x, y] = UNDER_PRESSURE[field];
    let other = match x {
        Even => Odd,
        Odd => Even,
    };
    [other, y]
}

/// The spectrum of a part of a field.
pub struct ParityPart<'a> {
    pub spectrum: &'a Spectrum,
    pub parities: [Parity; 2],
    pub factor: f64,
}

/// Writes the product of a part of a column, of this frequency along y, with the sum of the spectra.
pub fn add_products(
    parts: &[ParityPart],
    which: [usize; 2],
    from: &[Complex64],
    column: &mut [Complex64],
) {
    column.fill(Complex64::ZERO);
    for part in parts {
        part.add_product(which, from, column);
    }
}

impl ParityPart<'_> {
    fn add_product(
        &self,
        [frequency, part]: [usize; 2],
        from: &[Complex64],
        column: &mut [Complex64],
    ) {
        let factors = self.spectrum.column(frequency)[part];
        let (from_rising, from_falling) = from.split_at(factors.len());
        let (rising, falling) = column.split_at_mut(factors.len());
        // The other frequencies are mirror images; 0 has none, and is in the first part.
        let mirrored = factors[1 - part..][..falling.len()].iter().rev();
        let image = match self.parities[0] {
            Even => 1.0,
            Odd => -1.0,
        };
        match self.parities {
            [Even, Even] | [Odd, Odd] => {
                // (−i)² = −1
                let factor = image * self.factor;
                let add =
                    |((sum, x), value): ((&mut Complex64, &Complex64), f64)| *sum += x * value;
                let terms = rising.iter_mut().zip(from_rising);
                terms
                    .zip(factors.iter().map(|value| factor * value))
                    .for_each(add);
                let terms = falling.iter_mut().zip(from_falling);
                terms
                    .zip(mirrored.map(|value| image * factor * value))
                    .for_each(add);
            }
            [Even, Odd] | [Odd, Even] => {
                // −i (x + i y) = y − i x
                let add = |((sum, x), value): ((&mut Complex64, &Complex64), f64)| {
                    *sum += Complex64::new(x.im * value, -x.re * value);
                };
                let terms = rising.iter_mut().zip(from_rising);
                terms
                    .zip(factors.iter().map(|value| self.factor * value))
                    .for_each(add);
                let terms = falling.iter_mut().zip(from_falling);
                terms
                    .zip(mirrored.map(|value| image * self.factor * value))
                    .for_each(add);
            }
        }
    }
}
