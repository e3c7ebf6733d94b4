//! Multiplication of a real field's Fourier series on the periodic N × N grid, in single precision.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError, RwLock};

use rayon::prelude::*;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::{Fft, FftPlanner, num_complex::Complex32};

/// Columns transformed together: their N values each fit the second-level cache up to N = 4096.
const BLOCK: usize = 16;
/// Extra numbers between columns, so that they do not all fall into one cache set where N is a power of two.
const SKEW: usize = 8;
/// Rows transformed together by one thread.
const ROWS: usize = 8;

/// Plans, multipliers and buffers of the filter for one grid.
pub struct PlaneFilter {
    size: usize,
    /// The factor of each frequency of the quarter, and 1/N².
    multipliers: Vec<f32>,
    rows: Arc<dyn RealToComplex<f32>>,
    rows_back: Arc<dyn ComplexToReal<f32>>,
    columns: Arc<dyn Fft<f32>>,
    columns_back: Arc<dyn Fft<f32>>,
    /// Block b holds, row after row, the frequencies 16 b … 16 b + 15 of the transformed rows.
    blocks: Vec<RwLock<Vec<Complex32>>>,
    scratch: Vec<Mutex<Scratch>>,
}

/// What one thread needs beside the shared field.
struct Scratch {
    /// One row.
    row: Vec<f32>,
    /// The transforms of [`ROWS`] rows.
    transformed: Vec<Complex32>,
    /// The columns of one block, one after the other.
    columns: Vec<Complex32>,
    /// Space the transforms ask for.
    transform: Vec<Complex32>,
}

impl PlaneFilter {
    /// For N elements per side; multiplies by 0 until it is told by what.
    pub fn new(size: usize) -> Self {
        let half = size / 2 + 1;
        let (mut real, mut complex) = (RealFftPlanner::new(), FftPlanner::new());
        let (rows, rows_back) = (real.plan_fft_forward(size), real.plan_fft_inverse(size));
        let columns = complex.plan_fft_forward(size);
        let columns_back = complex.plan_fft_inverse(size);
        let along_rows = rows.get_scratch_len().max(rows_back.get_scratch_len());
        let along_columns = columns
            .get_inplace_scratch_len()
            .max(columns_back.get_inplace_scratch_len());
        let scratch = || Scratch {
            row: vec![0.0; size],
            transformed: vec![Complex32::default(); ROWS * half],
            columns: vec![Complex32::default(); BLOCK * (size + SKEW)],
            transform: vec![Complex32::default(); along_rows.max(along_columns)],
        };
        let widths = (0..half)
            .step_by(BLOCK)
            .map(|first| BLOCK.min(half - first));
        Self {
            size,
            multipliers: vec![0.0; half * half],
            rows,
            rows_back,
            columns,
            columns_back,
            blocks: widths
                .map(|width| RwLock::new(vec![Complex32::default(); size * width]))
                .collect(),
            scratch: (0..rayon::current_num_threads())
                .map(|_| Mutex::new(scratch()))
                .collect(),
        }
    }

    /// The scratch of the calling thread of the pool.
    fn scratch(&self) -> MutexGuard<'_, Scratch> {
        let thread = rayon::current_thread_index().unwrap_or(0);
        let scratch = &self.scratch[thread % self.scratch.len()];
        scratch.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Takes `multiplier(i, j)` as the factor of the frequencies i and j along the axes, each 0 … N/2, from now on.
    pub fn multiply_by(&mut self, multiplier: impl Fn([usize; 2]) -> f32 + Sync) {
        let half = self.size / 2 + 1;
        let scale = 1.0 / (self.size * self.size) as f32;
        let columns = self.multipliers.par_chunks_exact_mut(half).enumerate();
        columns.for_each(|(i, factors)| {
            for (j, factor) in factors.iter_mut().enumerate() {
                *factor = scale * multiplier([i, j]);
            }
        });
    }

    /// `field ← F⁻¹ multiplier F field`, in place, scaled by `scale` on the way in and by `scale_back` on the way out; N² values.
    pub fn apply(&mut self, field: &mut [f64], scale: f64, scale_back: f64) {
        let groups = field.par_chunks(ROWS * self.size).enumerate();
        groups.for_each(|(group, rows)| self.transform_rows(group * ROWS, rows, scale));
        self.filter_columns();
        let groups = field.par_chunks_mut(ROWS * self.size).enumerate();
        groups.for_each(|(group, rows)| self.restore_rows(group * ROWS, rows, scale_back));
    }

