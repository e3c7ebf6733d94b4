//! Multiplication of a real field's Fourier series by a function of the symbol, on the periodic N × N grid.
//!
//! In single precision: the result only preconditions, and seven digits of a direction are more than it needs. The field is
//! scaled to a largest value of 1 first, so that no unit can overflow.

use std::sync::Arc;

use pellicle_influence::PeriodicSymbol;
use rayon::prelude::*;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::{Fft, FftPlanner, num_complex::Complex32};

use crate::vector::by_parts;

/// Columns transformed together: their N values each fit the second-level cache up to N = 4096.
const BLOCK: usize = 16;
/// Rows transformed together by one thread.
const ROWS: usize = 8;

/// Plans, symbol and buffers of the filter for one grid.
pub struct PeriodicFilter {
    size: usize,
    symbol: PeriodicSymbol,
    /// The factor of each frequency of the quarter, and 1/N².
    multipliers: Vec<f32>,
    rows: Arc<dyn RealToComplex<f32>>,
    rows_back: Arc<dyn ComplexToReal<f32>>,
    columns: Arc<dyn Fft<f32>>,
    columns_back: Arc<dyn Fft<f32>>,
    /// N rows of N/2 + 1 coefficients.
    spectrum: Vec<Complex32>,
    /// The same by blocks of columns, each column whole.
    blocks: Vec<Vec<Complex32>>,
}

impl PeriodicFilter {
    pub fn new(symbol: PeriodicSymbol) -> Self {
        let size = symbol.size();
        let half = size / 2 + 1;
        let (mut real, mut complex) = (RealFftPlanner::new(), FftPlanner::new());
        let widths = (0..half)
            .step_by(BLOCK)
            .map(|first| BLOCK.min(half - first));
        Self {
            size,
            multipliers: vec![0.0; half * half],
            rows: real.plan_fft_forward(size),
            rows_back: real.plan_fft_inverse(size),
            columns: complex.plan_fft_forward(size),
            columns_back: complex.plan_fft_inverse(size),
            spectrum: vec![Complex32::default(); size * half],
            blocks: widths
                .map(|width| vec![Complex32::default(); size * width])
                .collect(),
            symbol,
        }
    }

    /// Takes `multiplier(symbol)` as the factor of every frequency from now on; returns the largest, which the results are in units of.
    pub fn multiply_by(&mut self, multiplier: impl Fn(f64) -> f64 + Sync) -> f64 {
        let largest = self
            .symbol
            .quarter()
            .iter()
            .map(|symbol| multiplier(*symbol));
        let largest = largest.fold(0.0, f64::max);
        let scale = 1.0 / (largest * (self.size * self.size) as f64);
        let factors = self.multipliers.par_iter_mut();
        factors
            .zip(self.symbol.quarter())
            .for_each(|(factor, symbol)| *factor = narrow(multiplier(*symbol) * scale));
        largest
    }

    /// `field ← F⁻¹ multiplier F field`, in place; N² values.
    pub fn apply(&mut self, field: &mut [f64], largest_multiplier: f64) {
        let largest = by_parts(field.len(), |part| {
            field[part]
                .iter()
                .fold(0.0, |most: f64, value| most.max(value.abs()))
        });
        let largest = largest.into_iter().fold(0.0, f64::max);
        if largest == 0.0 {
            return;
        }
        self.transform_rows(field, 1.0 / largest);
        self.filter_columns();
        self.restore_rows(field, largest * largest_multiplier);
    }

    fn transform_rows(&mut self, field: &[f64], scale: f64) {
        let (size, half) = (self.size, self.size / 2 + 1);
        let plan = &self.rows;
        let groups = self.spectrum.par_chunks_mut(ROWS * half);
        groups
            .zip(field.par_chunks(ROWS * size))
            .for_each(|(spectrum, field)| {
                let (mut input, mut scratch) = (plan.make_input_vec(), plan.make_scratch_vec());
                for (values, row) in field
                    .chunks_exact(size)
                    .zip(spectrum.chunks_exact_mut(half))
                {
                    for (single, value) in input.iter_mut().zip(values) {
                        *single = narrow(value * scale);
                    }
                    let done = plan.process_with_scratch(&mut input, row, &mut scratch);
                    debug_assert!(done.is_ok(), "buffers have the plan's own lengths");
                }
            });
    }

    /// Transforms the columns, multiplies, transforms back.
    fn filter_columns(&mut self) {
        let (size, half) = (self.size, self.size / 2 + 1);
        let Self {
            spectrum,
            multipliers,
            columns,
            columns_back,
            ..
        } = self;
        let blocks = self.blocks.par_iter_mut().enumerate();
        blocks.for_each(|(index, block)| {
            let (first, width) = (index * BLOCK, block.len() / size);
            for (i, row) in spectrum.chunks_exact(half).enumerate() {
                for (c, value) in row[first..first + width].iter().enumerate() {
                    block[c * size + i] = *value;
                }
            }
            let longest = columns
                .get_inplace_scratch_len()
                .max(columns_back.get_inplace_scratch_len());
            let mut scratch = vec![Complex32::default(); longest];
            columns.process_with_scratch(block, &mut scratch);
            let factors = multipliers.chunks_exact(half).skip(first);
            for (column, factors) in block.chunks_exact_mut(size).zip(factors) {
                for (i, value) in column.iter_mut().enumerate() {
                    *value *= factors[i.min(size - i)];
                }
            }
            columns_back.process_with_scratch(block, &mut scratch);
        });
    }

    fn restore_rows(&mut self, field: &mut [f64], scale: f64) {
        let size = self.size;
        let (plan, blocks) = (&self.rows_back, &self.blocks);
        let groups = field.par_chunks_mut(ROWS * size).enumerate();
        groups.for_each(|(group, field)| {
            let (mut row, mut scratch) = (plan.make_input_vec(), plan.make_scratch_vec());
            let mut output = plan.make_output_vec();
            for (i, values) in (group * ROWS..).zip(field.chunks_exact_mut(size)) {
                let columns = blocks.iter().flat_map(|block| block.chunks_exact(size));
                for (value, column) in row.iter_mut().zip(columns) {
                    *value = column[i];
                }
                // Real up to rounding; the plan wants it exact.
                row[0].im = 0.0;
                if size.is_multiple_of(2) {
                    row[size / 2].im = 0.0;
                }
                let done = plan.process_with_scratch(&mut row, &mut output, &mut scratch);
                debug_assert!(done.is_ok(), "buffers have the plan's own lengths");
                for (value, single) in values.iter_mut().zip(&output) {
                    *value = f64::from(*single) * scale;
                }
            }
        });
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "single precision is what is wanted"
)]
fn narrow(value: f64) -> f32 {
    value as f32
}
