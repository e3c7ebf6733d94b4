//! Lines continued by their mirror image, of which one half is given and wanted, by cosine transforms of length h.
//!
//! A field of period 2h has only the whole frequencies. For a product that must not wrap around, the field is padded to
//! 2h, with the period 4h: its even frequencies are the whole ones of length h and its odd ones the halves. Beyond h
//! the whole ones continue a line evenly and the halves oddly: `y_n = e_n + o_n`, `y_(2h−1−n) = e_n − o_n`.
//!
//! Rows are transformed two at a time, as the real and imaginary parts of one complex line, and so are columns.

use std::ops::Range;

use pellicle_fourier::Complex;

use super::Parity;
use super::cosine::{CosineTransform, Frequencies, place};
use super::lines::{Columns, Factors, Lines, Real, Space};

/// Plans for fields of one size.
pub(crate) struct EvenLines<T: Real> {
    loaded: usize,
    shown: usize,
    /// h.
    length: usize,
    /// For the whole frequencies and, for padded fields, the halves.
    transforms: Vec<CosineTransform<T>>,
}

impl<T: Real> EvenLines<T> {
    /// Plans for fields of period 2 · `length`, half of which is given and wanted.
    pub(crate) fn periodic(length: usize) -> Self {
        let transforms = vec![CosineTransform::new(length, Frequencies::Whole)];
        Self {
            loaded: length,
            shown: length,
            length,
            transforms,
        }
    }

    /// Plans for padded fields: `loaded` numbers along a side are given and `shown` wanted, together at
    /// most 2 · `length`.
    pub(crate) fn padded(loaded: usize, shown: usize, length: usize) -> Self {
        assert!(loaded <= length && loaded + shown <= 2 * length, "room");
        let transforms = [Frequencies::Whole, Frequencies::Half];
        Self {
            loaded,
            shown,
            length,
            transforms: transforms.map(|of| CosineTransform::new(length, of)).into(),
        }
    }

    /// Number of real frequencies of a row, those of all transforms together.
    fn frequencies_of_a_row(&self) -> usize {
        self.parts() * self.length
    }

    /// The frequency of a column in the period of the field: even ones, then odd ones.
    fn frequency(&self, column: usize) -> usize {
        if column < self.length {
            self.parts() * column
        } else {
            2 * (column - self.length) + 1
        }
    }

    /// The frequencies of the two columns in the column `index` of complex numbers.
    pub(crate) fn frequencies(&self, index: usize) -> [usize; 2] {
        let one = 2 * index;
        // The last column may have no neighbour.
        [one, (one + 1).min(self.frequencies_of_a_row() - 1)].map(|column| self.frequency(column))
    }

    /// The `n`-th wanted number of a pair of rows.
    fn number(&self, pair: &[Complex<T>], n: usize) -> Complex<T> {
        let (n, sign) = self.folded(n);
        let place = place(n, self.length);
        match self.transforms.get(1) {
            None => pair[place],
            Some(halves) => pair[place] + halves.turn(n).conj() * pair[self.length + place] * sign,
        }
    }
}

impl<T: Real> Lines for EvenLines<T> {
    type Real = T;
    type Columns = Self;

    fn columns(&self) -> &Self {
        self
    }

    fn loaded(&self) -> [usize; 2] {
        [self.loaded; 2]
    }

    fn shown(&self) -> [usize; 2] {
        [self.shown; 2]
    }

    fn width(&self) -> usize {
        self.frequencies_of_a_row().div_ceil(2)
    }

    fn space(&self) -> Space<T> {
        let longest = self.transforms.iter().map(CosineTransform::scratch_length);
        Space {
            reals: Vec::new(),
            pair: vec![Complex::default(); self.frequencies_of_a_row()],
            transform: vec![Complex::default(); longest.max().unwrap_or(0)],
        }
    }