    /// Transforms up to [`ROWS`] rows, the first of which is `first`.
    fn transform_rows(&self, first: usize, field: &[f64], scale: f64) {
        let (size, half) = (self.size, self.size / 2 + 1);
        let mut scratch = self.scratch();
        let scratch = &mut *scratch;
        let rows = scratch.transformed.chunks_exact_mut(half);
        for (values, transformed) in field.chunks_exact(size).zip(rows) {
            for (single, value) in scratch.row.iter_mut().zip(values) {
                *single = narrow(value * scale);
            }
            let space = &mut scratch.transform[..self.rows.get_scratch_len()];
            let done = (self.rows).process_with_scratch(&mut scratch.row, transformed, space);
            debug_assert!(done.is_ok(), "buffers have the plan's own lengths");
        }
        for (index, block) in self.blocks.iter().enumerate() {
            let mut block = block.write().unwrap_or_else(PoisonError::into_inner);
            let width = block.len() / size;
            let rows = block.chunks_exact_mut(width).skip(first);
            let transformed = scratch.transformed.chunks_exact(half);
            for (stretch, row) in rows.zip(transformed).take(field.len() / size) {
                stretch.copy_from_slice(&row[index * BLOCK..index * BLOCK + width]);
            }
        }
    }

    /// Transforms the columns, multiplies, transforms back.
    fn filter_columns(&mut self) {
        let mut blocks = std::mem::take(&mut self.blocks);
        let of_blocks = blocks.par_iter_mut().enumerate();
        of_blocks.for_each(|(index, block)| {
            let block = block.get_mut().unwrap_or_else(PoisonError::into_inner);
            self.filter_block(index * BLOCK, block);
        });
        self.blocks = blocks;
    }

    /// The same for the columns of one block, the first of which has the frequency `first`.
    fn filter_block(&self, first: usize, block: &mut [Complex32]) {
        let (size, half) = (self.size, self.size / 2 + 1);
        let (width, pitch) = (block.len() / size, size + SKEW);
        let mut scratch = self.scratch();
        let Scratch {
            columns, transform, ..
        } = &mut *scratch;
        for (i, row) in block.chunks_exact(width).enumerate() {
            for (c, value) in row.iter().enumerate() {
                columns[c * pitch + i] = *value;
            }
        }
        let factors = self.multipliers.chunks_exact(half).skip(first);
        let of_columns = columns.chunks_exact_mut(pitch).zip(factors);
        for (column, factors) in of_columns.take(width) {
            let column = &mut column[..size];
            self.columns.process_with_scratch(column, transform);
            let (rising, falling) = column.split_at_mut(half);
            let mirrored = factors[1..=size - half].iter().rev();
            let pairs = rising.iter_mut().zip(factors);
            let pairs = pairs.chain(falling.iter_mut().zip(mirrored));
            pairs.for_each(|(value, factor)| *value *= factor);
            self.columns_back.process_with_scratch(column, transform);
        }
        for (i, row) in block.chunks_exact_mut(width).enumerate() {
            for (c, value) in row.iter_mut().enumerate() {
                *value = columns[c * pitch + i];
            }
        }
    }

    /// Transforms up to [`ROWS`] rows back, the first of which is `first`.
    fn restore_rows(&self, first: usize, field: &mut [f64], scale: f64) {
        let (size, half) = (self.size, self.size / 2 + 1);
        let mut scratch = self.scratch();
        let scratch = &mut *scratch;
        for (index, block) in self.blocks.iter().enumerate() {
            let block = block.read().unwrap_or_else(PoisonError::into_inner);
            let width = block.len() / size;
            let rows = block.chunks_exact(width).skip(first);
            let transformed = scratch.transformed.chunks_exact_mut(half);
            for (stretch, row) in rows.zip(transformed).take(field.len() / size) {
                row[index * BLOCK..index * BLOCK + width].copy_from_slice(stretch);
            }
        }
        let rows = scratch.transformed.chunks_exact_mut(half);
        for (values, transformed) in field.chunks_exact_mut(size).zip(rows) {
            // Real up to rounding; the plan wants it exact.
            transformed[0].im = 0.0;
            if size.is_multiple_of(2) {
                transformed[size / 2].im = 0.0;
            }
            let space = &mut scratch.transform[..self.rows_back.get_scratch_len()];
            let done = (self.rows_back).process_with_scratch(transformed, &mut scratch.row, space);
            debug_assert!(done.is_ok(), "buffers have the plan's own lengths");
            for (value, single) in values.iter_mut().zip(&scratch.row) {
                *value = f64::from(*single) * scale;
            }
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "single precision is what is wanted"
)]
fn narrow(value: f64) -> f32 {
    value as f32
}
