//! Multiplication of the Fourier series of a field that is its own mirror image in both axes, of which a quadrant is given and wanted.
//!
//! Three passes, as those of the [whole plane](crate::convolution): the rows, two at a time; the columns, two at a time and 32 together so
//! that they stay in the cache; the rows back. All transforms are [cosine transforms](crate::cosine) of length h.
//!
//! A field of period 2h has the whole frequencies alone. For a product that must not wrap around the field is given room to 2h, with the period 4h: its
//! even frequencies are the whole ones of length h and its odd ones the halves, and neither the zeros nor the second half of a line are ever stored.
//! Beyond h the whole ones continue a line evenly and the halves oddly: `y_n = e_n + o_n`, `y_(2h−1−n) = e_n − o_n`.
//!
//! Every row and column is computed with its neighbour, whatever the number of threads, so the result has always the same bits.

use std::sync::{Mutex, MutexGuard, PoisonError, RwLock};

use rayon::prelude::*;
use rustfft::num_complex::Complex;

use crate::cosine::{CosineTransform, Frequencies, Real, place};

/// Pairs of columns in a block.
const WIDTH: usize = 16;
/// Extra numbers between columns, so that the columns of a block do not all fall into one cache set when h is a power of two.
const SKEW: usize = 8;
/// Rows transformed before they are spread over the column blocks; even.
const ROWS_AT_ONCE: usize = 8;

/// Plans and buffers for one size.
pub(crate) struct EvenPlane<T: Real> {
    /// Numbers along a side that are given and that are wanted.
    loaded: usize,
    shown: usize,
    /// h.
    length: usize,
    /// Of whole frequencies, and of halves where there is room.
    transforms: Vec<CosineTransform<T>>,
    /// Block b holds, row after row, the pairs of columns 16 b … 16 b + 15.
    blocks: Vec<RwLock<Vec<Complex<T>>>>,
    scratch: Vec<Mutex<Scratch<T>>>,
}

/// What one thread needs beside the shared field.
struct Scratch<T> {
    /// Transforms of a few rows, two in each line.
    rows: Vec<Complex<T>>,
    /// The columns of one block.
    columns: Vec<Complex<T>>,
    /// Space the transforms ask for.
    transform: Vec<Complex<T>>,
}

/// The factors of a column: those of the whole frequencies, and those of the halves.
pub(crate) type Factors<'a, T> = [&'a [T]; 2];

impl<T: Real> EvenPlane<T> {
    /// For fields of period 2 · `length`, all of which is given and wanted.
    pub(crate) fn periodic(length: usize) -> Self {
        Self::new([length; 2], length, &[Frequencies::Whole])
    }

    /// For fields with room: `loaded` numbers along a side are given and `shown` wanted, no more than 2 · `length` together.
    pub(crate) fn padded(loaded: usize, shown: usize, length: usize) -> Self {
        debug_assert!(loaded <= length && loaded + shown <= 2 * length, "room");
        Self::new(
            [loaded, shown],
            length,
            &[Frequencies::Whole, Frequencies::Half],
        )
    }

    fn new([loaded, shown]: [usize; 2], length: usize, frequencies: &[Frequencies]) -> Self {
        let transforms = frequencies
            .iter()
            .map(|of| CosineTransform::new(length, *of));
        let transforms: Vec<CosineTransform<T>> = transforms.collect();
        let columns = frequencies.len() * length;
        let longest = transforms.iter().map(CosineTransform::scratch_length).max();
        let zeros = |count: usize| vec![Complex::default(); count];
        let scratch = || Scratch {
            rows: zeros(ROWS_AT_ONCE / 2 * columns),
            columns: zeros(WIDTH * transforms.len() * (length + SKEW)),
            transform: zeros(longest.unwrap_or(0)),
        };
        let pairs = columns.div_ceil(2);
        let rows = shown.next_multiple_of(2);
        let block = |index: usize| RwLock::new(zeros(rows * WIDTH.min(pairs - index * WIDTH)));
        Self {
            loaded,
            shown,
            length,
            blocks: (0..pairs.div_ceil(WIDTH))
                .into_par_iter()
                .map(block)
                .collect(),
            scratch: (0..rayon::current_num_threads())
                .map(|_| Mutex::new(scratch()))
                .collect(),
            transforms,
        }
    }

