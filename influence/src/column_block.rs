//! The columns of the zero-padded field, a cache-sized block at a time: pad, transform, multiply by the spectrum, invert, keep what is wanted.
//!
//! A column of no more than M numbers, padded to L = 2M, has even frequencies that are the M-point transform of the column itself, and odd ones
//! that are the M-point transform of the column times `exp(−2πi n/L)`. The inverse too splits into an even and an odd half:
//!
//! `y_n = Σ_j Y_2j e^{2πi jn/M} + e^{2πi n/L} Σ_j Y_(2j+1) e^{2πi jn/M}`,
//!
//! and `y_(n+M)` is their difference. So the half of the padded column that is zero is never stored, and never transformed.

use std::sync::Arc;

use rustfft::num_complex::Complex64;
use rustfft::{Fft, FftPlanner};

use crate::convolution::Layout;

/// Columns in a block: 16 complex numbers are four cache lines.
pub(crate) const WIDTH: usize = 16;

/// Extra numbers between columns, so that the columns of a block do not all fall into one cache set when M is a power of two.
const SKEW: usize = 8;

/// The work on the columns of one layout.
pub(crate) struct ColumnTransform {
    layout: Layout,
    half: usize,
    forward: Arc<dyn Fft<f64>>,
    inverse: Arc<dyn Fft<f64>>,
    /// `exp(−2πi n/L)` for n < M.
    twiddles: Vec<Complex64>,
}

impl ColumnTransform {
    /// For columns of the layout's length, padded to twice `half`.
    pub(crate) fn new(layout: Layout, half: usize) -> Self {
        let mut planner = FftPlanner::new();
        let turn = |n: usize| -std::f64::consts::PI * n as f64 / half as f64;
        Self {
            layout,
            half,
            forward: planner.plan_fft_forward(half),
            inverse: planner.plan_fft_inverse(half),
            twiddles: (0..half).map(|n| Complex64::cis(turn(n))).collect(),
        }
    }

    /// Length of the buffer `columns` of [`Self::multiply`].
    pub(crate) fn buffer_length(&self) -> usize {
        2 * WIDTH * self.pitch()
    }

    /// Length of the buffer `scratch` of [`Self::multiply`].
    pub(crate) fn scratch_length(&self) -> usize {
        let forward = self.forward.get_inplace_scratch_len();
        forward.max(self.inverse.get_inplace_scratch_len())
    }

    /// Multiplies the columns of `block` (row after row, as many as are shown, of which the first are loaded) by their spectra, in place: the
    /// values at the even frequencies up to M, and those at the odd ones.
    pub(crate) fn multiply<'a>(
        &self,
        block: &mut [Complex64],
        spectrum: impl Fn(usize) -> (&'a [f64], &'a [f64]),
        columns: &mut [Complex64],
        scratch: &mut [Complex64],
    ) {
        let width = block.len() / self.layout.shown;
        self.gather(block, columns, width);
        for (index, pair) in self.pairs(columns).take(width).enumerate() {
            let (even, odd) = pair.split_at_mut(self.pitch());
            let (of_even, of_odd) = spectrum(index);
            self.filter(&mut even[..self.half], of_even, 1, scratch);
            self.filter(&mut odd[..self.half], of_odd, 0, scratch);
        }
        self.scatter(columns, block, width);
    }

    /// Transforms one half-column, multiplies it by the values, of which those from number `mirror` on come back in reverse order at its end, and
    /// transforms it back.
    fn filter(
        &self,
        column: &mut [Complex64],
        values: &[f64],
        mirror: usize,
        scratch: &mut [Complex64],
    ) {
        self.forward.process_with_scratch(column, scratch);
        let (rising, falling) = column.split_at_mut(values.len());
        for (entry, value) in rising.iter_mut().zip(values) {
            *entry *= value;
        }
        let mirrored = values[mirror..mirror + falling.len()].iter();
        for (entry, value) in falling.iter_mut().rev().zip(mirrored) {
            *entry *= value;
        }
        self.inverse.process_with_scratch(column, scratch);
    }

    /// Copies the loaded part of every column of the block, once as it is and once turned by the twiddles, and pads both.
    fn gather(&self, block: &[Complex64], columns: &mut [Complex64], width: usize) {
        for pair in self.pairs(columns).take(width) {
            let (even, odd) = pair.split_at_mut(self.pitch());
            even[self.layout.loaded..self.half].fill(Complex64::default());
            odd[self.layout.loaded..self.half].fill(Complex64::default());
        }
        let pitch = self.pitch();
        let rows = block.chunks_exact(width).take(self.layout.loaded);
        for ((n, row), twiddle) in rows.enumerate().zip(&self.twiddles) {
            for (index, entry) in row.iter().enumerate() {
                columns[2 * index * pitch + n] = *entry;
                columns[(2 * index + 1) * pitch + n] = entry * twiddle;
            }
        }
    }

    /// Adds the even half and the odd half, turned back, of every column into the block.
    fn scatter(&self, columns: &[Complex64], block: &mut [Complex64], width: usize) {
        let pitch = self.pitch();
        let [before, _] = self.layout.before;
        for (row, entries) in block.chunks_exact_mut(width).enumerate() {
            let place = (row + 2 * self.half - before) % (2 * self.half);
            let n = place % self.half;
            let turn = self.twiddles[n].conj();
            let turn = if place < self.half { turn } else { -turn };
            for (index, entry) in entries.iter_mut().enumerate() {
                let odd = columns[(2 * index + 1) * pitch + n];
                *entry = columns[2 * index * pitch + n] + odd * turn;
            }
        }
    }

    /// The even and the odd half of each column, one behind the other.
    fn pairs<'a>(
        &self,
        columns: &'a mut [Complex64],
    ) -> impl Iterator<Item = &'a mut [Complex64]> + use<'a> {
        columns.chunks_exact_mut(2 * self.pitch())
    }

    fn pitch(&self) -> usize {
        self.half + SKEW
    }
}
