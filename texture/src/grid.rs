//! The domain Ω*, divided into square elements.

use rayon::prelude::*;

use crate::error::{Quantity, TextureError, positive};

/// A rectangular domain centred on the origin, mostly a square, and divided into square elements of side `h = 2a`.
///
/// Element `(i, j)` of `N_x × N_y` has its centre at `(x_i, y_j)`, `x_i = (i + ½) h − N_x h/2`, and the index
/// `i * N_y + j` in every field on the grid: the first index runs along x, the second along y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// The longer side, m.
    side: f64,
    /// Elements along the longer side.
    size: usize,
    lengths: [usize; 2],
}

/// Relative difference up to which two sides of an element count as equal: rounding in numbers that a user wrote.
const SQUARE_TO: f64 = 1e-6;

impl Grid {
    /// Largest number of elements per side: one field of 32 768² values takes 8 GiB, and a solution needs about ten.
    pub const LARGEST_SIZE: usize = 32_768;

    /// Builds a grid of `size` × `size` elements on a square of the given `side` (m).
    ///
    /// # Errors
    ///
    /// [`TextureError::NotPositive`] if `side` is not positive and finite, [`TextureError::GridSize`] if `size` is 0 or
    /// above [`Grid::LARGEST_SIZE`].
    pub fn new(side: f64, size: usize) -> Result<Self, TextureError> {
        Self::oblong(side, [size; 2])
    }

