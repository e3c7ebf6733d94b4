//! The square domain Ω*, divided into N × N square elements.

use rayon::prelude::*;

use crate::error::{Quantity, TextureError, positive};

/// A square domain centred on the origin and divided into N × N square elements of side `h = 2a`.
///
/// Element `(i, j)` has its centre at `(x_i, x_j)`, `x_i = (i + ½) h − side/2`, and the index `i * N + j` in every
/// field on the grid: the first index runs along x, the second along y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    side: f64,
    size: usize,
}

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
        let side = positive(Quantity::Side, side)?;
        if size == 0 || size > Self::LARGEST_SIZE {
            return Err(TextureError::GridSize {
                found: size,
                largest: Self::LARGEST_SIZE,
            });
        }
        Ok(Self { side, size })
    }

    /// Side of the square domain, m.
    #[must_use]
    pub fn side(&self) -> f64 {
        self.side
    }

    /// Number of elements per side, N.
    #[must_use]
    pub fn size(&self) -> usize {
        self.size
    }

    /// Number of elements, N².
    #[must_use]
    #[expect(
        clippy::len_without_is_empty,
        reason = "a grid has at least one element"
    )]
    pub fn len(&self) -> usize {
        self.size * self.size
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

    /// Coordinate `x_i` (or `y_i`) of the centre of element `i`, m; mirrored elements have exactly opposite
    /// coordinates.
    #[must_use]
    pub fn centre(&self, i: usize) -> f64 {
        // x_i = (i + ½) h − side/2 = (2i + 1 − N) h/2, the bracket is exact.
        ((2 * i + 1) as f64 - self.size as f64) * (0.5 * self.element_side())
    }

    /// Coordinates `x_i` of the element centres from index `first` on, m.
    pub(crate) fn centres_from(&self, first: usize) -> Vec<f64> {
        (first..self.size).map(|i| self.centre(i)).collect()
    }

    /// Evaluates a function of the point at the centres of all elements. A function symmetric in x and y is computed in
    /// one quadrant only and copied to the others, so the values agree to the last bit.
    pub fn sample<T: Copy + Default + Send + Sync>(
        &self,
        is_mirrored: bool,
        function: impl Fn([f64; 2]) -> T + Sync,
    ) -> Vec<T> {
        let size = self.size;
        let mut field = vec![T::default(); self.len()];
        let first = if is_mirrored { size / 2 } else { 0 };
        let (copied, sampled) = field.split_at_mut(first * size);
        let rows = sampled.par_chunks_exact_mut(size).zip(first..size);
        rows.for_each(|(row, i)| {
            let (copied, sampled) = row.split_at_mut(first);
            for (value, j) in sampled.iter_mut().zip(first..size) {
                *value = function([self.centre(i), self.centre(j)]);
            }
            for (value, image) in copied.iter_mut().zip(sampled.iter().rev()) {
                *value = *image;
            }
        });
        // Row i is the image of row N − 1 − i; for odd N the middle row is its own image.
        let rows = copied.par_chunks_exact_mut(size).rev();
        let images = sampled.par_chunks_exact(size).skip(size % 2);
        rows.zip(images)
            .for_each(|(row, image)| row.copy_from_slice(image));
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
        let [rows, columns] = [self.size - above, self.size - left];
        let mut field = vec![T::default(); rows * columns];
        let rows = field.par_chunks_exact_mut(columns).zip(above..self.size);
        rows.for_each(|(row, i)| {
            for (value, j) in row.iter_mut().zip(left..self.size) {
                *value = function([self.centre(i), self.centre(j)]);
            }
        });
        field
    }

    /// Centres `[x, y]` of all elements in the order of their index `i * N + j`.
    pub fn centres(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        (0..self.size)
            .flat_map(move |i| (0..self.size).map(move |j| [self.centre(i), self.centre(j)]))
    }
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
