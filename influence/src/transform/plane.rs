//! Multiplication of the Fourier series of a field, a block of columns at a time so that each block stays in
//! the cache.
//!
//! There are three passes, none of which touches a number that is known to be zero or not wanted:
//! 1. the rows are transformed;
//! 2. the columns are transformed, multiplied and transformed back, 16 complex numbers wide;
//! 3. the rows are transformed back.
//!
//! [`Lines`] defines the transforms. Every row and every column is computed by itself, or with the same neighbour, so
//! the result has the same bits for every number of threads.

use std::sync::{Mutex, MutexGuard, PoisonError, RwLock};

use pellicle_fourier::Complex;
use rayon::prelude::*;

use super::Parity;
use super::lines::{Columns, Factors, Lines, ROWS, Space};

/// Number of complex numbers of a row in a block: four cache lines in double precision.
const WIDTH: usize = 16;

/// Extra numbers between columns, so that the columns of a block do not all map to one cache set when their
/// length is a power of two.
const SKEW: usize = 8;

/// Numbers of which either none is wanted or all are looked at.
const TOGETHER: usize = 8;

/// Plans and buffers for one size.
pub(crate) struct PlaneTransform<L: Lines> {
    lines: L,
    /// Block b holds, row by row, the numbers 16 b … 16 b + 15 of the transformed rows; the last may be narrower.
    blocks: Vec<RwLock<Vec<Complex<L::Real>>>>,
    scratch: Vec<Mutex<Scratch<L::Real>>>,
}

/// The buffers of one thread in addition to the shared field.
struct Scratch<T> {
    /// The transforms of [`ROWS`] rows.
    rows: Vec<Complex<T>>,
    /// The numbers of as many rows, of which only some are wanted.
    shown: Vec<f64>,
    /// The columns of one block; the parts of each are stored one after the other.
    columns: Vec<Complex<T>>,
    space: Space<T>,
}

/// The transform of a field in both directions, from which several products are computed.
pub(crate) struct PlaneSpectrum {
    /// The columns of each block; the parts of each column are stored one after the other.
    blocks: Vec<Vec<Complex<f64>>>,
}

impl<L: Lines> PlaneTransform<L> {
    pub(crate) fn new(lines: L) -> Self {
        let zeros = |count: usize| vec![Complex::default(); count];
        let scratch = || Scratch {
            rows: zeros(ROWS * lines.width()),
            shown: Vec::new(),
            columns: zeros(WIDTH * lines.columns().parts() * (lines.columns().length() + SKEW)),
            space: lines.space(),
        };
        let scratch = (0..rayon::current_num_threads()).map(|_| Mutex::new(scratch()));
        let width = |index: usize| WIDTH.min(lines.width() - index * WIDTH);
        let blocks = (0..lines.width().div_ceil(WIDTH)).into_par_iter();
        let [rows, _] = lines.shown();
        let block = |index: usize| RwLock::new(zeros(rows * width(index)));
        Self {
            blocks: blocks.map(block).collect(),
            scratch: scratch.collect(),
            lines,
        }
    }

    pub(crate) fn lines(&self) -> &L {
        &self.lines
    }

    /// Pass 1: loads a field, times `scale`.
    ///
    /// # Panics
    /// If the field does not have as many numbers as the lines require.
    pub(crate) fn load(&mut self, field: &[f64], scale: f64) {
        let [rows, loaded] = self.lines.loaded();
        assert_eq!(field.len(), rows * loaded, "as many numbers are given");
        let groups = field.par_chunks(ROWS * loaded).enumerate();
        groups.for_each(|(group, rows)| self.transform_rows(group * ROWS, rows, scale));
    }

