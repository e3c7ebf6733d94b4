//! Lines of real numbers that are zero beyond their ends, or periodic, by real and complex fast Fourier transforms.
//!
//! A column of no more than M numbers, padded to L = 2M, has even frequencies that are the M-point transform of the
//! column itself, and odd ones that are the M-point transform of the column times `exp(−2πi n/L)`. The inverse also
//! splits into an even and an odd half:
//!
//! `y_n = Σ_j Y_2j e^{2πi jn/M} + e^{2πi n/L} Σ_j Y_(2j+1) e^{2πi jn/M}`,
//!
//! and `y_(n+M)` is their difference.

use std::f64::consts::PI;
use std::ops::Range;
use std::sync::Arc;

use pellicle_fourier::{Complex, ComplexToReal, Fft, RealToComplex};

use super::Parity;
use super::lines::{Columns, Factors, Lines, Real, Space};

/// Plans for fields of one size.
pub(crate) struct FourierLines<T: Real> {
    loaded: usize,
    shown: usize,
    /// How many numbers of a row are wanted before the first given one. They stand at the end of the padded row.
    before: usize,
    rows: Arc<dyn RealToComplex<T>>,
    rows_back: Arc<dyn ComplexToReal<T>>,
    columns: FourierColumns<T>,
}

/// Plans for the columns alone.
pub(crate) struct FourierColumns<T: Real> {
    loaded: usize,
    shown: usize,
    /// How many numbers are wanted before the first given one, as for rows.
    before: usize,
    /// L, the length of a column with its padding.
    period: usize,
    forward: Arc<dyn Fft<T>>,
    back: Arc<dyn Fft<T>>,
    /// `exp(−2πi n/L)` for n < M; empty for a periodic field.
    turns: Vec<Complex<T>>,
}

impl<T: Real> FourierColumns<T> {
    /// Plans for columns of period `length`, all of which is given and wanted.
    pub(crate) fn periodic(length: usize) -> Self {
        Self::new([length; 2], 0, [length; 2])
    }

    /// Plans for columns padded to 2 · `length`: `loaded` numbers are given, `shown` wanted, of which
    /// `before` precede them.
    pub(crate) fn padded(loaded: usize, shown: usize, before: usize, length: usize) -> Self {
        Self::new([loaded, shown], before, [2 * length, length])
    }

    fn new([loaded, shown]: [usize; 2], before: usize, [period, length]: [usize; 2]) -> Self {
        let turn = |n: usize| {
            let turned = Complex::cis(-PI * n as f64 / length as f64);
            Complex::new(T::narrowed(turned.re), T::narrowed(turned.im))
        };
        let turned = if period == length { 0 } else { length };
        Self {
            loaded,
            shown,
            before,
            period,
            forward: T::forward(length),
            back: T::inverse(length),
            turns: (0..turned).map(turn).collect(),
        }
    }

    pub(crate) fn loaded(&self) -> usize {
        self.loaded
    }

    pub(crate) fn shown(&self) -> usize {
        self.shown
    }

    /// Length of the scratch that the transforms need.
    pub(crate) fn scratch_length(&self) -> usize {
        let forward = self.forward.get_inplace_scratch_len();
        forward.max(self.back.get_inplace_scratch_len())
    }

    /// The transform of one part of a column.
    pub(crate) fn analyse(&self, column: &mut [Complex<T>], space: &mut Space<T>) {
        self.forward
            .process_with_scratch(column, &mut space.transform);
    }

    /// The backward transform of one part of a column.
    pub(crate) fn synthesise(&self, column: &mut [Complex<T>], space: &mut Space<T>) {
        self.back.process_with_scratch(column, &mut space.transform);
    }
}

impl<T: Real> Columns for FourierColumns<T> {
    type Real = T;

    fn length(&self) -> usize {
        self.forward.len()
    }

    fn parts(&self) -> usize {
        self.period / self.length()
    }

    fn padding(&self) -> Range<usize> {
        self.loaded..self.length()
    }

    fn turn(&self, n: usize) -> Complex<T> {
        self.turns[n]
    }

    fn folded(&self, n: usize) -> (usize, T) {
        let place = (n + self.period - self.before) % self.period;
        if place < self.length() {
            (place, T::one())
        } else {
            (place - self.length(), -T::one())
        }
    }

    fn transform(&self, _: usize, column: &mut [Complex<T>], space: &mut Space<T>) {
        self.analyse(column, space);
    }

    fn restore(&self, _: usize, _: Parity, column: &mut [Complex<T>], space: &mut Space<T>) {
        self.synthesise(column, space);
    }
}

impl<T: Real> FourierLines<T> {
    /// Plans for fields of `columns` numbers in each of `rows`, which repeat; all are given and wanted.
    pub(crate) fn periodic([rows, columns]: [usize; 2]) -> Self {
        let along_columns = FourierColumns::periodic(rows);
        Self::of([columns; 2], [0, columns], along_columns)
    }

