//! The product `K p` by zero-padded fast Fourier transform, from a square of pressures to a square of displacements around it.
//!
//! Three passes, none of which touches what is known to be zero or not wanted:
//! 1. the rows of the pressure, padded to L = 2M, real to complex: M+1 numbers each;
//! 2. the M+1 columns, 16 at a time so that they stay in the cache, see [`crate::column_block`];
//! 3. the rows of the displacement back, of which as many reals are kept as are wanted.
//!
//! Lengths are counted from the first pressure, modulo L: what lies before it stands at the end. M is no less than the largest offset of a
//! displacement from a pressure, so that no offset is taken for another.
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

/// The squares of a convolution.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layout {
    /// Pressures along a side.
    pub loaded: usize,
    /// Displacements along a side.
    pub shown: usize,
    /// Displacements before the first pressure along both axes.
    pub before: [usize; 2],
}

impl Layout {
    /// M: no offset is larger, and the pressures themselves have room.
    fn half(&self) -> usize {
        let reach = |before: usize| (before + self.loaded).max(self.shown - before);
        half_length(reach(self.before[0]).max(reach(self.before[1])))
    }
}

/// Plans, spectrum and buffers of the convolution of one layout.
///
/// Memory: 8 M² bytes for the spectrum, 16 bytes a displacement times M over the side for the half-transformed field, and for each thread 600 M
/// bytes of scratch.
pub(crate) struct Convolution {
    layout: Layout,
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

impl Convolution {
    /// The convolution with the coefficients of `table`, which must reach as far as the layout.
    pub(crate) fn new(table: &CoefficientTable, layout: Layout) -> Self {
        let half = layout.half();
        let mut planner = RealFftPlanner::new();
        let forward = planner.plan_fft_forward(2 * half);
        let inverse = planner.plan_fft_inverse(2 * half);
        let columns = ColumnTransform::new(layout, half);
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
            layout,
            half,
            spectrum: Spectrum::new(table, layout.shown.min(half + 1), half),
            forward,
            inverse,
            columns,
            blocks: empty_blocks(layout.shown, half + 1),
            scratch,
        }
    }

    /// Displacements along a side.
    pub(crate) fn shown(&self) -> usize {
        self.layout.shown
    }

    /// Writes the displacements of the pressures.
    ///
    /// # Panics
    /// If a field has not as many entries as the layout says.
    pub(crate) fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        let Layout { loaded, shown, .. } = self.layout;
        assert_eq!(pressure.len(), loaded.pow(2), "as many pressures");
        assert_eq!(displacement.len(), shown.pow(2), "as many displacements");
        let rows = pressure.par_chunks(ROWS_AT_ONCE * loaded).enumerate();
        rows.for_each(|(group, rows)| self.transform_rows(group * ROWS_AT_ONCE, rows));
        self.multiply_columns();
        let rows = displacement
            .par_chunks_mut(ROWS_AT_ONCE * shown)
            .enumerate();
        rows.for_each(|(group, rows)| self.restore_rows(group * ROWS_AT_ONCE, rows));
    }

    /// Pass 1 for up to [`ROWS_AT_ONCE`] rows, the first of which is `first`.
    fn transform_rows(&self, first: usize, pressure: &[f64]) {
        let mut scratch = self.scratch();
        let scratch = &mut *scratch;
        let Layout { loaded, shown, .. } = self.layout;
        let rows = scratch.transformed.chunks_exact_mut(self.half + 1);
        for (row, transformed) in pressure.chunks_exact(loaded).zip(rows) {
            scratch.row[..loaded].copy_from_slice(row);
            scratch.row[loaded..].fill(0.0);
            let outcome = self.forward.process_with_scratch(
                &mut scratch.row,
                transformed,
                &mut scratch.transform[..self.forward.get_scratch_len()],
            );
            debug_assert!(outcome.is_ok(), "the lengths are the plan's");
        }
        for (index, block) in self.blocks.iter().enumerate() {
            let mut block = block.write().unwrap_or_else(PoisonError::into_inner);
            let width = block.len() / shown;
            let rows = block.chunks_exact_mut(width).skip(first);
            let transformed = scratch.transformed.chunks_exact(self.half + 1);
            for (stretch, row) in rows.zip(transformed).take(pressure.len() / loaded) {
                stretch.copy_from_slice(&row[index * WIDTH..index * WIDTH + width]);
            }
        }
    }

    /// Pass 3 for up to [`ROWS_AT_ONCE`] rows, the first of which is `first`.
    fn restore_rows(&self, first: usize, displacement: &mut [f64]) {
        let mut scratch = self.scratch();
        let scratch = &mut *scratch;
        let Layout {
            shown,
            before: [_, before],
            ..
        } = self.layout;
        for (index, block) in self.blocks.iter().enumerate() {
            let block = block.read().unwrap_or_else(PoisonError::into_inner);
            let width = block.len() / shown;
            let rows = block.chunks_exact(width).skip(first);
            let transformed = scratch.transformed.chunks_exact_mut(self.half + 1);
            for (stretch, row) in rows.zip(transformed).take(displacement.len() / shown) {
                row[index * WIDTH..index * WIDTH + width].copy_from_slice(stretch);
            }
        }
        let rows = scratch.transformed.chunks_exact_mut(self.half + 1);
        for (row, transformed) in displacement.chunks_exact_mut(shown).zip(rows) {
            // Real up to rounding; the plan wants it exact.
            transformed[0].im = 0.0;
            transformed[self.half].im = 0.0;
            let outcome = self.inverse.process_with_scratch(
                transformed,
                &mut scratch.row,
                &mut scratch.transform[..self.inverse.get_scratch_len()],
            );
            debug_assert!(outcome.is_ok(), "the lengths are the plan's");
            let (start, rest) = row.split_at_mut(before);
            start.copy_from_slice(&scratch.row[2 * self.half - before..]);
            rest.copy_from_slice(&scratch.row[..shown - before]);
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
    let width = |index: usize| WIDTH.min(columns - index * WIDTH);
    (0..columns.div_ceil(WIDTH))
        .into_par_iter()
        .map(|index| RwLock::new(vec![Complex64::default(); rows * width(index)]))
        .collect()
}

/// `u = K p` in O(N² log N), by a zero-padded real FFT, never a periodic one.
///
/// Memory: 8 bytes an element of the grid for the spectrum, 16 for the half-transformed field, and for each thread 600 N bytes of scratch.
/// Accuracy: rounding, some 1e-15 of the largest displacement; within 1e-13 of [`crate::DenseOperator`] (test
/// `both_operators_agree_to_rounding`). Uses the current rayon pool; the result does not depend on it, bit for bit.
pub struct ConvolutionOperator(Convolution);

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
        let layout = Layout {
            loaded: size,
            shown: size,
            before: [0, 0],
        };
        Self(Convolution::new(table, layout))
    }
}

impl ElasticOperator for ConvolutionOperator {
    fn size(&self) -> usize {
        self.0.shown()
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.0.apply_into(pressure, displacement);
    }
}

impl std::fmt::Debug for ConvolutionOperator {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("ConvolutionOperator")
            .field("size", &self.0.shown())
            .field("padded_size", &(2 * self.0.half))
            .finish_non_exhaustive()
    }
}