    /// Pass 2: multiplies by the factors of every frequency along the rows. They include the normalisation: the forward
    /// and backward transforms multiply a field by the number of elements of its period.
    pub(crate) fn multiply<'a>(&mut self, factors: impl Fn(usize) -> Factors<'a, L::Real> + Sync)
    where
        L::Real: 'a,
    {
        let mut blocks = std::mem::take(&mut self.blocks);
        let of_blocks = blocks.par_iter_mut().enumerate();
        of_blocks.for_each(|(index, block)| {
            let block = block.get_mut().unwrap_or_else(PoisonError::into_inner);
            self.multiply_block(index * WIDTH, block, &factors);
        });
        self.blocks = blocks;
    }

    /// Pass 3: writes the field, times `scale`.
    ///
    /// # Panics
    /// If the field does not have as many numbers as the lines require.
    pub(crate) fn restore(&mut self, field: &mut [f64], scale: f64) {
        self.restore_with(Parity::Even, field, scale);
    }

    /// [`Self::restore`] for rows of a parity; see [`Lines::restore_rows`].
    ///
    /// # Panics
    /// As [`Self::restore`].
    pub(crate) fn restore_with(&mut self, parity: Parity, field: &mut [f64], scale: f64) {
        let [rows, shown] = self.lines.shown();
        assert_eq!(field.len(), rows * shown, "as many numbers are wanted");
        let groups = field.par_chunks_mut(ROWS * shown).enumerate();
        groups.for_each(|(group, rows)| self.restore_rows(group * ROWS, parity, rows, scale));
    }

    /// [`Self::restore`] where `wanted` holds; the other numbers of the field are left as they are.
    ///
    /// # Panics
    /// As [`Self::restore`].
    pub(crate) fn restore_where(&mut self, wanted: &[bool], field: &mut [f64], scale: f64) {
        let [rows, shown] = self.lines.shown();
        assert_eq!(field.len(), rows * shown, "as many numbers are wanted");
        let wanted = wanted.par_chunks(ROWS * shown);
        let groups = field.par_chunks_mut(ROWS * shown).zip(wanted).enumerate();
        groups.for_each(|(group, (rows, wanted))| {
            if !wanted.contains(&true) {
                return;
            }
            let mut numbers = std::mem::take(&mut self.scratch().shown);
            numbers.resize(rows.len(), 0.0);
            self.restore_rows(group * ROWS, Parity::Even, &mut numbers, scale);
            copy_where(wanted, &numbers, rows);
            self.scratch().shown = numbers;
        });
    }

    /// The scratch of the calling thread of the pool.
    fn scratch(&self) -> MutexGuard<'_, Scratch<L::Real>> {
        let thread = rayon::current_thread_index().unwrap_or(0);
        let scratch = &self.scratch[thread % self.scratch.len()];
        scratch.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Pass 1 for up to [`ROWS`] rows, from the row `first`.
    fn transform_rows(&self, first: usize, field: &[f64], scale: f64) {
        let mut scratch = self.scratch();
        let Scratch { rows, space, .. } = &mut *scratch;
        let count = field.len() / self.lines.loaded()[1];
        let rows = &mut rows[..count * self.lines.width()];
        if field.iter().all(|value| *value == 0.0) {
            rows.fill(Complex::default());
        } else {
            self.lines.transform_rows(field, scale, rows, space);
        }
        for (index, block) in self.blocks.iter().enumerate() {
            let mut block = block.write().unwrap_or_else(PoisonError::into_inner);
            let width = self.width_of(block.len());
            let stretches = block[first * width..].chunks_exact_mut(width);
            for (stretch, row) in stretches.zip(rows.chunks_exact(self.lines.width())) {
                stretch.copy_from_slice(&row[index * WIDTH..index * WIDTH + width]);
            }
        }
    }

    /// Pass 3 for up to [`ROWS`] rows, from the row `first`.
    fn restore_rows(&self, first: usize, parity: Parity, field: &mut [f64], scale: f64) {
        let mut scratch = self.scratch();
        let Scratch { rows, space, .. } = &mut *scratch;
        let count = field.len() / self.lines.shown()[1];
        let rows = &mut rows[..count * self.lines.width()];
        for (index, block) in self.blocks.iter().enumerate() {
            let block = block.read().unwrap_or_else(PoisonError::into_inner);
            let width = self.width_of(block.len());
            let stretches = block[first * width..].chunks_exact(width);
            for (stretch, row) in stretches.zip(rows.chunks_exact_mut(self.lines.width())) {
                row[index * WIDTH..index * WIDTH + width].copy_from_slice(stretch);
            }
        }
        self.lines.restore_rows(rows, parity, field, scale, space);
    }

    /// Pass 2 for one block, from the column `first`.
    fn multiply_block<'a>(
        &self,
        first: usize,
        block: &mut [Complex<L::Real>],
        factors: &impl Fn(usize) -> Factors<'a, L::Real>,
    ) where
        L::Real: 'a,
    {
        let mut scratch = self.scratch();
        let Scratch { columns, space, .. } = &mut *scratch;
        let width = self.width_of(block.len());
        let columns = &mut columns[..width * self.stride()];
        self.gather(block, columns);
        for (index, parts) in columns.chunks_exact_mut(self.stride()).enumerate() {
            for (part, column) in parts.chunks_exact_mut(self.pitch()).enumerate() {
                let column = &mut column[..self.lines.columns().length()];
                let which = [first + index, part];
                self.lines.filter(which, column, factors, space);
            }
        }
        self.scatter(columns, block);
    }

    /// Copies the given numbers of every column of the block into each part, and pads them.
    fn gather(&self, block: &[Complex<L::Real>], columns: &mut [Complex<L::Real>]) {
        let (pitch, stride) = (self.pitch(), self.stride());
        for part in columns.chunks_exact_mut(pitch) {
            part[self.lines.columns().padding()].fill(Complex::default());
        }
        let rows = block.chunks_exact(columns.len() / stride);
        for (n, row) in rows.take(self.lines.loaded()[0]).enumerate() {
            let place = self.lines.columns().place(n);
            for (column, x) in columns[place..].iter_mut().step_by(stride).zip(row) {
                *column = *x;
            }
            if self.lines.columns().parts() == 2 {
                let turn = self.lines.columns().turn(n);
                let turned = columns[pitch + place..].iter_mut().step_by(stride);
                turned.zip(row).for_each(|(column, x)| *column = turn * x);
            }
        }
    }

    /// Adds the parts of every column into the block, at the wanted numbers.
    fn scatter(&self, columns: &[Complex<L::Real>], block: &mut [Complex<L::Real>]) {
        let (pitch, stride) = (self.pitch(), self.stride());
        let rows = block.chunks_exact_mut(columns.len() / stride);
        for (row, entries) in rows.enumerate() {
            let (n, sign) = self.lines.columns().folded(row);
            let columns = &columns[self.lines.columns().place(n)..];
            if self.lines.columns().parts() == 2 {
                let back = self.lines.columns().turn(n).conj() * sign;
                for (index, entry) in entries.iter_mut().enumerate() {
                    *entry = columns[index * stride] + back * columns[index * stride + pitch];
                }
            } else {
                let columns = columns.iter().step_by(stride);
                entries
                    .iter_mut()
                    .zip(columns)
                    .for_each(|(entry, x)| *entry = *x);
            }
        }
    }

    /// Numbers per row of a block with `numbers` in total.
    fn width_of(&self, numbers: usize) -> usize {
        numbers / self.lines.shown()[0]
    }

    /// Numbers from one part of a column to the next.
    fn pitch(&self) -> usize {
        self.lines.columns().length() + SKEW
    }

    /// Numbers from one column to the next.
    fn stride(&self) -> usize {
        self.lines.columns().parts() * self.pitch()
    }
}

