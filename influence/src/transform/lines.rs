//! The rows and columns of a field for the [plane transform](super::plane): how they continue beyond their ends, and
//! how they are transformed.

use std::ops::Range;

use pellicle_fourier::Complex;
use pellicle_fourier::Transformed;

use super::Parity;

/// A type of number for the transforms of fields.
pub(crate) trait Real: Transformed + Default {
    fn narrowed(value: f64) -> Self;
    fn widened(self) -> f64;
}

impl Real for f64 {
    fn narrowed(value: f64) -> Self {
        value
    }

    fn widened(self) -> f64 {
        self
    }
}

impl Real for f32 {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "preconditioners are applied in single precision"
    )]
    fn narrowed(value: f64) -> Self {
        value as Self
    }

    fn widened(self) -> f64 {
        self.into()
    }
}

/// The factors of a column by frequency: those of its first part, and those of the second if there is one.
pub(crate) type Factors<'a, T> = [&'a [T]; 2];

/// The rows and columns of a field, which is given and wanted from its first corner.
pub(crate) trait Lines: Sync {
    type Real: Real;
    type Columns: Columns<Real = Self::Real>;

    fn columns(&self) -> &Self::Columns;

    /// Number of given rows, and of numbers in each.
    fn loaded(&self) -> [usize; 2];

    /// Number of wanted rows, and of numbers in each; at least as many.
    fn shown(&self) -> [usize; 2];

    /// Number of complex numbers in a transformed row. Each belongs to one column or, as its real and
    /// imaginary part, to two.
    fn width(&self) -> usize;

    /// Buffers for the other functions.
    fn space(&self) -> Space<Self::Real>;

    /// Transforms up to [`ROWS`] rows, times `scale`.
    fn transform_rows(
        &self,
        field: &[f64],
        scale: f64,
        rows: &mut [Complex<Self::Real>],
        space: &mut Space<Self::Real>,
    );

    /// Transforms up to [`ROWS`] rows back and keeps the wanted numbers, times `scale`.
    ///
    /// Where mirror images continue the rows, they do so with this parity. The number n of an odd row is returned
    /// with the sign `(−1)ⁿ`.
    fn restore_rows(
        &self,
        rows: &mut [Complex<Self::Real>],
        parity: Parity,
        field: &mut [f64],
        scale: f64,
        space: &mut Space<Self::Real>,
    );

    /// Transforms one part of the column or columns `index`, multiplies it by its factors, and transforms it back.
    fn filter<'a>(
        &self,
        index_and_part: [usize; 2],
        column: &mut [Complex<Self::Real>],
        factors: &impl Fn(usize) -> Factors<'a, Self::Real>,
        space: &mut Space<Self::Real>,
    ) where
        Self::Real: 'a;
}

/// The columns of a field.
///
/// A column of a periodic field is transformed in one part. A column padded to twice its length is transformed in two:
/// at the even frequencies of the padded column, which are those of the column itself, and at the odd ones, which are
/// those of the column turned by a phase. The padding is neither stored nor transformed.
pub(crate) trait Columns: Sync {
    type Real: Real;

    /// Number of complex numbers in one part of a column.
    fn length(&self) -> usize;

    /// Number of parts of a column, 1 or 2.
    fn parts(&self) -> usize;

    /// The place of the `n`-th number in each part.
    fn place(&self, n: usize) -> usize {
        n
    }

    /// The places without a given number.
    fn padding(&self) -> Range<usize>;

    /// The phase of the `n`-th number in the second part.
    fn turn(&self, n: usize) -> Complex<Self::Real>;

    /// The number below [`Self::length`] that stands for the `n`-th wanted one, and the sign of the second part there.
    fn folded(&self, n: usize) -> (usize, Self::Real);

    /// Transforms one part of a column.
    fn transform(
        &self,
        part: usize,
        column: &mut [Complex<Self::Real>],
        space: &mut Space<Self::Real>,
    );

    /// Transforms one part of a column of this parity back; see [`Lines::restore_rows`].
    fn restore(
        &self,
        part: usize,
        parity: Parity,
        column: &mut [Complex<Self::Real>],
        space: &mut Space<Self::Real>,
    );
}

/// Number of rows transformed at once: enough for long stretches of each block in memory, few enough
/// for the cache; even.
pub(crate) const ROWS: usize = 8;

/// Buffers of one thread.
pub(crate) struct Space<T> {
    /// One padded row of real numbers.
    pub reals: Vec<T>,
    /// The transforms of two rows at once.
    pub pair: Vec<Complex<T>>,
    /// Scratch that the transforms need.
    pub transform: Vec<Complex<T>>,
}
