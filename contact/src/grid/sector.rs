//! A quadrant in place of the whole surface, where everything is its own mirror image in both axes.

use rayon::prelude::*;

/// What part of the surface the elements of a problem cover.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sector {
    /// All of it.
    Whole,
    /// The elements at x, y > 0, each of which stands for its three mirror images too. Element (0, 0) lies at the axis.
    Quadrant,
}

impl Sector {
    /// Elements of the whole grid that one element stands for.
    pub fn images(self) -> usize {
        match self {
            Self::Whole => 1,
            Self::Quadrant => 4,
        }
    }

    /// Parts along one axis.
    pub fn parts(self) -> usize {
        match self {
            Self::Whole => 1,
            Self::Quadrant => 2,
        }
    }

    /// The first, by index, of the elements that an element stands for on a grid of `size` elements per side.
    pub fn first_image(self, element: [usize; 2], size: usize) -> [usize; 2] {
        match self {
            Self::Whole => element,
            Self::Quadrant => element.map(|i| size / 2 - 1 - i),
        }
    }

    /// The sector's part of a field on a grid of `size` elements per side.
    pub fn cut<T: Copy + Default + Send + Sync>(self, field: &[T], size: usize) -> Vec<T> {
        let part = size / self.parts();
        let first = size - part;
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
        let found = images.map(|[i, j]| whole.iter().position(|v| *v == whole[i * 4 + j]));
        assert_eq!(found, images.map(|[i, j]| Some(i * 4 + j)));
    }

    #[test]
    fn the_whole_stays_as_it_is() {
        let field: Vec<f64> = (0..9).map(f64::from).collect();
        assert_eq!(Sector::Whole.cut(&field, 3), field);
        assert_eq!(Sector::Whole.first_image([2, 1], 3), [2, 1]);
    }
}
