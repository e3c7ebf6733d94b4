//! Eigenvalues of the circulant in which a matrix of coefficients that depend on the offset alone is embedded.
//!
//! The coefficients of all offsets up to M − 1 or M, extended to L × L = 2M × 2M and zero where none is needed, are a
//! circulant whose product with a zero-padded pressure is exactly that of the matrix. Coefficients that are even in
//! both offsets have a real, even spectrum; along an axis in which they are odd it is odd, and times `−i`. A quarter of
//! real numbers determines it.

use std::sync::Arc;

use rayon::prelude::*;
use rustfft::num_complex::Complex64;
use rustfft::{Fft, FftPlanner};

use crate::coefficient_table::CoefficientTable;
use crate::transform::Parity;
use crate::transform::cosine::{self, CosineTransform, Frequencies};

/// Lines transformed together; even. Their entries lie side by side in memory and fill one cache line of 64 bytes.
const LINES: usize = 8;

/// A quarter, (M+1) × (M+1) values, of the L × L spectrum, without its factor `−i` for each axis of odd parity.
#[derive(Clone, Debug)]
pub(crate) struct Spectrum {
    /// M, half the padded length.
    half: usize,
    /// Column after column, of each those at even frequencies before those at odd ones.
    values: Vec<f64>,
}

impl Spectrum {
    /// The spectrum of the coefficients of `size` × `size` offsets, no more than `half` + 1 along a side, embedded
    /// in 2`half` × 2`half`. It is divided by the number of padded elements, the factor of an unnormalised forward
    /// and inverse transform.
    pub(crate) fn new(table: &CoefficientTable, size: usize, half: usize) -> Self {
        let coefficients = |first: usize, n: usize| table.side_by_side(first, n);
        Self::of_offsets(coefficients, [Parity::Even; 2], size, half)
    }

    /// The spectrum of `size` × `size` coefficients of these parities along x and y, those of the offset (m, n) being
    /// the entry `m size + n`.
    pub(crate) fn of_quarter(
        quarter: &[f64],
        parities: [Parity; 2],
        size: usize,
        half: usize,
    ) -> Self {
        let coefficients = |first: usize, n: usize| {
            std::array::from_fn(|i| {
                let entry = quarter.get((first + i) * size + n);
                entry.copied().unwrap_or_default()
            })
        };
        Self::of_offsets(coefficients, parities, size, half)
    }

    /// The spectrum of coefficients that are given for offsets side by side along x and one along y.
    fn of_offsets(
        coefficients: impl Fn(usize, usize) -> [f64; LINES] + Sync,
        [parity_x, parity_y]: [Parity; 2],
        size: usize,
        half: usize,
    ) -> Self {
        let lines = MirrorTransform::new(half, parity_y);
        let along = lines.transform(size, size, coefficients, |frequency| frequency);
        let lines = MirrorTransform::new(half, parity_x);
        let entries = |first: usize, m: usize| {
            let line = &along[m * (half + 1)..(m + 1) * (half + 1)];
            match line[first..].first_chunk() {
                Some(entries) => *entries,
                None => std::array::from_fn(|i| line.get(first + i).copied().unwrap_or(0.0)),
            }
        };
        let mut values = lines.transform(half + 1, size, entries, |frequency| {
            // Even frequencies before odd ones.
            frequency / 2 + frequency % 2 * (half / 2 + 1)
        });
        let factor = 1.0 / (4 * half * half) as f64;
        values.par_iter_mut().for_each(|value| *value *= factor);
        Self { half, values }
    }

    /// The values of column `frequency` at the frequencies 0, 2, 4 … and 1, 3, 5 … up to M.
    pub(crate) fn column(&self, frequency: usize) -> [&[f64]; 2] {
        let width = self.half + 1;
        let column = &self.values[frequency * width..(frequency + 1) * width];
        let (even, odd) = column.split_at(self.half / 2 + 1);
        [even, odd]
    }
}

/// The Fourier transform of sequences that are even or odd with period 2M. Of even ones it is a cosine transform of
/// type I:
///
/// ```text
/// X_k = a_0 + (−1)^k a_M + 2 Σ_(0<j<M) a_j cos(πjk/M),    k = 0 … M
/// ```
///
/// As long as M is even, it falls into two of half the length: at odd frequencies a transform of type III of
/// `a_j − a_(M−j)`, and at even ones that of type I of `a_j + a_(M−j)`. The rest is of odd length, or short, and is
/// transformed as it stands. Two sequences are transformed at a time, as the parts of one complex sequence: half
/// the work of real transforms of the whole period.
///
/// Of odd ones it is `−i` times a sine transform of type I, `2 Σ_(0<j<M) a_j sin(πjk/M)`, by the transform of the whole
/// period.
struct MirrorTransform {
    half: usize,
    parity: Parity,
    /// Of M/2, M/4 … numbers.
    folded: Vec<CosineTransform<f64>>,
    /// Of the period that is left.
    rest: Arc<dyn Fft<f64>>,
}

impl MirrorTransform {
    fn new(half: usize, parity: Parity) -> Self {
        let halvings = match parity {
            Parity::Even => half.trailing_zeros(),
            Parity::Odd => 0,
        };
        let folded = (1..=halvings).map(|halving| half >> halving);
        let folded = folded.map(|length| CosineTransform::new(length, Frequencies::Whole));
        Self {
            half,
            parity,
            folded: folded.collect(),
            rest: FftPlanner::new().plan_fft_forward(2 * (half >> halvings)),
        }
    }

