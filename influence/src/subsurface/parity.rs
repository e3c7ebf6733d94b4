//! The parities of an element's fields about its axes, and products with the spectra of such fields.
//!
//! A field of one load is even or odd in each offset, and so is its spectrum, which is real up to a factor `−i` for
//! each axis in which the field is odd.

use pellicle_fourier::Complex64;

use super::state::FIELDS;
use crate::operator::Spectrum;
use crate::transform::Parity::{Even, Odd};
use crate::transform::{EvenLines, Parity};

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

/// Parities of the fields under a traction along x: the opposite ones along x.
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

/// Writes the product of a part of a column, at this frequency along y, with the sum of the spectra.
pub fn write_products(
    parts: &[ParityPart],
    which: [usize; 2],
    from: &[Complex64],
    column: &mut [Complex64],
) {
    for (index, part) in parts.iter().enumerate() {
        if index == 0 {
            part.take_product(which, from, column, |entry, product| *entry = product);
        } else {
            part.take_product(which, from, column, |entry, product| *entry += product);
        }
    }
}

impl ParityPart<'_> {
    /// Calls `take` with every entry and its product.
    #[inline]
    fn take_product(
        &self,
        [frequency, part]: [usize; 2],
        from: &[Complex64],
        column: &mut [Complex64],
        take: impl Fn(&mut Complex64, Complex64) + Copy,
    ) {
        let values = self.spectrum.column(frequency)[part];
        let (from_rising, from_falling) = from.split_at(values.len());
        let (rising, falling) = column.split_at_mut(values.len());
        // The other frequencies are mirror images; 0 has none and is in the first part.
        let mirrored = values[1 - part..][..falling.len()].iter().rev();
        let (x, y) = (self.parities[0].sign(), self.parities[1].sign());
        let rising = rising.iter_mut().zip(from_rising).zip(values);
        let falling = falling.iter_mut().zip(from_falling).zip(mirrored);
        if x * y > 0.0 {
            // 1 and (−i)² = −1
            let [factor, of_image] = [x * self.factor, self.factor];
            rising.for_each(|((entry, z), value)| take(entry, z * (factor * value)));
            falling.for_each(|((entry, z), value)| take(entry, z * (of_image * value)));
        } else {
            // −i z
            let [factor, of_image] = [self.factor, x * self.factor];
            rising.for_each(|((entry, z), value)| take(entry, turned(z, factor * value)));
            falling.for_each(|((entry, z), value)| take(entry, turned(z, of_image * value)));
        }
    }
}

impl ParityPart<'_> {
    /// Writes the products of a part of two adjacent real columns of a mirrored field.
    pub fn write_pair_of_products(
        &self,
        lines: &EvenLines<f64>,
        [number, part]: [usize; 2],
        from: &[Complex64],
        column: &mut [Complex64],
    ) {
        let [one, other] = lines
            .frequencies(number)
            .map(|frequency| self.spectrum.column(frequency)[part]);
        let entries = column.iter_mut().zip(from).zip(one.iter().zip(other));
        for ((entry, z), (one, other)) in entries {
            *entry = Complex64::new(z.re * self.factor * one, z.im * self.factor * other);
        }
    }
}

/// `−i z factor`.
#[inline]
fn turned(z: &Complex64, factor: f64) -> Complex64 {
    Complex64::new(z.im * factor, -z.re * factor)
}
