//! The part of a grid that stands for all of it under symmetry: a half if symmetric in y, a quadrant if in x and y.

use rayon::prelude::*;

/// The part of a square grid that stands for all of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sector {
    /// The whole grid.
    Whole,
    /// The elements at y > 0 of a grid with an even number per side, each of which also stands for its mirror image.
    /// The first of every row lies at the axis.
    Half,
    /// The elements at x, y > 0 of a grid with an even number per side, each of which also stands for its three mirror
    /// images. Element (0, 0) lies at the axis.
    Quadrant,
}

/// The elements of a grid on which a problem is solved: all, or a sector of a square that stands for them.
///
/// Its size is the number of elements per row; a half of a square has twice as many rows, an oblong grid any number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SectorGrid {
    sector: Sector,
    size: usize,
    rows: usize,
}

impl SectorGrid {
    /// A whole grid of `size` elements per side.
    #[must_use]
    pub fn whole(size: usize) -> Self {
        Self::new(Sector::Whole, size)
    }

    /// A sector of `size` elements per row.
    #[must_use]
    pub fn new(sector: Sector, size: usize) -> Self {
        let rows = match sector {
            Sector::Half => 2 * size,
            Sector::Whole | Sector::Quadrant => size,
        };
        Self { sector, size, rows }
    }

    /// A whole grid of this many rows, and of elements in each.
    #[must_use]
    pub fn oblong([rows, size]: [usize; 2]) -> Self {
        Self {
            sector: Sector::Whole,
            size,
            rows,
        }
    }

    /// The smallest grid of this sector that holds its part of a square of `side` elements per side.
    #[must_use]
    pub fn of_square(sector: Sector, side: usize) -> Self {
        let one = Self::new(sector, 1);
        one.with_size(side.div_ceil(one.whole_size()))
    }

    /// The same sector of a square with `size` elements per row; the grid itself if it has as many.
    #[must_use]
    pub fn with_size(self, size: usize) -> Self {
        if size == self.size {
            self
        } else {
            Self::new(self.sector, size)
        }
    }

    /// The same sector of another square; see [`Self::of_square`].
    #[must_use]
    pub fn for_square(self, side: usize) -> Self {
        Self::of_square(self.sector, side)
    }

    /// All of another grid of this many rows and elements in each, or the same sector of it if it is square.
    #[must_use]
    pub fn for_lengths(self, lengths: [usize; 2]) -> Self {
        if lengths[0] == lengths[1] {
            self.for_square(lengths[0])
        } else {
            Self::oblong(lengths)
        }
    }

    /// The part of the whole grid.
    pub(crate) fn sector(self) -> Sector {
        self.sector
    }

    /// Number of elements per row.
    #[must_use]
    pub fn size(self) -> usize {
        self.size
    }

    /// Elements along the longer side of the whole grid.
    #[must_use]
    pub fn whole_size(self) -> usize {
        let [rows, columns] = self.whole_lengths();
        rows.max(columns)
    }

    /// Number of rows of the whole grid, and of elements in each.
    #[must_use]
    pub fn whole_lengths(self) -> [usize; 2] {
        let (lengths, parts) = (self.lengths(), self.parts());
        [0, 1].map(|axis: usize| parts[axis] * lengths[axis])
    }

    /// Number of rows, and of elements in each.
    #[must_use]
    pub fn lengths(self) -> [usize; 2] {
        [self.rows, self.size]
    }

    /// Number of elements.
    #[must_use]
    pub fn elements(self) -> usize {
        self.lengths().iter().product()
    }

    /// Whether elements have mirror images along x, and along y.
    #[must_use]
    pub fn mirrored(self) -> [bool; 2] {
        match self.sector {
            Sector::Whole => [false, false],
            Sector::Half => [false, true],
            Sector::Quadrant => [true, true],
        }
    }

    /// Whether elements have mirror images at all.
    #[must_use]
    pub fn has_images(self) -> bool {
        self.sector != Sector::Whole
    }

    /// Number of such parts along each axis of the whole grid.
    #[must_use]
    pub fn parts(self) -> [usize; 2] {
        self.mirrored().map(|mirrored| 1 + usize::from(mirrored))
    }

    /// Elements of the whole grid that one element stands for, itself included.
    #[must_use]
    pub fn images(self) -> usize {
        self.parts().iter().product()
    }

    /// Number of elements of the whole grid that `elements` of the sector stand for.
    #[must_use]
    pub fn with_images(self, elements: usize) -> usize {
        self.images() * elements
    }

    /// The area (m²) on which one value of a pressure acts: an element of this area and its mirror images.
    #[must_use]
    pub fn loaded_area(self, element_area: f64) -> f64 {
        self.images() as f64 * element_area
    }

    /// Index of the first element along each axis of the whole grid.
    #[must_use]
    pub fn first_index(self) -> [usize; 2] {
        let (whole, own) = (self.whole_lengths(), self.lengths());
        [0, 1].map(|axis: usize| whole[axis] - own[axis])
    }

    /// Number of lines before the first element along each axis, out of `reach`, that are mirror images
    /// of those on this side.
    #[must_use]
    pub fn mirrored_lines(self, reach: usize) -> [usize; 2] {
        self.mirrored()
            .map(|mirrored| if mirrored { reach } else { 0 })
    }