/// Copies the numbers that are wanted, few or many.
fn copy_where(wanted: &[bool], from: &[f64], to: &mut [f64]) {
    let copy = |(to, (from, wanted)): (&mut f64, (&f64, &bool))| {
        *to = if *wanted { *from } else { *to };
    };
    let (wanted, wanted_rest) = wanted.as_chunks::<TOGETHER>();
    let (from, from_rest) = from.as_chunks::<TOGETHER>();
    let (to, to_rest) = to.as_chunks_mut::<TOGETHER>();
    for ((wanted, from), to) in wanted.iter().zip(from).zip(to) {
        if *wanted != [false; TOGETHER] {
            to.iter_mut().zip(from.iter().zip(wanted)).for_each(copy);
        }
    }
    let rest = to_rest.iter_mut().zip(from_rest.iter().zip(wanted_rest));
    rest.for_each(copy);
}

impl<L: Lines<Real = f64>> PlaneTransform<L> {
    /// The first half of pass 2: the transforms of all columns.
    pub(crate) fn spectrum(&self) -> PlaneSpectrum {
        let of_block = |block: &RwLock<Vec<Complex<f64>>>| {
            let block = block.read().unwrap_or_else(PoisonError::into_inner);
            let width = self.width_of(block.len());
            let mut columns = vec![Complex::default(); width * self.stride()];
            self.gather(&block, &mut columns);
            let mut scratch = self.scratch();
            for (number, column) in columns.chunks_exact_mut(self.pitch()).enumerate() {
                let column = &mut column[..self.lines.columns().length()];
                let part = number % self.lines.columns().parts();
                self.lines
                    .columns()
                    .transform(part, column, &mut scratch.space);
            }
            columns
        };
        PlaneSpectrum {
            blocks: self.blocks.par_iter().map(of_block).collect(),
        }
    }

    /// The second half of pass 2: the product of a spectrum with factors. `weigh` writes the product of each column,
    /// given its number along the rows and its part. The columns are transformed back with this parity.
    pub(crate) fn take_product(
        &mut self,
        spectrum: &PlaneSpectrum,
        parity: Parity,
        weigh: impl Fn(&L, [usize; 2], &[Complex<f64>], &mut [Complex<f64>]) + Sync,
    ) {
        let mut blocks = std::mem::take(&mut self.blocks);
        let of_blocks = blocks.par_iter_mut().zip(&spectrum.blocks).enumerate();
        of_blocks.for_each(|(index, (block, transformed))| {
            let block = block.get_mut().unwrap_or_else(PoisonError::into_inner);
            let mut scratch = self.scratch();
            let Scratch { columns, space, .. } = &mut *scratch;
            let columns = &mut columns[..transformed.len()];
            let both = columns.chunks_exact_mut(self.pitch());
            let both = both.zip(transformed.chunks_exact(self.pitch()));
            for (number, (column, from)) in both.enumerate() {
                let column = &mut column[..self.lines.columns().length()];
                let part = number % self.lines.columns().parts();
                let which = [index * WIDTH + number / self.lines.columns().parts(), part];
                weigh(
                    &self.lines,
                    which,
                    &from[..self.lines.columns().length()],
                    column,
                );
                self.lines.columns().restore(part, parity, column, space);
            }
            self.scatter(columns, block);
        });
        self.blocks = blocks;
    }
}