    /// Numbers along a side that are wanted.
    pub(crate) fn shown(&self) -> usize {
        self.shown
    }

    /// h.
    pub(crate) fn length(&self) -> usize {
        self.length
    }

    /// Pass 1: takes a field, times `scale`.
    pub(crate) fn load(&mut self, field: &[f64], scale: f64) {
        assert_eq!(field.len(), self.loaded.pow(2), "as many numbers");
        let groups = field.par_chunks(ROWS_AT_ONCE * self.loaded).enumerate();
        groups.for_each(|(group, rows)| self.transform_rows(group * ROWS_AT_ONCE, rows, scale));
    }

    /// Pass 2: multiplies by the factors of every column. They are to hold the normalisation, `1/(2h)²` of the periodic and `1/(4h)²` of the padded field.
    pub(crate) fn multiply<'a>(&mut self, factors: impl Fn(usize) -> Factors<'a, T> + Sync)
    where
        T: 'a,
    {
        let mut blocks = std::mem::take(&mut self.blocks);
        let of_blocks = blocks.par_iter_mut().enumerate();
        of_blocks.for_each(|(index, block)| {
            let block = block.get_mut().unwrap_or_else(PoisonError::into_inner);
            self.multiply_block(2 * WIDTH * index, block, &factors);
        });
        self.blocks = blocks;
    }

    /// Pass 3: writes the field, times `scale`.
    pub(crate) fn restore(&mut self, field: &mut [f64], scale: f64) {
        assert_eq!(field.len(), self.shown.pow(2), "as many numbers");
        let groups = field.par_chunks_mut(ROWS_AT_ONCE * self.shown).enumerate();
        groups.for_each(|(group, rows)| self.restore_rows(group * ROWS_AT_ONCE, rows, scale));
    }

    /// The frequencies of a row: those of every transform, one after the other.
    fn columns(&self) -> usize {
        self.transforms.len() * self.length
    }

    /// The scratch of the calling thread of the pool.
    fn scratch(&self) -> MutexGuard<'_, Scratch<T>> {
        let thread = rayon::current_thread_index().unwrap_or(0);
        let scratch = &self.scratch[thread % self.scratch.len()];
        scratch.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Pass 1 for up to [`ROWS_AT_ONCE`] rows, the first of which is `first`.
    fn transform_rows(&self, first: usize, field: &[f64], scale: f64) {
        let (length, columns) = (self.length, self.columns());
        let mut scratch = self.scratch();
        let Scratch {
            rows, transform, ..
        } = &mut *scratch;
        let pairs = field.chunks(2 * self.loaded);
        let count = pairs.len();
        for (pair, line) in pairs.zip(rows.chunks_exact_mut(columns)) {
            let (one, other) = pair.split_at(self.loaded);
            for (of, line) in self.transforms.iter().zip(line.chunks_exact_mut(length)) {
                let both = |(x, y): (&f64, &f64)| {
                    Complex::new(T::narrowed(x * scale), T::narrowed(y * scale))
                };
                if other.is_empty() {
                    of.put(line, one.iter().map(|x| both((x, &0.0))));
                } else {
                    of.put(line, one.iter().zip(other).map(both));
                }
                of.analyse(line, transform);
            }
        }
        for (index, block) in self.blocks.iter().enumerate() {
            let mut block = block.write().unwrap_or_else(PoisonError::into_inner);
            let width = self.width(&block);
            let pairs = block[first * width..].chunks_exact_mut(2 * width);
            for (pair, line) in pairs.zip(rows.chunks_exact(columns)).take(count) {
                let (one, other) = pair.split_at_mut(width);
                let line = line[2 * WIDTH * index..].chunks(2);
                for ((one, other), line) in one.iter_mut().zip(other).zip(line) {
                    let next = line.get(1).copied().unwrap_or_default();
                    *one = Complex::new(line[0].re, next.re);
                    *other = Complex::new(line[0].im, next.im);
                }
            }
        }
    }

    /// Pass 2 for one block, the first column of which is `first`.
    fn multiply_block<'a>(
        &self,
        first: usize,
        block: &mut [Complex<T>],
        factors: &impl Fn(usize) -> Factors<'a, T>,
    ) where
        T: 'a,
    {
        let (width, pitch) = (self.width(block), self.length + SKEW);
        let mut scratch = self.scratch();
        let Scratch {
            columns, transform, ..
        } = &mut *scratch;
        let columns = &mut columns[..width * self.transforms.len() * pitch];
        self.gather(block, columns);
        let pairs = columns.chunks_exact_mut(self.transforms.len() * pitch);
        for (index, pair) in pairs.enumerate() {
            let one = first + 2 * index;
            // The last column may have none beside it.
            let other = (one + 1).min(self.columns() - 1);
            let of_both = [factors(one), factors(other)];
            let lines = pair.chunks_exact_mut(pitch).enumerate();
            for ((of, line), transforms) in lines.zip(&self.transforms) {
                let factors = of_both.map(|factors| factors[of]);
                transforms.filter(&mut line[..self.length], factors, transform);
            }
        }
        self.scatter(columns, block);
    }

    /// Copies the loaded part of every pair of columns, once for each transform, to its places.
    fn gather(&self, block: &[Complex<T>], columns: &mut [Complex<T>]) {
        let (width, pitch) = (self.width(block), self.length + SKEW);
        if self.loaded < self.length {
            columns.fill(Complex::default());
        }
        let stride = self.transforms.len() * pitch;
        for (n, row) in block.chunks_exact(width).take(self.loaded).enumerate() {
            let place = place(n, self.length);
            for (index, x) in row.iter().enumerate() {
                columns[index * stride + place] = *x;
            }
            if let Some(halves) = self.transforms.get(1) {
                let turn = halves.turn(n);
                for (index, x) in row.iter().enumerate() {
                    columns[index * stride + pitch + place] = turn * x;
                }
            }
        }
    }

    /// Adds what the transforms of every pair of columns give into the block.
    fn scatter(&self, columns: &[Complex<T>], block: &mut [Complex<T>]) {
        let (width, pitch) = (self.width(block), self.length + SKEW);
        // A row beside the last that nobody wants is still transformed with it.
        block[self.shown * width..].fill(Complex::default());
        let stride = self.transforms.len() * pitch;
        for (row, entries) in block.chunks_exact_mut(width).take(self.shown).enumerate() {
            let (n, side) = self.folded(row);
            let place = place(n, self.length);
            match self.transforms.get(1) {
                None => {
                    for (index, entry) in entries.iter_mut().enumerate() {
                        *entry = columns[index * stride + place];
                    }
                }
                Some(halves) => {
                    let back = halves.turn(n).conj() * side;
                    for (index, entry) in entries.iter_mut().enumerate() {
                        let of_both = &columns[index * stride + place..];
                        *entry = of_both[0] + back * of_both[pitch];
                    }
                }
            }
        }
    }

    /// The number within h that the `n`-th mirrors, and the sign of what the halves give there.
    fn folded(&self, n: usize) -> (usize, T) {
        if n < self.length {
            (n, T::one())
        } else {
            (2 * self.length - 1 - n, -T::one())
        }
    }

    /// Pass 3 for up to [`ROWS_AT_ONCE`] rows, the first of which is `first`.
    fn restore_rows(&self, first: usize, field: &mut [f64], scale: f64) {
        let (length, columns) = (self.length, self.columns());
        let mut scratch = self.scratch();
        let Scratch {
            rows, transform, ..
        } = &mut *scratch;
        for (index, block) in self.blocks.iter().enumerate() {
            let block = block.read().unwrap_or_else(PoisonError::into_inner);
            let width = self.width(&block);
            let pairs = block[first * width..].chunks_exact(2 * width);
            for (pair, line) in pairs.zip(rows.chunks_exact_mut(columns)) {
                let (one, other) = pair.split_at(width);
                let line = line[2 * WIDTH * index..].chunks_mut(2);
                for ((one, other), line) in one.iter().zip(other).zip(line) {
                    line[0] = Complex::new(one.re, other.re);
                    if let Some(next) = line.get_mut(1) {
                        *next = Complex::new(one.im, other.im);
                    }
                }
            }
        }
        let pairs = field.chunks_mut(2 * self.shown);
        for (pair, line) in pairs.zip(rows.chunks_exact_mut(columns)) {
            for (of, line) in self.transforms.iter().zip(line.chunks_exact_mut(length)) {
                of.synthesise(line, transform);
            }
            let (one, other) = pair.split_at_mut(self.shown);
            if other.is_empty() {
                for (n, x) in one.iter_mut().enumerate() {
                    *x = self.number(line, n).re.widened() * scale;
                }
            }
            for (n, (x, y)) in one.iter_mut().zip(other).enumerate() {
                let both = self.number(line, n);
                (*x, *y) = (both.re.widened() * scale, both.im.widened() * scale);
            }
        }
    }

    /// The `n`-th number of a line from what the transforms give.
    fn number(&self, line: &[Complex<T>], n: usize) -> Complex<T> {
        let (n, side) = self.folded(n);
        let place = place(n, self.length);
        match self.transforms.get(1) {
            None => line[place],
            Some(halves) => line[place] + halves.turn(n).conj() * line[self.length + place] * side,
        }
    }

    /// Pairs of columns in a block.
    fn width(&self, block: &[Complex<T>]) -> usize {
        block.len() / self.rows()
    }

    /// Rows of a block: an even number.
    fn rows(&self) -> usize {
        self.shown.next_multiple_of(2)
    }
}

