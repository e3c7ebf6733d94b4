//! Eigenvalues of the circulant in which a matrix of coefficients that depend only on the offset is embedded.
//!
//! The coefficients of all offsets up to M − 1 or M, extended to L × L = 2M × 2M with zeros where none is needed, form
//! a circulant whose product with a zero-padded pressure is exactly that of the matrix. Coefficients that are even in
//! both offsets have a real, even spectrum; along an axis in which they are odd, the spectrum is odd and has a factor
//! `−i`. A quarter of real numbers determines it.

use rayon::prelude::*;

use crate::coefficient_table::CoefficientTable;
use crate::transform::{LINES, MirrorTransform, Parity};

/// A quarter, (M+1) × (M+1) values, of the L × L spectrum, without its factor `−i` for each axis of odd parity.
#[derive(Clone, Debug)]
pub(crate) struct Spectrum {
    /// M, half the padded length.
    half: usize,
    /// Column by column; in each, the values at even frequencies precede those at odd ones.
    values: Vec<f64>,
}

impl Spectrum {
    /// The spectrum of the coefficients of `size` × `size` offsets, no more than `half` + 1 along a side, embedded
    /// in 2`half` × 2`half`.
    pub(crate) fn new(table: &CoefficientTable, size: usize, half: usize) -> Self {
        let mut spectrum = Self::zeros(half);
        let coefficients = |first: usize, n: usize| table.side_by_side(first, n);
        let mut transform = QuarterTransform::new(size, half);
        transform.transform(coefficients, [Parity::Even; 2], &mut spectrum);
        spectrum
    }

    /// A spectrum of zeros.
    pub(crate) fn zeros(half: usize) -> Self {
        let values = vec![0.0; (half + 1) * (half + 1)];
        Self { half, values }
    }

    /// The values of column `frequency` at the frequencies 0, 2, 4 … and 1, 3, 5 … up to M.
    pub(crate) fn column(&self, frequency: usize) -> [&[f64]; 2] {
        let width = self.half + 1;
        let column = &self.values[frequency * width..(frequency + 1) * width];
        let (even, odd) = column.split_at(self.half / 2 + 1);
        [even, odd]
    }

    /// Writes the spectrum of the coefficients with x and y exchanged.
    pub(crate) fn transpose_into(&self, other: &mut Self) {
        let half = self.half;
        let width = half + 1;
        let groups = other.values.par_chunks_mut(LINES * width).enumerate();
        groups.for_each(|(group, columns)| {
            let first = group * LINES;
            let places: [usize; LINES] = std::array::from_fn(|i| place(first + i, half));
            for frequency in 0..width {
                let row = &self.values[frequency * width..][..width];
                let to = place(frequency, half);
                let columns = columns.chunks_exact_mut(width);
                for (column, from) in columns.zip(places) {
                    column[to] = row[from];
                }
            }
        });
    }
}

/// The position of a frequency in a column: even ones before odd ones.
fn place(frequency: usize, half: usize) -> usize {
    frequency / 2 + frequency % 2 * (half / 2 + 1)
}

/// Plans and a buffer for spectra of one size.
pub(crate) struct QuarterTransform {
    /// Offsets along a side.
    size: usize,
    half: usize,
    even: MirrorTransform,
    odd: MirrorTransform,
    /// The coefficients transformed along y: for [`LINES`] adjacent offsets along x, one frequency after the other,
    /// with zeros up to a multiple of [`LINES`] frequencies.
    along_y: Vec<f64>,
}

impl QuarterTransform {
    /// The plans for `size` × `size` offsets, no more than `half` + 1 along a side, embedded in 2`half` × 2`half`.
    pub(crate) fn new(size: usize, half: usize) -> Self {
        assert!(size <= half + 1, "no offset is taken for another");
        let frequencies = (half + 1).next_multiple_of(LINES);
        Self {
            size,
            half,
            even: MirrorTransform::new(half, Parity::Even),
            odd: MirrorTransform::new(half, Parity::Odd),
            along_y: vec![0.0; size.next_multiple_of(LINES) * frequencies],
        }
    }

