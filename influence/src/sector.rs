//! The part of a grid that stands for all of it, where everything is symmetric: in y a half, in x and y a quadrant.

use rayon::prelude::*;

/// The part of a grid whose elements a problem is solved on.
///
/// Its size is the number of elements of a row; a half of a grid has twice as many rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sector {
    /// The whole grid.
    Whole,
    /// The elements at y > 0 of a grid of an even number per side, each of which stands for its mirror image too. The
    /// first of every row lies at the axis.
    Half,
    /// The elements at x, y > 0 of a grid of an even number per side, each of which stands for its three mirror images
    /// too. Element (0, 0) lies at the axis.
    Quadrant,
}

impl Sector {
    /// Whether elements have mirror images along x, and along y.
    #[must_use]
    pub fn mirrored(self) -> [bool; 2] {
        match self {
            Self::Whole => [false, false],
            Self::Half => [false, true],
            Self::Quadrant => [true, true],
        }
    }

    /// Number of such parts along each axis of the grid.
    #[must_use]
    pub fn parts(self) -> [usize; 2] {
        self.mirrored().map(|mirrored| 1 + usize::from(mirrored))
    }

    /// Elements of the whole grid that one element stands for, itself included.
    #[must_use]
    pub fn images(self) -> usize {
        self.parts().iter().product()
    }

    /// Elements per side of a square of the whole grid, of which `size` elements of each row are the sector's.
    #[must_use]
    pub fn whole(self, size: usize) -> usize {
        let [_, parts] = self.parts();
        parts * size
    }

    /// The size that holds its part of a square of so many elements per side.
    #[must_use]
    pub fn size_for(self, side: usize) -> usize {
        let [_, parts] = self.parts();
        side.div_ceil(parts)
    }

    /// Rows of the sector, and elements of each, the `size`.
    #[must_use]
    pub fn lengths(self, size: usize) -> [usize; 2] {
        self.parts().map(|parts| self.whole(size) / parts)
    }

    /// Index along each axis, on a grid of `size` elements per side, of the first element.
    #[must_use]
    pub fn first_index(self, size: usize) -> [usize; 2] {
        self.parts().map(|parts| size - size / parts)
    }

    /// Lines of elements before the first along each axis, of `reach` looked at, that are mirror images of those on
    /// this side.
    #[must_use]
    pub fn mirrored_lines(self, reach: usize) -> [usize; 2] {
        self.mirrored()
            .map(|mirrored| if mirrored { reach } else { 0 })
    }

    /// The first, by index, of the elements that an element stands for on a grid of `size` elements per side.
    #[must_use]
    pub fn first_image(self, element: [usize; 2], size: usize) -> [usize; 2] {
        let image = |axis: usize| {
            if self.mirrored()[axis] {
                size / 2 - 1 - element[axis]
            } else {
                element[axis]
            }
        };
        [image(0), image(1)]
    }

    /// The first of the points that a point of the sector stands for.
    #[must_use]
    pub fn first_image_of_point(self, point: [f64; 2]) -> [f64; 2] {
        let image = |axis: usize| {
            if self.mirrored()[axis] {
                0.0 - point[axis]
            } else {
                point[axis]
            }
        };
        [image(0), image(1)]
    }

    /// The sector's part of a field on a grid of `size` elements per side.
    #[must_use]
    pub fn cut<T: Copy + Default + Send + Sync>(self, field: &[T], size: usize) -> Vec<T> {
        let [above, left] = self.first_index(size);
        let [rows, part] = [size - above, size - left];
        let mut values = vec![T::default(); rows * part];
        let rows = field.par_chunks_exact(size).skip(above);
        let rows = values.par_chunks_exact_mut(part).zip(rows);
        rows.for_each(|(values, row)| values.copy_from_slice(&row[left..]));
        values
    }
}

#[cfg(test)]
mod tests {
    use super::Sector;

    #[test]
    fn a_quadrant_is_cut_from_its_four_images() {
        let rows = [[4.0, 3.0, 3.0, 4.0], [2.0, 1.0, 1.0, 2.0]];
        let whole = [rows[0], rows[1], rows[1], rows[0]].concat();
        assert_eq!(Sector::Quadrant.cut(&whole, 4), [1.0, 2.0, 3.0, 4.0]);
        let images = [[0, 0], [0, 1], [1, 0], [1, 1]].map(|at| Sector::Quadrant.first_image(at, 4));
        assert_eq!(images, [[1, 1], [1, 0], [0, 1], [0, 0]]);
    }

    #[test]
    fn a_half_is_cut_from_its_two_images() {
        let whole = [[2.0, 1.0, 1.0, 2.0], [4.0, 3.0, 3.0, 4.0]].concat();
        let whole = [whole.clone(), whole].concat();
        let half = Sector::Half;
        assert_eq!(
            half.cut(&whole, 4),
            [1.0, 2.0, 3.0, 4.0, 1.0, 2.0, 3.0, 4.0]
        );
        assert_eq!((half.lengths(2), half.images()), ([4, 2], 2));
        let images = [[0, 0], [3, 1]].map(|at| half.first_image(at, 4));
        assert_eq!(images, [[0, 1], [3, 0]]);
        assert_eq!(half.first_image_of_point([1.0, 2.0]), [1.0, -2.0]);
    }

    #[test]
    fn the_whole_stays_as_it_is() {
        let field: Vec<f64> = (0..9).map(f64::from).collect();
        assert_eq!(Sector::Whole.cut(&field, 3), field);
        assert_eq!(Sector::Whole.first_image([2, 1], 3), [2, 1]);
    }
}
