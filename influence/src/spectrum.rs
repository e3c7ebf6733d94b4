//! Eigenvalues of the circulant in which the matrix of influence coefficients is embedded.
//!
//! The coefficients of all offsets up to M − 1 or M, extended evenly to L × L = 2M × 2M and zero where none is needed, are a
//! circulant whose product with a zero-padded pressure is exactly K p. Its spectrum is real and even: a quarter determines it.

use rayon::prelude::*;
use realfft::RealFftPlanner;
use rustfft::num_complex::Complex64;

use crate::coefficient_table::CoefficientTable;

/// Lines transformed together.
const LINES: usize = 8;

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
        let lines = EvenTransform::new(half);
        let coefficient = |[m, n]: [usize; 2]| table.coefficient([m, n]);
        let along = lines.transform(size, size, coefficient, |frequency| frequency);
        let entry = |[frequency, m]: [usize; 2]| along[m * (half + 1) + frequency];
        let mut values = lines.transform(half + 1, size, entry, |frequency| {
            // Even frequencies before odd ones.
            frequency / 2 + frequency % 2 * (half / 2 + 1)
        });
        let factor = 1.0 / (4 * half * half) as f64;
        values.par_iter_mut().for_each(|value| *value *= factor);
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

    /// The M+1 values of each of `count` lines, of which line i begins with `entry([i, 0])` … `entry([i, length−1])`, is 0 beyond and is mirrored; each
    /// frequency at its place.
    ///
    /// A few lines are taken together, because their entries lie side by side in the memory.
    fn transform(
        &self,
        count: usize,
        length: usize,
        entry: impl Fn([usize; 2]) -> f64 + Sync,
        place: impl Fn(usize) -> usize + Sync,
    ) -> Vec<f64> {
        let (period, width) = (2 * self.half, self.half + 1);
        let mut results = vec![0.0; count * width];
        let groups = results.par_chunks_mut(LINES * width).enumerate();
        groups.for_each_init(
            || Buffers {
                lines: vec![0.0; LINES * period],
                transformed: self.forward.make_output_vec(),
                scratch: self.forward.make_scratch_vec(),
            },
            |buffers, (group, results)| {
                let Buffers {
                    lines,
                    transformed,
                    scratch,
                } = buffers;
                lines.fill(0.0);
                let first = group * LINES;
                let indices = first..(first + LINES).min(count);
                for position in 0..length {
                    for (line, index) in lines.chunks_exact_mut(period).zip(indices.clone()) {
                        line[position] = entry([index, position]);
                    }
                }
                let results = results.chunks_exact_mut(width);
                for (line, result) in lines.chunks_exact_mut(period).zip(results) {
                    let (rising, falling) = line.split_at_mut(width);
                    let mirrored = rising[1..length.min(self.half)].iter();
                    for (to, value) in falling.iter_mut().rev().zip(mirrored) {
                        *to = *value;
                    }
                    let outcome = self
                        .forward
                        .process_with_scratch(line, transformed, scratch);
                    debug_assert!(outcome.is_ok(), "the buffers come from the plan");
                    for (frequency, value) in transformed.iter().enumerate() {
                        result[place(frequency)] = value.re;
                    }
                }
            },
        );
        results
    }
}

/// What one thread needs.
struct Buffers {
    lines: Vec<f64>,
    transformed: Vec<Complex64>,
    scratch: Vec<Complex64>,
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
