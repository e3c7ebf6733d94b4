//! The part of a grid that stands for all of it: a quadrant, where everything is symmetric in x and y.

use rayon::prelude::*;

/// The part of a grid whose elements a problem is solved on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sector {
    /// The whole grid.
    Whole,
    /// The elements at x, y > 0 of a grid of an even number per side, each of which stands for its three mirror images
    /// too. Element (0, 0) lies at the axis.
    Quadrant,
}

impl Sector {
    /// Elements of the whole grid that one element stands for, itself included.
    #[must_use]
    pub fn images(self) -> usize {
        match self {
            Self::Whole => 1,
            Self::Quadrant => 4,
        }
    }

    /// Number of such parts along one axis of the grid.
    #[must_use]
    pub fn parts(self) -> usize {
        match self {
            Self::Whole => 1,
            Self::Quadrant => 2,
        }
    }

    /// Index along an axis, on a grid of `size` elements per side, of the first element.
    #[must_use]
    pub fn first_index(self, size: usize) -> usize {
        size - size / self.parts()
    }

    /// Lines of elements beyond the first, of `reach` looked at, that are mirror images of those on this side.
    #[must_use]
    pub fn mirrored_lines(self, reach: usize) -> usize {
        match self {
            Self::Whole => 0,
            Self::Quadrant => reach,
        }
    }

    /// The first, by index, of the elements that an element stands for on a grid of `size` elements per side.
    #[must_use]
    pub fn first_image(self, element: [usize; 2], size: usize) -> [usize; 2] {
        match self {
            Self::Whole => element,
            Self::Quadrant => element.map(|i| size / 2 - 1 - i),
        }
    }

    /// The first of the points that a point of the sector stands for.
    #[must_use]
    pub fn first_image_of_point(self, point: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Whole => point,
            Self::Quadrant => point.map(|x| 0.0 - x),
        }
    }

    /// The sector's part of a field on a grid of `size` elements per side.
    #[must_use]
    pub fn cut<T: Copy + Default + Send + Sync>(self, field: &[T], size: usize) -> Vec<T> {
        let (part, first) = (size / self.parts(), self.first_index(size));
        let mut values = vec![T::default(); part * part];
        let rows = field.par_chunks_exact(size).skip(first);
        let rows = values.par_chunks_exact_mut(part).zip(rows);
        rows.for_each(|(values, row)| values.copy_from_slice(&row[first..]));
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
    fn the_whole_stays_as_it_is() {
        let field: Vec<f64> = (0..9).map(f64::from).collect();
        assert_eq!(Sector::Whole.cut(&field, 3), field);
        assert_eq!(Sector::Whole.first_image([2, 1], 3), [2, 1]);
    }
}
