//! Fourier transforms of sequences that are even or odd with period 2M, by complex transforms of length M.
//!
//! For even sequences they are cosine transforms of type I, for odd ones `−i` times sine transforms of type I:
//!
//! ```text
//! X_k = a_0 + (−1)^k a_M + 2 Σ_(0<j<M) a_j cos(πjk/M),    S_k = 2 Σ_(0<j<M) a_j sin(πjk/M),    k = 0 … M
//! ```
//!
//! With `s_j = a_j + a_(M−j)`, `d_j = a_j − a_(M−j)` and Y the Fourier transform of M numbers y, whose even part in k
//! holds the sums of cosines and whose odd part those of sines,
//!
//! ```text
//! y_j = s_j − 2 sin(πj/M) d_j:     X_2k = ½ (Y_k + Y_(M−k)),      X_(2k+1) = X_(2k−1) + ½i (Y_k − Y_(M−k))
//! y_j = d_j + 2 sin(πj/M) s_j:     S_2k = ½i (Y_k − Y_(M−k)),     S_(2k+1) = S_(2k−1) + ½ (Y_k + Y_(M−k))
//! ```
//!
//! because `2 sin a sin b = cos(a − b) − cos(a + b)` and similar identities. The recurrences begin with
//! `X_1 = Σ_(j<M) d_j cos(πj/M)` and `S_1 = ½ Y_0`. Two sequences are transformed at a time, as the parts
//! of one complex sequence.

use std::f64::consts::PI;
use std::sync::Arc;

use pellicle_fourier::Complex64;
use pellicle_fourier::{Fft, Transformed};

use super::Parity;

/// Lines transformed together; even. Their entries are adjacent in memory and fill one cache line of 64 bytes.
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

/// One number of each of the lines.
type Across = [f64; LINES];

/// Number of pairs of lines.
const PAIRS: usize = LINES / 2;

/// Buffers for one group of lines.
pub(crate) struct MirrorBuffers {
    /// `a_0 … a_M`.
    given: Vec<Across>,
    /// The lines in pairs, M numbers each.
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
            forward: f64::forward(half),
            waves: waves.collect(),
        }
    }

    pub(crate) fn buffers(&self) -> MirrorBuffers {
        let zeros = |count: usize| vec![Complex64::default(); count];
        MirrorBuffers {
            given: vec![[0.0; LINES]; self.half + 1],
            pairs: zeros(PAIRS * self.half),
            scratch: zeros(self.forward.get_inplace_scratch_len()),
        }
    }

    /// Transforms [`LINES`] lines, where `entries` gives the entries below `length` and the others are 0. Calls `emit`
    /// with every frequency and the values of all lines.
    pub(crate) fn transform(
        &self,
        length: usize,
        entries: impl Fn(usize) -> Across,
        buffers: &mut MirrorBuffers,
        emit: impl FnMut(usize, Across),
    ) {
        let (given, beyond) = buffers.given.split_at_mut(length);
        for (position, given) in given.iter_mut().enumerate() {
            *given = entries(position);
        }
        beyond.fill([0.0; LINES]);
        match self.parity {
            Parity::Even => self.transform_given::<true>(buffers, emit),
            Parity::Odd => self.transform_given::<false>(buffers, emit),
        }
    }

    fn transform_given<const EVEN: bool>(
        &self,
        MirrorBuffers {
            given,
            pairs,
            scratch,
        }: &mut MirrorBuffers,
        emit: impl FnMut(usize, Across),
    ) {
        let mut chunks = pairs.chunks_exact_mut(self.half);
        let mut lines: [&mut [Complex64]; PAIRS] =
            std::array::from_fn(|_| chunks.next().unwrap_or_default());
        let first = self.fold::<EVEN>(given, &mut lines);
        for line in &mut lines {
            self.forward.process_with_scratch(line, scratch);
        }
        self.unfold::<EVEN>(&lines, first, emit);
    }

    /// Writes `y_0 … y_(M−1)` and returns `X_1`.
    #[inline]
    fn fold<const EVEN: bool>(
        &self,
        given: &[Across],
        lines: &mut [&mut [Complex64]; PAIRS],
    ) -> Across {
        let half = self.half;
        let mut write = |j: usize, values: &Across| {
            for (line, [re, im]) in lines.iter_mut().zip(values.as_chunks::<2>().0) {
                line[j] = Complex64::new(*re, *im);
            }
        };
        let (begin, end) = (&given[0], &given[half]);
        let mut first = across(begin, end, |a, b| a - b);
        write(
            0,
            &across(begin, end, |a, b| if EVEN { a + b } else { 0.0 }),
        );
        for (j, [sine, cosine]) in self.waves.iter().enumerate().skip(1) {
            let (near, far) = (&given[j], &given[half - j]);
            let (sum, difference) = (
                across(near, far, |a, b| a + b),
                across(near, far, |a, b| a - b),
            );
            if EVEN {
                // The cosine at M − j has the opposite sign, and so has the difference.
                let weight = if 2 * j == half { 1.0 } else { 2.0 } * cosine;
                first = across(&first, &difference, |first, d| first + weight * d);
                write(j, &across(&sum, &difference, |s, d| s - sine * d));
                write(half - j, &across(&sum, &difference, |s, d| s + sine * d));
            } else {
                write(half - j, &across(&sum, &difference, |s, d| sine * s - d));
                write(j, &across(&sum, &difference, |s, d| sine * s + d));
            }
        }
        first
    }

    /// Calls `emit` with the transforms of the lines, computed from those of y.
    #[inline]
    fn unfold<const EVEN: bool>(
        &self,
        lines: &[&mut [Complex64]; PAIRS],
        first: Across,
        mut emit: impl FnMut(usize, Across),
    ) {
        let half = self.half;
        let zeroth = side_by_side(|pair| lines[pair][0]);
        let mut odd = if EVEN { first } else { zeroth.map(|y| y / 2.0) };
        emit(0, if EVEN { zeroth } else { [0.0; LINES] });
        emit(1, odd);
        for k in 1..=half / 2 {
            let sum = side_by_side(|pair| (lines[pair][k] + lines[pair][half - k]) * 0.5);
            let difference = side_by_side(|pair| {
                let difference = (lines[pair][k] - lines[pair][half - k]) * 0.5;
                // i (x + i y) = −y + i x
                Complex64::new(-difference.im, difference.re)
            });
            let (even, step) = if EVEN {
                (sum, difference)
            } else {
                (difference, sum)
            };
            odd = across(&odd, &step, |odd, step| odd + step);
            emit(2 * k, even);
            if 2 * k < half {
                emit(2 * k + 1, odd);
            }
        }
    }
}