    /// The index of an element along an axis; for an element across the axis, that of its mirror image.
    #[must_use]
    pub fn on_this_side(self, axis: usize, index: isize) -> isize {
        if index < 0 && self.mirrored()[axis] {
            -1 - index
        } else {
            index
        }
    }

    /// The first, by index on the whole grid, of the elements for which `element` stands.
    #[must_use]
    pub fn first_image(self, element: [usize; 2]) -> [usize; 2] {
        let image = |axis: usize| {
            if self.mirrored()[axis] {
                self.lengths()[axis] - 1 - element[axis]
            } else {
                element[axis]
            }
        };
        [image(0), image(1)]
    }

    /// The first of the points for which a point of the sector stands.
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

    /// Offsets from one element to another and to its mirror images.
    pub(crate) fn offsets(
        self,
        from: [usize; 2],
        to: [usize; 2],
    ) -> impl Iterator<Item = [usize; 2]> {
        let along = move |axis: usize| {
            let mirrored = self.mirrored()[axis].then_some(from[axis] + to[axis] + 1);
            std::iter::once(from[axis].abs_diff(to[axis])).chain(mirrored)
        };
        along(0).flat_map(move |x| along(1).map(move |y| [x, y]))
    }

    /// The part of a field on the whole grid that belongs to these elements.
    #[must_use]
    pub fn cut<T: Copy + Default + Send + Sync>(self, field: &[T]) -> Vec<T> {
        let [above, left] = self.first_index();
        let mut values = vec![T::default(); self.elements()];
        let [_, whole_row] = self.whole_lengths();
        let rows = field.par_chunks_exact(whole_row).skip(above);
        let rows = values.par_chunks_exact_mut(self.size).zip(rows);
        rows.for_each(|(values, row)| values.copy_from_slice(&row[left..]));
        values
    }
}

#[cfg(test)]
mod tests {
    use super::{Sector, SectorGrid};

    #[test]
    fn a_quadrant_is_cut_from_its_four_images() {
        let rows = [[4.0, 3.0, 3.0, 4.0], [2.0, 1.0, 1.0, 2.0]];
        let whole = [rows[0], rows[1], rows[1], rows[0]].concat();
        let quadrant = SectorGrid::new(Sector::Quadrant, 2);
        assert_eq!(quadrant.cut(&whole), [1.0, 2.0, 3.0, 4.0]);
        let images = [[0, 0], [0, 1], [1, 0], [1, 1]].map(|at| quadrant.first_image(at));
        assert_eq!(images, [[1, 1], [1, 0], [0, 1], [0, 0]]);
        assert_eq!(
            (quadrant.with_images(3), quadrant.loaded_area(0.5)),
            (12, 2.0)
        );
    }

    #[test]
    fn a_half_is_cut_from_its_two_images() {
        let whole = [[2.0, 1.0, 1.0, 2.0], [4.0, 3.0, 3.0, 4.0]].concat();
        let whole = [whole.clone(), whole].concat();
        let half = SectorGrid::of_square(Sector::Half, 4);
        assert_eq!(half.cut(&whole), [1.0, 2.0, 3.0, 4.0, 1.0, 2.0, 3.0, 4.0]);
        assert_eq!((half.lengths(), half.images()), ([4, 2], 2));
        assert_eq!(half.for_square(3), half);
        let images = [[0, 0], [3, 1]].map(|at| half.first_image(at));
        assert_eq!(images, [[0, 1], [3, 0]]);
        let mirrored = half.first_image_of_point([1.0, 2.0]);
        assert_eq!(mirrored.map(f64::to_bits), [1.0, -2.0].map(f64::to_bits));
    }

    #[test]
    fn the_whole_grid_is_not_cut() {
        let field: Vec<f64> = (0..9).map(f64::from).collect();
        let whole = SectorGrid::whole(3);
        assert_eq!(whole.cut(&field), field);
        assert_eq!(whole.first_image([2, 1]), [2, 1]);
        assert_eq!(whole.on_this_side(0, -2), -2);
        assert!(whole.offsets([2, 1], [0, 2]).eq([[2, 1]]));
    }

    #[test]
    fn an_oblong_grid_is_its_own_whole() {
        let wide = SectorGrid::oblong([2, 3]);
        assert_eq!((wide.lengths(), wide.whole_size()), ([2, 3], 3));
        assert_eq!((wide.first_index(), wide.elements()), ([0, 0], 6));
        let field: Vec<f64> = (0..6).map(f64::from).collect();
        assert_eq!(wide.cut(&field), field);
        assert_eq!(
            (wide.with_size(3), wide.with_size(4)),
            (wide, SectorGrid::whole(4))
        );
    }

    #[test]
    fn offsets_reach_to_an_element_and_its_images() {
        let quadrant = SectorGrid::new(Sector::Quadrant, 3);
        assert_eq!([-1, -3, 2].map(|i| quadrant.on_this_side(0, i)), [0, 2, 2]);
        let offsets = quadrant.offsets([2, 1], [0, 2]);
        assert!(offsets.eq([[2, 1], [2, 4], [3, 1], [3, 4]]));
        let half = SectorGrid::new(Sector::Half, 3);
        assert_eq!([0, 1].map(|axis| half.on_this_side(axis, -1)), [-1, 0]);
        assert!(half.offsets([5, 0], [1, 0]).eq([[4, 0], [4, 1]]));
    }
}