    /// The M+1 values of each of `count` lines, each frequency at its place. `entries(first, j)` gives entry j,
    /// below `length`, of the line `first` and those after it; lines from `count` on may hold anything. Entries
    /// from `length` on are 0, and the line is mirrored.
    fn transform(
        &self,
        count: usize,
        length: usize,
        entries: impl Fn(usize, usize) -> [f64; LINES] + Sync,
        place: impl Fn(usize) -> usize + Sync,
    ) -> Vec<f64> {
        let width = self.half + 1;
        let mut results = vec![0.0; count * width];
        let groups = results.par_chunks_mut(LINES * width).enumerate();
        groups.for_each_init(
            || self.buffers(),
            |(pairs, buffers), (group, results)| {
                for position in 0..length {
                    let entries = entries(group * LINES, position);
                    let entries = entries.as_chunks::<2>().0.iter();
                    let pairs = pairs[position..].iter_mut().step_by(width);
                    pairs
                        .zip(entries)
                        .for_each(|(pair, [re, im])| *pair = Complex64::new(*re, *im));
                }
                let results = results.chunks_mut(2 * width);
                for (pair, results) in pairs.chunks_exact_mut(width).zip(results) {
                    pair[length..].fill(Complex64::default());
                    let (of_one, of_other) = results.split_at_mut(width);
                    self.transform_pair(pair, buffers, |frequency, both| {
                        let place = place(frequency);
                        of_one[place] = both.re;
                        if let Some(value) = of_other.get_mut(place) {
                            *value = both.im;
                        }
                    });
                }
            },
        );
        results
    }

    /// Transforms `a_0 … a_M`, and tells every value with its frequency.
    fn transform_pair(
        &self,
        line: &mut [Complex64],
        LineBuffers { sequence, scratch }: &mut LineBuffers,
        mut tell: impl FnMut(usize, Complex64),
    ) {
        let (mut half, mut step) = (self.half, 1);
        for odd in &self.folded {
            let folded = half / 2;
            let differences = &mut sequence[..folded];
            let (near, far) = line[..=half].split_at_mut(folded);
            let ends = near.iter_mut().zip(far.iter().rev());
            for (difference, (near, far)) in differences.iter_mut().zip(ends) {
                (*difference, *near) = (*near - far, *near + far);
            }
            far[0] += far[0];
            odd.synthesise(differences, scratch);
            for k in 0..folded {
                tell((2 * k + 1) * step, differences[cosine::place(k, folded)]);
            }
            (half, step) = (folded, 2 * step);
        }
        let period = &mut sequence[..2 * half];
        period[..=half].copy_from_slice(&line[..=half]);
        let (image, phase) = match self.parity {
            Parity::Even => (1.0, Complex64::ONE),
            Parity::Odd => {
                (period[0], period[half]) = (Complex64::ZERO, Complex64::ZERO);
                (-1.0, Complex64::I)
            }
        };
        for j in 1..half {
            period[2 * half - j] = image * line[j];
        }
        self.rest.process_with_scratch(period, scratch);
        for (k, value) in period[..=half].iter().enumerate() {
            tell(k * step, phase * value);
        }
    }

    /// A few pairs of lines, and the buffers of their transforms.
    fn buffers(&self) -> (Vec<Complex64>, LineBuffers) {
        let folded = self.folded.iter().map(CosineTransform::scratch_length);
        let scratch = folded.fold(self.rest.get_inplace_scratch_len(), usize::max);
        let zeros = |count: usize| vec![Complex64::default(); count];
        let buffers = LineBuffers {
            sequence: zeros(2 * self.half),
            scratch: zeros(scratch),
        };
        (zeros(LINES / 2 * (self.half + 1)), buffers)
    }
}

/// Buffers for one pair of lines.
struct LineBuffers {
    /// The sequence under way.
    sequence: Vec<Complex64>,
    scratch: Vec<Complex64>,
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::{LINES, MirrorTransform, Parity, Spectrum};
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
    fn even_sequences_are_transformed_into_their_sums_of_cosines() {
        for half in [1, 2, 3, 4, 12, 20, 45, 64, 90] {
            for length in [1, half, half + 1] {
                let entry = |i: usize, j: usize| ((7 * i + 1) as f64 + 0.37 * j as f64).sin();
                let entries = |first, j| std::array::from_fn(|i| entry(first + i, j));
                // A whole group, and another that ends in half a pair.
                let count = LINES + 3;
                let found = MirrorTransform::new(half, Parity::Even).transform(
                    count,
                    length,
                    entries,
                    |k| k,
                );
                for (index, value) in found.iter().enumerate() {
                    let (line, k) = (index / (half + 1), index % (half + 1));
                    let wave = |j: usize| (PI * (j * k) as f64 / half as f64).cos();
                    let images = |j: usize| if j == 0 || j == half { 1.0 } else { 2.0 };
                    let terms = (0..length).map(|j| images(j) * entry(line, j) * wave(j));
                    // Rounding of up to 91 terms of order 1.
                    assert!(
                        (value - terms.sum::<f64>()).abs() < 1e-12,
                        "{half} {length} {k}"
                    );
                }
            }
        }
    }

    #[test]
    fn odd_sequences_are_transformed_into_their_sums_of_sines() {
        for half in [1, 2, 5, 12] {
            let entry = |i: usize, j: usize| ((7 * i + 1) as f64 + 0.37 * j as f64).sin();
            let entries = |first, j| std::array::from_fn(|i| entry(first + i, j));
            let lines = MirrorTransform::new(half, Parity::Odd);
            let found = lines.transform(3, half + 1, entries, |k| k);
            for (index, value) in found.iter().enumerate() {
                let (line, k) = (index / (half + 1), index % (half + 1));
                let wave = |j: usize| 2.0 * (PI * (j * k) as f64 / half as f64).sin();
                let sum: f64 = (1..half).map(|j| entry(line, j) * wave(j)).sum();
                assert!((value - sum).abs() < 1e-13, "{half} {k}");
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