    /// Builds a grid of `lengths` elements along x and y whose longer side (m) is given.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn oblong(side: f64, lengths: [usize; 2]) -> Result<Self, TextureError> {
        let side = positive(Quantity::Side, side)?;
        let largest = Self::LARGEST_SIZE;
        if let Some(found) = lengths
            .into_iter()
            .find(|size| *size == 0 || *size > largest)
        {
            return Err(TextureError::GridSize { found, largest });
        }
        let size = lengths[0].max(lengths[1]);
        Ok(Self {
            side,
            size,
            lengths,
        })
    }

    /// The numbers of elements along x and y of a rectangle with these sides (m), `size` of them along the longer one;
    /// none if the shorter one is not a whole number of square elements, to a millionth of an element's side.
    #[must_use]
    pub fn lengths_of(sides: [f64; 2], size: usize) -> Option<[usize; 2]> {
        let longer = sides[0].max(sides[1]);
        let exact = sides.map(|side| side / longer * size as f64);
        let near = exact.map(f64::round);
        let is_whole = |axis: usize| {
            near[axis] >= 1.0 && (exact[axis] - near[axis]).abs() <= SQUARE_TO * near[axis]
        };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "whole numbers up to the size"
        )]
        (is_whole(0) && is_whole(1)).then(|| near.map(|size| size as usize))
    }

    /// The longer side of the domain, m.
    #[must_use]
    pub fn side(&self) -> f64 {
        self.side
    }

    /// Number of elements along the longer side, N.
    #[must_use]
    pub fn size(&self) -> usize {
        self.size
    }

    /// Numbers of elements along x and y: rows, and elements in each.
    #[must_use]
    pub fn lengths(&self) -> [usize; 2] {
        self.lengths
    }

    /// Elements per row, along y: the index of an element is `i * row + j`.
    #[must_use]
    pub fn row(&self) -> usize {
        self.lengths[1]
    }

    /// Whether both sides are equal.
    #[must_use]
    pub fn is_square(&self) -> bool {
        self.lengths[0] == self.lengths[1]
    }

    /// The sides along x and y, m.
    #[must_use]
    pub fn sides(&self) -> [f64; 2] {
        self.lengths.map(|length| {
            if length == self.size {
                self.side
            } else {
                length as f64 * self.element_side()
            }
        })
    }

    /// Area of the domain, m².
    #[must_use]
    pub fn area(&self) -> f64 {
        let [x, y] = self.sides();
        x * y
    }

    /// Number of elements.
    #[must_use]
    #[expect(
        clippy::len_without_is_empty,
        reason = "a grid has at least one element"
    )]
    pub fn len(&self) -> usize {
        self.lengths[0] * self.lengths[1]
    }

    /// Side of one element, `h = 2a`, m.
    #[must_use]
    pub fn element_side(&self) -> f64 {
        self.side / self.size as f64
    }

    /// Area of one element, `h² = 4a²`, m².
    #[must_use]
    pub fn element_area(&self) -> f64 {
        self.element_side().powi(2)
    }

    /// Coordinate of the centre of the `i`-th element along the longer side, or along either side of a square, m;
    /// mirrored elements have exactly opposite coordinates.
    #[must_use]
    pub fn centre(&self, i: usize) -> f64 {
        self.coordinate(self.size, i)
    }

    /// Coordinate of the centre of the `i`-th element along an axis, 0 for x and 1 for y, m.
    ///
    /// # Panics
    /// If there is no such axis.
    #[must_use]
    pub fn centre_along(&self, axis: usize, i: usize) -> f64 {
        self.coordinate(self.lengths[axis], i)
    }

    /// Coordinates `[x, y]` of the centre of an element, m.
    #[must_use]
    pub fn point(&self, [i, j]: [usize; 2]) -> [f64; 2] {
        [self.centre_along(0, i), self.centre_along(1, j)]
    }

    fn coordinate(&self, length: usize, i: usize) -> f64 {
        // x_i = (i + ½) h − N_x h/2 = (2i + 1 − N_x) h/2, the bracket is exact.
        ((2 * i + 1) as f64 - length as f64) * (0.5 * self.element_side())
    }

    /// Coordinates of the element centres along an axis from index `first` on, m.
    pub(crate) fn centres_from(&self, axis: usize, first: usize) -> Vec<f64> {
        (first..self.lengths[axis])
            .map(|i| self.centre_along(axis, i))
            .collect()
    }

    /// Evaluates a function of the point at the centres of all elements. A function symmetric in x and y is computed in
    /// one quadrant only and copied to the others, so the values agree to the last bit.
    pub fn sample<T: Copy + Default + Send + Sync>(
        &self,
        is_mirrored: bool,
        function: impl Fn([f64; 2]) -> T + Sync,
    ) -> Vec<T> {
        let [count, size] = self.lengths;
        let mut field = vec![T::default(); self.len()];
        let [above, left] = self
            .lengths
            .map(|length| if is_mirrored { length / 2 } else { 0 });
        let (copied, sampled) = field.split_at_mut(above * size);
        fill_rows(sampled, size, &|row, values| {
            let (copied, sampled) = values.split_at_mut(left);
            for (value, j) in sampled.iter_mut().zip(left..size) {
                *value = function(self.point([above + row, j]));
            }
            for (value, image) in copied.iter_mut().zip(sampled.iter().rev()) {
                *value = *image;
            }
        });
        // Row i is the image of row N − 1 − i; for odd N the middle row is its own image.
        let sampled = &*sampled;
        fill_rows(copied, size, &|row, values| {
            let image = above - 1 - row + count % 2;
            values.copy_from_slice(&sampled[image * size..][..size]);
        });
        field
    }

    /// Evaluates a function of the point at the element centres from row `above` and column `left` on, row by row.
    ///
    /// # Panics
    /// If the grid has no such row or column.
    pub fn sample_from<T: Copy + Default + Send + Sync>(
        &self,
        [above, left]: [usize; 2],
        function: impl Fn([f64; 2]) -> T + Sync,
    ) -> Vec<T> {
        let [rows, columns] = [self.lengths[0] - above, self.lengths[1] - left];
        let mut field = vec![T::default(); rows * columns];
        fill_rows(&mut field, columns, &|row, values| {
            for (value, j) in values.iter_mut().zip(left..self.lengths[1]) {
                *value = function(self.point([above + row, j]));
            }
        });
        field
    }

    /// Centres `[x, y]` of all elements in the order of their index.
    pub fn centres(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let [rows, columns] = self.lengths;
        (0..rows).flat_map(move |i| (0..columns).map(move |j| self.point([i, j])))
    }
}

