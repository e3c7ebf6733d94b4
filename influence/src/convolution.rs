//! The product `K p` by zero-padded fast Fourier transform.
//!
//! Three passes, none of which touches what is known to be zero or not wanted:
//! 1. the N rows of the pressure, padded to L = 2M, real to complex: N × (M+1) numbers, 16 bytes an element of the grid;
//! 2. the M+1 columns, 16 at a time so that they stay in the cache, see [`crate::column_block`];
//! 3. the N rows back, of which the first N reals are the displacement.
//!
//! Every row and column is computed by itself, so the result has the same bits for every number of threads.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError, RwLock};

use rayon::prelude::*;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex64;

use crate::coefficient_table::CoefficientTable;
use crate::column_block::{ColumnTransform, WIDTH};
use crate::operator::ElasticOperator;
use crate::padding::half_length;
use crate::spectrum::Spectrum;

/// Rows transformed before they are spread over the column blocks: long enough stretches for the memory, few enough for the cache.
const ROWS_AT_ONCE: usize = 8;

/// `u = K p` in O(N² log N), by a zero-padded real FFT, never a periodic one.
///
/// Memory: 8 bytes an element of the grid for the spectrum, 16 for the half-transformed field, and for each thread 600 N bytes of scratch.
/// Accuracy: rounding, some 1e-15 of the largest displacement; within 1e-13 of [`crate::DenseOperator`] (test
/// `both_operators_agree_to_rounding`). Uses the current rayon pool; the result does not depend on it, bit for bit.
pub struct ConvolutionOperator {
    size: usize,
    half: usize,
    spectrum: Spectrum,
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
    columns: ColumnTransform,
    /// Block b holds, row after row, the frequencies 16 b … 16 b + 15 of the transformed rows.
    blocks: Vec<RwLock<Vec<Complex64>>>,
    scratch: Vec<Mutex<Scratch>>,
}

/// What one thread needs beside the shared field.
struct Scratch {
    /// One padded row.
    row: Vec<f64>,
    /// The transforms of [`ROWS_AT_ONCE`] rows.
    transformed: Vec<Complex64>,
    /// The columns of one block.
    columns: Vec<Complex64>,
    /// Space the transforms ask for.
    transform: Vec<Complex64>,
}

impl ConvolutionOperator {
    /// The operator of the grid the table was made for.
    #[must_use]
    pub fn new(table: &CoefficientTable) -> Self {
        Self::windowed(table, table.size())
    }

    /// The operator of a window of `size` × `size` elements of that grid; the coefficients depend on the offset alone.
    ///
    /// # Panics
    /// If `size` is above the table's.
    #[must_use]
    pub fn windowed(table: &CoefficientTable, size: usize) -> Self {
        let half = half_length(size);
        let mut planner = RealFftPlanner::new();
        let forward = planner.plan_fft_forward(2 * half);
        let inverse = planner.plan_fft_inverse(2 * half);
        let columns = ColumnTransform::new(size, half);
        let longest = columns
            .scratch_length()
            .max(forward.get_scratch_len())
            .max(inverse.get_scratch_len());
        let scratch = || Scratch {
            row: vec![0.0; 2 * half],
            transformed: vec![Complex64::default(); ROWS_AT_ONCE * (half + 1)],
            columns: vec![Complex64::default(); columns.buffer_length()],
            transform: vec![Complex64::default(); longest],
        };
        let scratch = (0..rayon::current_num_threads())
            .map(|_| Mutex::new(scratch()))
            .collect();
        Self {
            size,
            half,
            spectrum: Spectrum::new(table, size, half),
            forward,
            inverse,
            columns,
            blocks: empty_blocks(size, half + 1),
            scratch,
        }
    }