    /// Computes the spectrum of coefficients of these parities along x and y. They are given for [`LINES`]
    /// adjacent offsets along x, the first of which is a multiple of it, and one along y, and are finite beyond
    /// the last offset. The spectrum is divided by the number of padded elements, the factor of an unnormalised
    /// forward and inverse transform.
    pub(crate) fn transform(
        &mut self,
        coefficients: impl Fn(usize, usize) -> [f64; LINES] + Sync,
        [parity_x, parity_y]: [Parity; 2],
        spectrum: &mut Spectrum,
    ) {
        let (size, half) = (self.size, self.half);
        let of = |parity| match parity {
            Parity::Even => &self.even,
            Parity::Odd => &self.odd,
        };
        let (along_x, along_y) = (of(parity_x), of(parity_y));
        let length = LINES * (half + 1).next_multiple_of(LINES);
        let groups = self.along_y.par_chunks_exact_mut(length).enumerate();
        groups.for_each_init(
            || along_y.buffers(),
            |buffers, (group, results)| {
                let entries = |n: usize| coefficients(group * LINES, n);
                let results = results.as_chunks_mut().0;
                along_y.transform(size, entries, buffers, |frequency, values| {
                    results[frequency] = values;
                });
            },
        );
        let factor = 1.0 / (4 * half * half) as f64;
        let width = half + 1;
        let lines = &self.along_y;
        let groups = spectrum.values.par_chunks_mut(LINES * width).enumerate();
        groups.for_each_init(
            || along_x.buffers(),
            |buffers, (group, results)| {
                let entries = |m: usize| {
                    let first = m / LINES * length + group * LINES * LINES + m % LINES;
                    let block = &lines[first..][..=LINES * (LINES - 1)];
                    std::array::from_fn(|i| block[i * LINES])
                };
                along_x.transform(size, entries, buffers, |frequency, values| {
                    let columns = results[place(frequency, half)..].iter_mut();
                    for (entry, value) in columns.step_by(width).zip(values) {
                        *entry = factor * value;
                    }
                });
            },
        );
    }
}

#[cfg(test)]
mod tests {
    use super::{LINES, Parity, QuarterTransform, Spectrum};
    use crate::coefficient_table::CoefficientTable;

    #[test]
    fn a_diagonal_matrix_has_a_constant_spectrum() {
        let own = |[m, n]: [usize; 2]| if m + n == 0 { 3.0 } else { 0.0 };
        let table = CoefficientTable::from_fn(1.0, 5, own).unwrap();
        let spectrum = Spectrum::new(&table, 5, 6);
        for frequency in 0..=6 {
            let [even, odd] = spectrum.column(frequency);
            assert_eq!((even.len(), odd.len()), (4, 3));
            for value in even.iter().chain(odd) {
                // Rounding of two transforms of length 12.
                assert!((value * 144.0 - 3.0).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn a_spectrum_is_transposed_with_its_coefficients() {
        for half in [3, 12, 20] {
            let entry = |m: usize, n: usize| ((3 * m + 1) as f64 + 0.37 * n as f64).sin();
            let [mut one, mut other, mut found] = [(); 3].map(|()| Spectrum::zeros(half));
            let mut transform = QuarterTransform::new(half, half);
            let entries = |m, n| std::array::from_fn::<f64, LINES, _>(|i| entry(m + i, n));
            transform.transform(entries, [Parity::Odd, Parity::Even], &mut one);
            let entries = |m, n| std::array::from_fn(|i| entry(n, m + i));
            transform.transform(entries, [Parity::Even, Parity::Odd], &mut other);
            one.transpose_into(&mut found);
            for frequency in 0..=half {
                let columns = found.column(frequency).into_iter().flatten();
                for (found, expected) in columns.zip(other.column(frequency).into_iter().flatten())
                {
                    assert!((found - expected).abs() < 1e-15, "{half} {frequency}");
                }
            }
        }
    }

    #[test]
    fn the_zero_frequency_is_the_sum_of_all_coefficients() {
        let kernel = |[m, n]: [usize; 2]| 1.0 / (1.0 + (m * m + n * n) as f64);
        let table = CoefficientTable::from_fn(1.0, 4, kernel).unwrap();
        let offsets = || -3..=3_i32;
        let sum: f64 = offsets()
            .flat_map(|m| offsets().map(move |n| 1.0 / (1.0 + f64::from(m * m + n * n))))
            .sum();
        let found = Spectrum::new(&table, 4, 4).column(0)[0][0] * 64.0;
        // Rounding of 49 terms.
        assert!((found - sum).abs() < 1e-14 * sum);
    }
}