/// Fills each row of a field, by its number. The work on a row is a trait object, so that the loop over threads is
/// compiled once for each type of value.
fn fill_rows<T: Send>(field: &mut [T], columns: usize, fill: &(dyn Fn(usize, &mut [T]) + Sync)) {
    let rows = field.par_chunks_exact_mut(columns).enumerate();
    rows.for_each(|(row, values)| fill(row, values));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn centres_are_symmetric_to_the_last_bit_and_one_element_apart() {
        for size in [1, 2, 7, 256, 1000] {
            let grid = Grid::new(0.12, size).unwrap();
            for i in 0..size {
                assert_eq!(grid.centre(i), -grid.centre(size - 1 - i));
            }
            let first = 0.5 * grid.element_side() - 0.5 * grid.side();
            // Three roundings of numbers below 0.12.
            assert!((grid.centre(0) - first).abs() <= 4.0 * f64::EPSILON * 0.12);
        }
    }

    #[test]
    fn the_second_index_runs_along_y() {
        let grid = Grid::new(2.0, 4).unwrap();
        let centres: Vec<_> = grid.centres().collect();
        assert_eq!(centres.len(), grid.len());
        assert_eq!(centres[4 + 3], [-0.25, 0.75]);
    }

    #[test]
    fn a_mirrored_function_is_sampled_like_any_other() {
        for size in [1, 2, 5, 8] {
            let grid = Grid::new(3.0, size).unwrap();
            let mirrored = |[x, y]: [f64; 2]| x * x + 2.0 * y.abs();
            let expected: Vec<f64> = grid.centres().map(mirrored).collect();
            for is_mirrored in [false, true] {
                assert_eq!(grid.sample(is_mirrored, mirrored), expected);
            }
            let other = |[x, y]: [f64; 2]| x - 3.0 * y;
            let half = grid.centres().filter(|[_, y]| *y >= 0.0);
            let half: Vec<f64> = half.map(other).collect();
            assert_eq!(grid.sample_from([0, size / 2], other), half);
            let expected: Vec<f64> = grid.centres().map(other).collect();
            assert_eq!(grid.sample(false, other), expected);
        }
    }

    #[test]
    fn an_oblong_grid_has_square_elements_of_which_the_longer_side_has_the_given_number() {
        let wide = Grid::oblong(4.0, [2, 4]).unwrap();
        assert_eq!((wide.element_side(), wide.len()), (1.0, 8));
        assert_eq!((wide.sides(), wide.area()), ([2.0, 4.0], 8.0));
        let centres: Vec<_> = wide.centres().collect();
        assert_eq!(centres[4 + 3], [0.5, 1.5]);
        for is_mirrored in [false, true] {
            let sampled = wide.sample(is_mirrored, |[x, y]| x * x + 2.0 * y.abs());
            let expected: Vec<f64> = centres.iter().map(|[x, y]| x * x + 2.0 * y.abs()).collect();
            assert_eq!(sampled, expected);
        }
        assert_eq!(wide.sample_from([1, 2], |point| point), centres[6..]);
        assert!(Grid::oblong(4.0, [0, 4]).is_err() && Grid::oblong(4.0, [4, 40_000]).is_err());
    }

    #[test]
    fn sides_are_divided_into_square_elements_or_not_at_all() {
        assert_eq!(Grid::lengths_of([7.5e-6, 10e-6], 128), Some([96, 128]));
        assert_eq!(Grid::lengths_of([1e-5, 1e-5], 7), Some([7, 7]));
        // 480 elements of 20.8333 nm beside 640, as a scan gives them with six digits.
        assert_eq!(Grid::lengths_of([640.0, 480.000_1], 640), Some([640, 480]));
        assert_eq!(Grid::lengths_of([7.5, 10.0], 129), None);
        assert_eq!(Grid::lengths_of([1e-9, 10.0], 128), None);
    }

    #[test]
    fn a_grid_without_elements_or_without_extent_is_refused() {
        let largest = Grid::LARGEST_SIZE;
        assert_eq!(
            Grid::new(1.0, 0),
            Err(TextureError::GridSize { found: 0, largest })
        );
        assert_eq!(
            Grid::new(1.0, 1_000_000_000),
            Err(TextureError::GridSize {
                found: 1_000_000_000,
                largest
            })
        );
        for side in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                Grid::new(side, 8),
                Err(TextureError::NotPositive {
                    quantity: Quantity::Side,
                    ..
                })
            ));
        }
    }
}