    /// Pass 1 for up to [`ROWS_AT_ONCE`] rows, the first of which is `first`.
    fn transform_rows(&self, first: usize, pressure: &[f64]) {
        let mut scratch = self.scratch();
        let scratch = &mut *scratch;
        let rows = scratch.transformed.chunks_exact_mut(self.half + 1);
        for (row, transformed) in pressure.chunks_exact(self.size).zip(rows) {
            scratch.row[..self.size].copy_from_slice(row);
            scratch.row[self.size..].fill(0.0);
            let outcome = self.forward.process_with_scratch(
                &mut scratch.row,
                transformed,
                &mut scratch.transform[..self.forward.get_scratch_len()],
            );
            debug_assert!(outcome.is_ok(), "the lengths are the plan's");
        }
        for (index, block) in self.blocks.iter().enumerate() {
            let mut block = block.write().unwrap_or_else(PoisonError::into_inner);
            let width = block.len() / self.size;
            let rows = block.chunks_exact_mut(width).skip(first);
            let transformed = scratch.transformed.chunks_exact(self.half + 1);
            for (stretch, row) in rows.zip(transformed).take(pressure.len() / self.size) {
                stretch.copy_from_slice(&row[index * WIDTH..index * WIDTH + width]);
            }
        }
    }

    /// Pass 3 for up to [`ROWS_AT_ONCE`] rows, the first of which is `first`.
    fn restore_rows(&self, first: usize, displacement: &mut [f64]) {
        let mut scratch = self.scratch();
        let scratch = &mut *scratch;
        for (index, block) in self.blocks.iter().enumerate() {
            let block = block.read().unwrap_or_else(PoisonError::into_inner);
            let width = block.len() / self.size;
            let rows = block.chunks_exact(width).skip(first);
            let transformed = scratch.transformed.chunks_exact_mut(self.half + 1);
            for (stretch, row) in rows.zip(transformed).take(displacement.len() / self.size) {
                row[index * WIDTH..index * WIDTH + width].copy_from_slice(stretch);
            }
        }
        let rows = scratch.transformed.chunks_exact_mut(self.half + 1);
        for (row, transformed) in displacement.chunks_exact_mut(self.size).zip(rows) {
            // Real up to rounding; the plan wants it exact.
            transformed[0].im = 0.0;
            transformed[self.half].im = 0.0;
            let outcome = self.inverse.process_with_scratch(
                transformed,
                &mut scratch.row,
                &mut scratch.transform[..self.inverse.get_scratch_len()],
            );
            debug_assert!(outcome.is_ok(), "the lengths are the plan's");
            row.copy_from_slice(&scratch.row[..self.size]);
        }
    }

    /// The scratch of the calling thread of the pool.
    fn scratch(&self) -> MutexGuard<'_, Scratch> {
        let thread = rayon::current_thread_index().unwrap_or(0);
        let scratch = &self.scratch[thread % self.scratch.len()];
        scratch.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Pass 2 for every block.
    fn multiply_columns(&mut self) {
        let mut blocks = std::mem::take(&mut self.blocks);
        blocks
            .par_iter_mut()
            .enumerate()
            .for_each(|(index, block)| {
                let mut scratch = self.scratch();
                let Scratch {
                    columns, transform, ..
                } = &mut *scratch;
                let block = block.get_mut().unwrap_or_else(PoisonError::into_inner);
                let spectrum = |column| self.spectrum.column(index * WIDTH + column);
                self.columns.multiply(block, spectrum, columns, transform);
            });
        self.blocks = blocks;
    }
}

/// The blocks of `columns` columns and `rows` rows; the last may be narrower.
fn empty_blocks(rows: usize, columns: usize) -> Vec<RwLock<Vec<Complex64>>> {
    let starts = (0..columns).step_by(WIDTH);
    let widths = starts.map(|start| WIDTH.min(columns - start));
    widths
        .map(|width| RwLock::new(vec![Complex64::default(); rows * width]))
        .collect()
}

impl ElasticOperator for ConvolutionOperator {
    fn size(&self) -> usize {
        self.size
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        let elements = self.size.pow(2);
        assert_eq!(pressure.len(), elements, "pressures of N² elements");
        assert_eq!(displacement.len(), elements, "displacements of N² elements");
        let stretch = ROWS_AT_ONCE * self.size;
        let rows = pressure.par_chunks(stretch).enumerate();
        rows.for_each(|(group, rows)| self.transform_rows(group * ROWS_AT_ONCE, rows));
        self.multiply_columns();
        let rows = displacement.par_chunks_mut(stretch).enumerate();
        rows.for_each(|(group, rows)| self.restore_rows(group * ROWS_AT_ONCE, rows));
    }
}

impl std::fmt::Debug for ConvolutionOperator {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("ConvolutionOperator")
            .field("size", &self.size)
            .field("padded_size", &(2 * self.half))
            .finish_non_exhaustive()
    }
}
