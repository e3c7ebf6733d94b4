//! Eigenvalues of the circulant in which the matrix of influence coefficients is embedded.
//!
//! The coefficients of all offsets up to M − 1 or M, extended evenly to L × L = 2M × 2M and zero where none is needed, are a
//! circulant whose product with a zero-padded pressure is exactly K p. Its spectrum is real and even: a quarter determines it.

use rayon::prelude::*;
use realfft::RealFftPlanner;
use rustfft::num_complex::Complex64;

use crate::coefficient_table::CoefficientTable;

/// A quarter, (M+1) × (M+1) values, of the real, even, symmetric L × L spectrum.
#[derive(Clone, Debug)]
pub(crate) struct Spectrum {
    /// M, half the padded length.
    half: usize,
    /// Column after column, of each those at even frequencies before those at odd ones.
    values: Vec<f64>,
}

impl Spectrum {
    /// The spectrum of the coefficients of `size` × `size` offsets, no more than `half` + 1 along a side, embedded in 2`half` × 2`half`, divided by the number of padded elements, which is the factor an unnormalised forward
    /// and inverse transform leave behind.
    pub(crate) fn new(table: &CoefficientTable, size: usize, half: usize) -> Self {
        let line = EvenTransform::new(half);
        let mut along = vec![0.0; size * (half + 1)];
        let rows = along.par_chunks_exact_mut(half + 1).enumerate();
        rows.for_each(|(m, row)| line.transform(|n| table.coefficient([m, n]), size, row));
        let mut values = vec![0.0; (half + 1).pow(2)];
        let columns = values.par_chunks_exact_mut(half + 1).enumerate();
        columns.for_each(|(frequency, column)| {
            line.transform(|m| along[m * (half + 1) + frequency], size, column);
        });
        let factor = 1.0 / (4 * half * half) as f64;
        let columns = values.par_chunks_exact_mut(half + 1);
        columns.for_each_init(
            || vec![0.0; half + 1],
            |sorted, column| {
                let evens_and_odds = (0..=half).step_by(2).chain((1..=half).step_by(2));
                for (value, frequency) in sorted.iter_mut().zip(evens_and_odds) {
                    *value = factor * column[frequency];
                }
                column.copy_from_slice(sorted);
            },
        );
        Self { half, values }
    }

    /// The values of column `frequency` at the frequencies 0, 2, 4 … and 1, 3, 5 … up to M.
    pub(crate) fn column(&self, frequency: usize) -> (&[f64], &[f64]) {
        let width = self.half + 1;
        let column = &self.values[frequency * width..(frequency + 1) * width];
        column.split_at(self.half / 2 + 1)
    }
}

/// The real Fourier transform of a sequence that is even with period 2M.
struct EvenTransform {
    half: usize,
    forward: std::sync::Arc<dyn realfft::RealToComplex<f64>>,
}

impl EvenTransform {
    fn new(half: usize) -> Self {
        let forward = RealFftPlanner::new().plan_fft_forward(2 * half);
        Self { half, forward }
    }

    /// Writes the M+1 values for the sequence `entry(0) … entry(length−1)`, 0 beyond, mirrored.
    fn transform(&self, entry: impl Fn(usize) -> f64, length: usize, result: &mut [f64]) {
        let mut sequence = self.forward.make_input_vec();
        for position in 0..length {
            let value = entry(position);
            sequence[position] = value;
            sequence[(2 * self.half - position) % (2 * self.half)] = value;
        }
        let mut transformed = vec![Complex64::default(); self.half + 1];
        let outcome = self.forward.process(&mut sequence, &mut transformed);
        debug_assert!(outcome.is_ok(), "the buffers come from the plan");
        for (value, complex) in result.iter_mut().zip(&transformed) {
            *value = complex.re;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Spectrum;
    use crate::coefficient_table::CoefficientTable;

    #[test]
    fn a_diagonal_matrix_has_a_constant_spectrum() {
        let own = |[m, n]: [usize; 2]| if m + n == 0 { 3.0 } else { 0.0 };
        let table = CoefficientTable::from_fn(1.0, 5, own).unwrap();
        let spectrum = Spectrum::new(&table, 5, 6);
        for frequency in 0..=6 {
            let (even, odd) = spectrum.column(frequency);
            assert_eq!((even.len(), odd.len()), (4, 3));
            for value in even.iter().chain(odd) {
                // Rounding of two transforms of length 12.
                assert!((value * 144.0 - 3.0).abs() < 1e-14);
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
        let found = Spectrum::new(&table, 4, 4).column(0).0[0] * 64.0;
        // Rounding of 49 terms.
        assert!((found - sum).abs() < 1e-14 * sum);
    }
}