    fn transform_rows(
        &self,
        field: &[f64],
        scale: f64,
        rows: &mut [Complex<T>],
        Space {
            pair, transform, ..
        }: &mut Space<T>,
    ) {
        let number = |value: f64| T::narrowed(value * scale);
        let rows = rows.chunks_mut(2 * self.width());
        for (values, rows) in field.chunks(2 * self.loaded).zip(rows) {
            let (one, other) = values.split_at(self.loaded);
            for (of, line) in self
                .transforms
                .iter()
                .zip(pair.chunks_exact_mut(self.length))
            {
                if other.is_empty() {
                    of.put(
                        line,
                        one.iter().map(|x| Complex::new(number(*x), T::default())),
                    );
                } else {
                    let both = one.iter().zip(other);
                    of.put(
                        line,
                        both.map(|(x, y)| Complex::new(number(*x), number(*y))),
                    );
                }
                of.analyse(line, transform);
            }
            let (one, other) = rows.split_at_mut(self.width());
            for (x, columns) in one.iter_mut().zip(pair.chunks(2)) {
                *x = Complex::new(columns[0].re, columns.get(1).map_or(T::default(), |c| c.re));
            }
            for (y, columns) in other.iter_mut().zip(pair.chunks(2)) {
                *y = Complex::new(columns[0].im, columns.get(1).map_or(T::default(), |c| c.im));
            }
        }
    }

    fn restore_rows(
        &self,
        rows: &mut [Complex<T>],
        parity: Parity,
        field: &mut [f64],
        scale: f64,
        Space {
            pair, transform, ..
        }: &mut Space<T>,
    ) {
        let rows = rows.chunks(2 * self.width());
        for (values, rows) in field.chunks_mut(2 * self.shown).zip(rows) {
            let (one, other) = rows.split_at(self.width());
            for (index, columns) in pair.chunks_mut(2).enumerate() {
                // A single last row is transformed with zeros.
                let (x, y) = (one[index], other.get(index).copied().unwrap_or_default());
                columns[0] = Complex::new(x.re, y.re);
                if let Some(next) = columns.get_mut(1) {
                    *next = Complex::new(x.im, y.im);
                }
            }
            for (of, line) in self
                .transforms
                .iter()
                .zip(pair.chunks_exact_mut(self.length))
            {
                of.synthesise_with(parity, line, transform);
            }
            let (one, other) = values.split_at_mut(self.shown);
            for (n, x) in one.iter_mut().enumerate() {
                let both = self.number(pair, n);
                *x = both.re.widened() * scale;
                if let Some(y) = other.get_mut(n) {
                    *y = both.im.widened() * scale;
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
        let factors = self
            .frequencies(index)
            .map(|frequency| factors(frequency)[part]);
        self.transforms[part].filter(column, factors, &mut space.transform);
    }
}

impl<T: Real> Columns for EvenLines<T> {
    type Real = T;

    fn length(&self) -> usize {
        self.length
    }

    fn parts(&self) -> usize {
        self.transforms.len()
    }

    fn place(&self, n: usize) -> usize {
        place(n, self.length)
    }

    fn padding(&self) -> Range<usize> {
        self.loaded.div_ceil(2)..self.length - self.loaded / 2
    }

    fn turn(&self, n: usize) -> Complex<T> {
        self.transforms[1].turn(n)
    }

    fn folded(&self, n: usize) -> (usize, T) {
        if n < self.length {
            (n, T::one())
        } else {
            (2 * self.length - 1 - n, -T::one())
        }
    }

    fn transform(&self, part: usize, column: &mut [Complex<T>], space: &mut Space<T>) {
        self.transforms[part].analyse(column, &mut space.transform);
    }

    fn restore(
        &self,
        part: usize,
        parity: Parity,
        column: &mut [Complex<T>],
        space: &mut Space<T>,
    ) {
        self.transforms[part].synthesise_with(parity, column, &mut space.transform);
    }
}

#[cfg(test)]
mod tests {
    use super::super::plane::PlaneTransform;
    use super::EvenLines;

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
    fn a_periodic_field_is_filtered_across_its_ends() {
        for size in [1, 2, 3, 8, 9, 30, 67] {
            let mut plane = PlaneTransform::new(EvenLines::<f64>::periodic(size));
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