    /// Plans for fields padded to 2 · `length`: `loaded` numbers along a side are given, `shown` wanted, of which
    /// `before` precede them.
    pub(crate) fn padded(loaded: usize, shown: usize, before: [usize; 2], length: usize) -> Self {
        Self::new([loaded, shown], before, [2 * length, length])
    }

    fn new(numbers: [usize; 2], [above, before]: [usize; 2], lengths: [usize; 2]) -> Self {
        let columns = FourierColumns::new(numbers, above, lengths);
        Self::of(numbers, [before, lengths[0]], columns)
    }

    /// Plans for rows of this period, with those for the columns.
    fn of(
        [loaded, shown]: [usize; 2],
        [before, period]: [usize; 2],
        columns: FourierColumns<T>,
    ) -> Self {
        Self {
            loaded,
            shown,
            before,
            rows: T::real_forward(period),
            rows_back: T::real_inverse(period),
            columns,
        }
    }

    /// Length of a row with its padding.
    fn period(&self) -> usize {
        self.rows.len()
    }
}

impl<T: Real> Lines for FourierLines<T> {
    type Real = T;
    type Columns = FourierColumns<T>;

    fn columns(&self) -> &FourierColumns<T> {
        &self.columns
    }

    fn loaded(&self) -> [usize; 2] {
        [self.columns.loaded(), self.loaded]
    }

    fn shown(&self) -> [usize; 2] {
        [self.columns.shown(), self.shown]
    }

    fn width(&self) -> usize {
        self.period() / 2 + 1
    }

    fn space(&self) -> Space<T> {
        let along_rows = self
            .rows
            .get_scratch_len()
            .max(self.rows_back.get_scratch_len());
        let longest = along_rows.max(self.columns.scratch_length());
        Space {
            reals: vec![T::default(); self.period()],
            pair: Vec::new(),
            transform: vec![Complex::default(); longest],
        }
    }

    fn transform_rows(
        &self,
        field: &[f64],
        scale: f64,
        rows: &mut [Complex<T>],
        space: &mut Space<T>,
    ) {
        let Space {
            reals, transform, ..
        } = space;
        let transform = &mut transform[..self.rows.get_scratch_len()];
        let rows = rows.chunks_exact_mut(self.width());
        for (values, row) in field.chunks_exact(self.loaded).zip(rows) {
            let (given, padding) = reals.split_at_mut(self.loaded);
            for (number, value) in given.iter_mut().zip(values) {
                *number = T::narrowed(value * scale);
            }
            padding.fill(T::default());
            let outcome = self.rows.process_with_scratch(reals, row, transform);
            assert!(outcome.is_ok(), "the lengths are the plan's");
        }
    }

    fn restore_rows(
        &self,
        rows: &mut [Complex<T>],
        _: Parity,
        field: &mut [f64],
        scale: f64,
        space: &mut Space<T>,
    ) {
        let Space {
            reals, transform, ..
        } = space;
        let transform = &mut transform[..self.rows_back.get_scratch_len()];
        let (before, period) = (self.before, self.period());
        let rows = rows.chunks_exact_mut(self.width());
        for (values, row) in field.chunks_exact_mut(self.shown).zip(rows) {
            // Real up to rounding; the plan requires an exact zero.
            row[0].im = T::default();
            if period.is_multiple_of(2) {
                row[period / 2].im = T::default();
            }
            let outcome = self.rows_back.process_with_scratch(row, reals, transform);
            assert!(outcome.is_ok(), "the lengths are the plan's");
            let (preceding, others) = values.split_at_mut(before);
            let parts = [(preceding, &reals[period - before..]), (others, &*reals)];
            for (values, numbers) in parts {
                for (value, number) in values.iter_mut().zip(numbers) {
                    *value = number.widened() * scale;
                }
            }
        }
    }

    fn filter<'a>(
        &self,
        [index, part]: [usize; 2],
        column: &mut [Complex<T>],
        factors: &impl Fn(usize) -> Factors<'a, T>,
        space: &mut Space<T>,
    ) where
        T: 'a,
    {
        let factors = factors(index)[part];
        self.columns.analyse(column, space);
        let (rising, falling) = column.split_at_mut(factors.len());
        for (entry, factor) in rising.iter_mut().zip(factors) {
            *entry = *entry * factor;
        }
        // The frequency 0 has no mirror image and is in the first part.
        let mirrored = factors[1 - part..][..falling.len()].iter();
        for (entry, factor) in falling.iter_mut().zip(mirrored.rev()) {
            *entry = *entry * factor;
        }
        self.columns.synthesise(column, space);
    }
}