/// A rule applied to the numbers of each line.
#[inline]
fn across(one: &Across, other: &Across, rule: impl Fn(f64, f64) -> f64) -> Across {
    std::array::from_fn(|i| rule(one[i], other[i]))
}

/// The numbers of the lines from those of their pairs.
#[inline]
fn side_by_side(of_pair: impl Fn(usize) -> Complex64) -> Across {
    let mut values = [0.0; LINES];
    for (pair, [re, im]) in values.as_chunks_mut::<2>().0.iter_mut().enumerate() {
        let both = of_pair(pair);
        (*re, *im) = (both.re, both.im);
    }
    values
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::{MirrorTransform, Parity};

    fn entry(line: usize, j: usize) -> f64 {
        ((7 * line + 1) as f64 + 0.37 * j as f64).sin()
    }

    /// Checks the transforms against `wave` of j, k and M, with the weights of the first and last number.
    fn check(parity: Parity, ends: f64, wave: impl Fn(usize, usize, usize) -> f64) {
        for half in [1, 2, 3, 4, 12, 20, 45, 64, 90] {
            for length in [1, half, half + 1] {
                let lines = MirrorTransform::new(half, parity);
                let entries = |j| std::array::from_fn(|line| entry(line, j));
                let mut calls = 0;
                lines.transform(length, entries, &mut lines.buffers(), |k, values| {
                    for (line, value) in values.into_iter().enumerate() {
                        let weight = |j: usize| if j == 0 || j == half { ends } else { 2.0 };
                        let terms =
                            (0..length).map(|j| weight(j) * entry(line, j) * wave(j, k, half));
                        // Rounding of up to 91 terms of order 1.
                        let error = (value - terms.sum::<f64>()).abs();
                        assert!(error < 1e-12, "{half} {length} {k}: {error:e}");
                    }
                    calls += 1;
                });
                assert_eq!(calls, half + 1);
            }
        }
    }

    #[test]
    fn transforms_of_even_sequences_equal_their_cosine_sums() {
        check(Parity::Even, 1.0, |j, k, half| {
            (PI * (j * k) as f64 / half as f64).cos()
        });
    }

    #[test]
    fn transforms_of_odd_sequences_equal_their_sine_sums() {
        check(Parity::Odd, 0.0, |j, k, half| {
            (PI * (j * k) as f64 / half as f64).sin()
        });
    }
}
