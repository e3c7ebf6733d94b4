//! Fourier transforms of sequences that are even or odd with period 2M, by complex transforms of length M.
//!
//! Of even sequences they are cosine transforms of type I, of odd ones `−i` times sine transforms of type I:
//!
//! ```text
//! X_k = a_0 + (−1)^k a_M + 2 Σ_(0<j<M) a_j cos(πjk/M),    S_k = 2 Σ_(0<j<M) a_j sin(πjk/M),    k = 0 … M
//! ```
//!
//! With `s_j = a_j + a_(M−j)`, `d_j = a_j − a_(M−j)` and Y the Fourier transform of M numbers y, whose even part in k holds the
//! sums of cosines and whose odd part those of sines,
//!
//! ```text
//! y_j = s_j − 2 sin(πj/M) d_j:     X_2k = ½ (Y_k + Y_(M−k)),      X_(2k+1) = X_(2k−1) + ½i (Y_k − Y_(M−k))
//! y_j = d_j + 2 sin(πj/M) s_j:     S_2k = ½i (Y_k − Y_(M−k)),     S_(2k+1) = S_(2k−1) + ½ (Y_k + Y_(M−k))
//! ```
//!
//! because `2 sin a sin b = cos(a − b) − cos(a + b)` and its like. The recurrences begin with `X_1 = Σ_(j<M) d_j cos(πj/M)` and
//! `S_1 = ½ Y_0`. Two sequences are transformed at a time, as the parts of one complex sequence.

use std::f64::consts::PI;
use std::sync::Arc;

use rustfft::num_complex::Complex64;
use rustfft::{Fft, FftPlanner};

use super::Parity;

/// Lines transformed together; even. Their entries lie side by side in memory and fill one cache line of 64 bytes.
pub(crate) const LINES: usize = 8;

/// Transforms of one length and parity.
pub(crate) struct MirrorTransform {
    /// M.
    half: usize,
    parity: Parity,
    forward: Arc<dyn Fft<f64>>,
    /// `2 sin(πj/M)` and `cos(πj/M)`.
    waves: Vec<[f64; 2]>,
}

/// Buffers for one group of lines.
pub(crate) struct MirrorBuffers {
    /// Pairs of lines, M + 1 numbers each.
    pairs: Vec<Complex64>,
    scratch: Vec<Complex64>,
}

impl MirrorTransform {
    pub(crate) fn new(half: usize, parity: Parity) -> Self {
        let waves = (0..=half / 2).map(|j| {
            let (sin, cos) = (PI * j as f64 / half as f64).sin_cos();
            [2.0 * sin, cos]
        });
        Self {
            half,
            parity,
            forward: FftPlanner::new().plan_fft_forward(half),
            waves: waves.collect(),
        }
    }

    pub(crate) fn buffers(&self) -> MirrorBuffers {
        let zeros = |count: usize| vec![Complex64::default(); count];
        MirrorBuffers {
            pairs: zeros(LINES / 2 * (self.half + 1)),
            scratch: zeros(self.forward.get_inplace_scratch_len()),
        }
    }

    /// Transforms [`LINES`] lines, of which `entries` gives the entries below `length`; the others are 0. Tells the number of each
    /// pair of lines, the frequency and both values.
    pub(crate) fn transform(
        &self,
        length: usize,
        entries: impl Fn(usize) -> [f64; LINES],
        MirrorBuffers { pairs, scratch }: &mut MirrorBuffers,
        mut tell: impl FnMut(usize, usize, Complex64),
    ) {
        let width = self.half + 1;
        for position in 0..length {
            let entries = entries(position);
            let entries = entries.as_chunks::<2>().0.iter();
            let places = pairs[position..].iter_mut().step_by(width);
            places
                .zip(entries)
                .for_each(|(place, [re, im])| *place = Complex64::new(*re, *im));
        }
        for (number, pair) in pairs.chunks_exact_mut(width).enumerate() {
            pair[length..].fill(Complex64::default());
            self.transform_pair(pair, scratch, |frequency, both| {
                tell(number, frequency, both)
            });
        }
    }

