//! Multiplication of a real field's Fourier series by a function of the symbol, on the periodic N × N grid.

use std::sync::Arc;

use pellicle_influence::PeriodicSymbol;
use realfft::{
    ComplexToReal, RealFftPlanner, RealToComplex, num_complex::Complex, num_traits::Zero as _,
};
use rustfft::{Fft, FftPlanner};

/// Columns transformed together: their N values each fit the second-level cache up to N = 4096.
const BLOCK: usize = 16;

/// Plans, symbol and buffers of the filter for one grid.
pub struct PeriodicFilter {
    size: usize,
    symbol: PeriodicSymbol,
    rows: Arc<dyn RealToComplex<f64>>,
    rows_back: Arc<dyn ComplexToReal<f64>>,
    columns: Arc<dyn Fft<f64>>,
    columns_back: Arc<dyn Fft<f64>>,
    /// N rows of N/2 + 1 coefficients.
    spectrum: Vec<Complex<f64>>,
    block: Vec<Complex<f64>>,
    row: Vec<f64>,
    scratch: Vec<Complex<f64>>,
}

impl PeriodicFilter {
    pub fn new(symbol: &PeriodicSymbol) -> Self {
        let size = symbol.size();
        let (mut real, mut complex) = (RealFftPlanner::new(), FftPlanner::new());
        let (rows, rows_back) = (real.plan_fft_forward(size), real.plan_fft_inverse(size));
        let (columns, columns_back) = (
            complex.plan_fft_forward(size),
            complex.plan_fft_inverse(size),
        );
        let scratch = [
            rows.get_scratch_len(),
            rows_back.get_scratch_len(),
            columns.get_inplace_scratch_len(),
            columns_back.get_inplace_scratch_len(),
        ];
        Self {
            size,
            symbol: symbol.clone(),
            spectrum: vec![Complex::zero(); size * (size / 2 + 1)],
            block: vec![Complex::zero(); size * BLOCK],
            row: vec![0.0; size],
            scratch: vec![Complex::zero(); scratch.into_iter().max().unwrap_or(0)],
            rows,
            rows_back,
            columns,
            columns_back,
        }
    }

    /// `field ← F⁻¹ multiplier(symbol) F field`, in place; N² values.
    pub fn apply(&mut self, field: &mut [f64], multiplier: impl Fn(f64) -> f64) {
        let (size, half) = (self.size, self.size / 2 + 1);
        for (values, row) in field
            .chunks_exact(size)
            .zip(self.spectrum.chunks_exact_mut(half))
        {
            self.row.copy_from_slice(values);
            let done = self
                .rows
                .process_with_scratch(&mut self.row, row, &mut self.scratch);
            debug_assert!(done.is_ok(), "buffers have the plan's own lengths");
        }
        for first in (0..half).step_by(BLOCK) {
            self.filter_columns(first, BLOCK.min(half - first), &multiplier);
        }
        for (values, row) in field
            .chunks_exact_mut(size)
            .zip(self.spectrum.chunks_exact_mut(half))
        {
            // A real row's first and middle coefficients are real but for rounding.
            row[0].im = 0.0;
            if size % 2 == 0 {
                row[half - 1].im = 0.0;
            }
            let done = self
                .rows_back
                .process_with_scratch(row, values, &mut self.scratch);
            debug_assert!(done.is_ok(), "buffers have the plan's own lengths");
        }
    }

    /// Transforms `count` columns from `first` on, multiplies, transforms back; the factor 1/N² included.
    fn filter_columns(&mut self, first: usize, count: usize, multiplier: &impl Fn(f64) -> f64) {
        let (size, half) = (self.size, self.size / 2 + 1);
        let block = &mut self.block[..count * size];
        for (i, row) in self.spectrum.chunks_exact(half).enumerate() {
            for c in 0..count {
                block[c * size + i] = row[first + c];
            }
        }
        self.columns.process_with_scratch(block, &mut self.scratch);
        let scale = 1.0 / (size * size) as f64;
        let symbols = self.symbol.quarter().chunks_exact(half).skip(first);
        for (column, symbols) in block.chunks_exact_mut(size).zip(symbols) {
            for (i, value) in column.iter_mut().enumerate() {
                *value *= scale * multiplier(symbols[i.min(size - i)]);
            }
        }
        self.columns_back
            .process_with_scratch(block, &mut self.scratch);
        for (i, row) in self.spectrum.chunks_exact_mut(half).enumerate() {
            for c in 0..count {
                row[first + c] = block[c * size + i];
            }
        }
    }
}
