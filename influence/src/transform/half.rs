//! Lines of a field continued by its mirror image in one axis: the rows are [even](EvenLines), the columns those of any
//! [field](FourierColumns).
//!
//! A transformed row is real, so two columns a, b are transformed as one, `V = A + i B`. With the negative k' of a
//! frequency k, its partner, and real factors f, g that are even in k
//!
//! ```text
//! A = ½ (V_k + V̄_k'),   i B = ½ (V_k − V̄_k');     f A + i g B = ½ (f + g) V_k + ½ (f − g) V̄_k'
//! ```

use pellicle_fourier::Complex;

use super::Parity;
use super::even::EvenLines;
use super::fourier::FourierColumns;
use super::lines::{Factors, Lines, Real, Space};

/// Plans for fields of one size.
pub(crate) struct HalfLines<T: Real> {
    rows: EvenLines<T>,
    columns: FourierColumns<T>,
}

impl<T: Real> HalfLines<T> {
    /// Plans for fields of period 2 · `length` along both axes; half of each row and all of each column
    /// is given and wanted.
    pub(crate) fn periodic(length: usize) -> Self {
        Self {
            rows: EvenLines::periodic(length),
            columns: FourierColumns::periodic(2 * length),
        }
    }

    /// Plans for padded fields, with room for 2 · `length` numbers in a row, given and wanted together, and
    /// in a column. `loaded` rows and columns are given and `shown` wanted; `above` of the wanted rows
    /// precede the first given one.
    pub(crate) fn padded(
        loaded: [usize; 2],
        shown: [usize; 2],
        above: usize,
        length: usize,
    ) -> Self {
        Self {
            rows: EvenLines::padded(loaded[1], shown[1], length),
            columns: FourierColumns::padded(loaded[0], shown[0], above, 2 * length),
        }
    }
}

impl<T: Real> Lines for HalfLines<T> {
    type Real = T;
    type Columns = FourierColumns<T>;

    fn columns(&self) -> &FourierColumns<T> {
        &self.columns
    }

    fn loaded(&self) -> [usize; 2] {
        let [_, of_row] = self.rows.loaded();
        [self.columns.loaded(), of_row]
    }

    fn shown(&self) -> [usize; 2] {
        let [_, of_row] = self.rows.shown();
        [self.columns.shown(), of_row]
    }

    fn width(&self) -> usize {
        self.rows.width()
    }

    fn space(&self) -> Space<T> {
        let mut space = self.rows.space();
        let longest = space.transform.len().max(self.columns.scratch_length());
        space.transform.resize(longest, Complex::default());
        space
    }

    fn transform_rows(
        &self,
        field: &[f64],
        scale: f64,
        rows: &mut [Complex<T>],
        space: &mut Space<T>,
    ) {
        self.rows.transform_rows(field, scale, rows, space);
    }

    fn restore_rows(
        &self,
        rows: &mut [Complex<T>],
        parity: Parity,
        field: &mut [f64],
        scale: f64,
        space: &mut Space<T>,
    ) {
        self.rows.restore_rows(rows, parity, field, scale, space);
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
        let [f, g] = self.rows.frequencies(index).map(|of| factors(of)[part]);
        self.columns.analyse(column, space);
        let half = T::narrowed(0.5);
        let length = column.len();
        for (k, (f, g)) in f.iter().zip(g).enumerate() {
            // At even frequencies −2k is 2 (M − k), at odd ones −(2k + 1) is 2 (M − k − 1) + 1.
            let partner = (length - k - part) % length;
            let (sum, difference) = ((*f + *g) * half, (*f - *g) * half);
            let [v, w] = [column[k], column[partner]];
            column[k] = v * sum + w.conj() * difference;
            column[partner] = w * sum + v.conj() * difference;
        }
        self.columns.synthesise(column, space);
    }
}

#[cfg(test)]
mod tests {
    use super::super::plane::PlaneTransform;
    use super::HalfLines;

    #[test]
    fn a_periodic_field_is_filtered_across_its_ends() {
        for half in [1, 2, 3, 8, 9, 30] {
            let period = 2 * half;
            let field: Vec<f64> = (0..period * half)
                .map(|e| (0.37 * e as f64).sin())
                .collect();
            let at = |i: usize, j: usize| {
                let j = j % period;
                field[i % period * half + j.min(period - 1 - j)]
            };
            let wave = |k: usize| (2.0 * std::f64::consts::PI * k as f64 / period as f64).cos();
            // The sum `4 f + f_N + f_S + 2 f_E + 2 f_W`.
            let factor = |row: usize, column: usize| {
                (4.0 + 2.0 * wave(row) + 4.0 * wave(column)) / (period * period) as f64
            };
            let of_column = |column| (0..=half).map(|row| factor(row, column)).collect();
            let factors: Vec<Vec<f64>> = (0..half).map(of_column).collect();
            let mut plane = PlaneTransform::new(HalfLines::<f64>::periodic(half));
            let mut found = field.clone();
            plane.load(&found, 2.0);
            plane.multiply(|column| [&factors[column], &[]]);
            plane.restore(&mut found, 0.5);
            for (e, found) in found.iter().enumerate() {
                let (i, j) = (e / half + period, e % half + period);
                let expected = 4.0 * at(i, j)
                    + at(i - 1, j)
                    + at(i + 1, j)
                    + 2.0 * at(i, j - 1)
                    + 2.0 * at(i, j + 1);
                assert!((found - expected).abs() < 1e-13, "{half} {e}");
            }
        }
    }
}