    /// Transforms `a_0 … a_M`.
    #[inline]
    fn transform_pair(
        &self,
        line: &mut [Complex64],
        scratch: &mut [Complex64],
        mut tell: impl FnMut(usize, Complex64),
    ) {
        let half = self.half;
        let first = self.fold(line);
        let line = &mut line[..half];
        self.forward.process_with_scratch(line, scratch);
        let mut odd = match self.parity {
            Parity::Even => first,
            Parity::Odd => line[0] / 2.0,
        };
        let zeroth = match self.parity {
            Parity::Even => line[0],
            Parity::Odd => Complex64::ZERO,
        };
        tell(0, zeroth);
        tell(1, odd);
        for k in 1..=half / 2 {
            let (y, partner) = (line[k], line[half - k]);
            let (sum, difference) = ((y + partner) / 2.0, (y - partner) / 2.0);
            // i (x + i y) = −y + i x
            let difference = Complex64::new(-difference.im, difference.re);
            let (even, step) = match self.parity {
                Parity::Even => (sum, difference),
                Parity::Odd => (difference, sum),
            };
            odd += step;
            tell(2 * k, even);
            if 2 * k < half {
                tell(2 * k + 1, odd);
            }
        }
    }

    /// Puts `y_0 … y_(M−1)` in place of `a_0 … a_M`, and gives `X_1`.
    #[inline]
    fn fold(&self, line: &mut [Complex64]) -> Complex64 {
        let half = self.half;
        let (begin, end) = (line[0], line[half]);
        let mut first = begin - end;
        line[0] = match self.parity {
            Parity::Even => begin + end,
            Parity::Odd => Complex64::ZERO,
        };
        for (j, [sine, cosine]) in self.waves.iter().enumerate().skip(1) {
            let (near, far) = (line[j], line[half - j]);
            let (sum, difference) = (near + far, near - far);
            // The cosine at M − j is the opposite, and so is the difference.
            let images = if 2 * j == half { 1.0 } else { 2.0 };
            first += difference * (images * cosine);
            let (even, odd) = match self.parity {
                Parity::Even => (sum, difference * -sine),
                Parity::Odd => (sum * sine, difference),
            };
            line[j] = even + odd;
            line[half - j] = even - odd;
        }
        first
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::{LINES, MirrorTransform, Parity};

    fn entry(line: usize, j: usize) -> f64 {
        ((7 * line + 1) as f64 + 0.37 * j as f64).sin()
    }

    /// Checks the transforms against `wave` of j, k and M, with the weights of the first and last number.
    fn check(parity: Parity, ends: f64, wave: impl Fn(usize, usize, usize) -> f64) {
        for half in [1, 2, 3, 4, 12, 20, 45, 64, 90] {
            for length in [1, half, half + 1] {
                let lines = MirrorTransform::new(half, parity);
                let entries = |j| std::array::from_fn(|line| entry(line, j));
                let mut told = 0;
                lines.transform(length, entries, &mut lines.buffers(), |pair, k, both| {
                    for (line, value) in [(2 * pair, both.re), (2 * pair + 1, both.im)] {
                        let weight = |j: usize| if j == 0 || j == half { ends } else { 2.0 };
                        let terms =
                            (0..length).map(|j| weight(j) * entry(line, j) * wave(j, k, half));
                        // Rounding of up to 91 terms of order 1.
                        let error = (value - terms.sum::<f64>()).abs();
                        assert!(error < 1e-12, "{half} {length} {k}: {error:e}");
                    }
                    told += 1;
                });
                assert_eq!(told, LINES / 2 * (half + 1));
            }
        }
    }

    #[test]
    fn even_sequences_are_transformed_into_their_sums_of_cosines() {
        check(Parity::Even, 1.0, |j, k, half| {
            (PI * (j * k) as f64 / half as f64).cos()
        });
    }

    #[test]
    fn odd_sequences_are_transformed_into_their_sums_of_sines() {
        check(Parity::Odd, 0.0, |j, k, half| {
            (PI * (j * k) as f64 / half as f64).sin()
        });
    }
}
