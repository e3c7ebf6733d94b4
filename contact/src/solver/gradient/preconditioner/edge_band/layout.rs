//! Where the band lies.

use std::ops::Range;

use super::{
    WIDTH,
    stencil::{REACH, TOGETHER},
};

/// The places of the band's elements on the grid and in the field to which its stencil is applied, which also covers
/// elements beyond axes of symmetry.
#[derive(Clone, Copy)]
pub struct Layout {
    /// Rows, and elements per row.
    pub lengths: [usize; 2],
    /// Rows and columns before the first element.
    pub beyond: [usize; 2],
}

impl Layout {
    /// Places in a row: those of a group at its end, too.
    pub fn width(self) -> usize {
        self.lengths[1] + self.beyond[1] + TOGETHER
    }

    pub fn places(self) -> usize {
        (self.lengths[0] + self.beyond[0] + 1) * self.width()
    }

    pub fn place(self, [i, j]: [usize; 2]) -> usize {
        let [above, left] = self.beyond;
        (i + above) * self.width() + j + left
    }

    /// The places of an element's mirror images beyond the axes that are within reach of the stencil.
    pub fn images(self, [i, j]: [usize; 2]) -> impl Iterator<Item = usize> {
        // The image of element k from the axis lies at the same distance on the other side.
        let along = move |axis: usize, k: usize| {
            let beyond = self.beyond[axis];
            std::iter::once(k + beyond).chain(beyond.checked_sub(k + 1))
        };
        let places = along(0, i).flat_map(move |i| along(1, j).map(move |j| i * self.width() + j));
        places.skip(1)
    }

    /// Rows or columns that may hold the band: neither it nor the stencil leaves the grid.
    pub fn lines(self, axis: usize) -> Range<usize> {
        let (margin, length) = (WIDTH.max(REACH), self.lengths[axis]);
        let first = if self.beyond[axis] > 0 {
            0
        } else {
            margin.min(length)
        };
        first..length.saturating_sub(margin).max(first)
    }

    /// Finds the band's elements in row `i`, ascending. The buffers are for a row plus the width of the band on both
    /// sides, and for a row.
    pub fn find_band_in_row(
        self,
        i: usize,
        mask: &[bool],
        [near, band]: &mut [Vec<bool>; 2],
        found: &mut Vec<usize>,
    ) {
        let [_, size] = self.lengths;
        found.clear();
        near.fill(false);
        // Elements beyond an axis are images of elements on this side, which are nearer.
        let first = i.saturating_sub(WIDTH);
        for row in mask[first * size..(i + WIDTH + 1) * size].chunks_exact(size) {
            let near = near[WIDTH..].iter_mut();
            near.zip(row).for_each(|(near, member)| *near |= member);
        }
        if !near.contains(&true) {
            return;
        }
        band.fill(false);
        for offset in 0..=2 * WIDTH {
            let near = &near[offset..];
            (band.iter_mut().zip(near)).for_each(|(band, near)| *band |= near);
        }
        let row = i * size..(i + 1) * size;
        (band.iter_mut().zip(&mask[row.clone()])).for_each(|(band, member)| *band &= !member);
        let columns = self.lines(1);
        let elements = (row.start + columns.start)..(row.start + columns.end);
        let members = elements.zip(&band[columns]);
        found.extend(members.filter_map(|(element, is_of_band)| is_of_band.then_some(element)));
    }
}