#[cfg(test)]
mod tests {
    use super::EvenPlane;

    fn field(size: usize) -> Vec<f64> {
        (0..size * size).map(|e| (0.37 * e as f64).sin()).collect()
    }

    /// The field at a place of the plane, continued evenly with the period 2 · `size`.
    fn continued(field: &[f64], size: usize, place: [i32; 2]) -> f64 {
        let [i, j] = place.map(|along| {
            let n = usize::try_from(along.rem_euclid(2 * i32::try_from(size).unwrap())).unwrap();
            n.min(2 * size - 1 - n)
        });
        field[i * size + j]
    }

    /// Factors of a filter that is the five-point sum `4 f + f_N + f_S + 2 f_E + 2 f_W`.
    fn of_column(column: f64, row: f64, period: usize) -> f64 {
        let [x, y] = [row, column].map(|k| 2.0 * std::f64::consts::PI * k / period as f64);
        (4.0 + 2.0 * x.cos() + 4.0 * y.cos()) / (period * period) as f64
    }

    #[test]
    fn a_periodic_field_is_filtered_around_its_ends() {
        for size in [1, 2, 3, 8, 9, 30, 67] {
            let mut plane = EvenPlane::<f64>::periodic(size);
            let factors = |column: usize| -> Vec<f64> {
                (0..size)
                    .map(|row| of_column(column as f64, row as f64, 2 * size))
                    .collect()
            };
            let factors: Vec<Vec<f64>> = (0..size).map(factors).collect();
            let mut found = field(size);
            plane.load(&found, 2.0);
            plane.multiply(|column| [&factors[column], &[]]);
            plane.restore(&mut found, 0.5);
            let field = field(size);
            for (e, found) in found.iter().enumerate() {
                let [i, j] = [e / size, e % size].map(|along| i32::try_from(along).unwrap());
                let at = |x: i32, y: i32| continued(&field, size, [i + x, j + y]);
                let expected =
                    4.0 * at(0, 0) + at(1, 0) + at(-1, 0) + 2.0 * at(0, 1) + 2.0 * at(0, -1);
                assert!((found - expected).abs() < 1e-13, "{size} {e}");
            }
        }
    }
}
