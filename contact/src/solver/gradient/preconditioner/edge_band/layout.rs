//! Where the band lies.

use std::ops::Range;

use rayon::prelude::*;

use super::{
    ELEMENTS, WIDTH,
    stencil::{Group, REACH, TOGETHER},
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
    pub fn images(self, element: usize) -> impl Iterator<Item = usize> {
        let [i, j] = [element / self.lengths[1], element % self.lengths[1]];
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

    /// Finds the elements of row `i` at most the width of the band from the elements `around` for whose membership
    /// `is_wanted` holds, ascending. The buffers are for a row plus the width of the band on both sides, and for a row.
    fn find_in_row(
        self,
        i: usize,
        [around, set]: [&[bool]; 2],
        is_wanted: impl Fn(bool) -> bool,
        [near, wanted]: &mut [Vec<bool>; 2],
        found: &mut Vec<Group>,
    ) {
        let [_, size] = self.lengths;
        found.clear();
        near.fill(false);
        // Elements beyond an axis are images of elements on this side, which are nearer.
        let first = i.saturating_sub(WIDTH);
        for row in around[first * size..(i + WIDTH + 1) * size].chunks_exact(size) {
            let near = near[WIDTH..].iter_mut();
            near.zip(row).for_each(|(near, member)| *near |= member);
        }
        if !near.contains(&true) {
            return;
        }
        wanted.fill(false);
        for offset in 0..=2 * WIDTH {
            let near = &near[offset..];
            (wanted.iter_mut().zip(near)).for_each(|(wanted, near)| *wanted |= near);
        }
        let row = i * size..(i + 1) * size;
        (wanted.iter_mut().zip(&set[row.clone()]))
            .for_each(|(wanted, member)| *wanted &= is_wanted(*member));
        let columns = self.lines(1);
        for (chunk, wanted) in wanted[columns.clone()].chunks(TOGETHER).enumerate() {
            if wanted.contains(&true) {
                let j = columns.start + chunk * TOGETHER;
                let mut members = [false; TOGETHER];
                members[..wanted.len()].copy_from_slice(wanted);
                found.push(Group {
                    place: self.place([i, j]),
                    element: i * size + j,
                    members,
                });
            }
        }
    }
}

/// Elements of the grid near others.
pub struct Elements {
    rows: Vec<Vec<Group>>,
    /// All of them, row by row.
    pub groups: Vec<Group>,
}

impl Elements {
    /// None of a grid.
    pub fn none(layout: Layout) -> Self {
        Self {
            rows: vec![Vec::new(); layout.lengths[0]],
            groups: Vec::new(),
        }
    }

    /// Finds the elements at most the width of the band from those `around` for whose membership in the `set`
    /// `is_wanted` holds. Rows for which `has_changed` does not hold are as before.
    pub fn find(
        &mut self,
        layout: Layout,
        has_changed: impl Fn(usize) -> bool + Sync,
        [around, set]: [&[bool]; 2],
        is_wanted: impl Fn(bool) -> bool + Sync,
    ) {
        let [_, size] = layout.lengths;
        let lines = layout.lines(0);
        let rows = self.rows[lines.clone()].par_iter_mut().zip(lines);
        let rows = rows.with_min_len(ELEMENTS / size + 1);
        rows.filter(|(_, i)| has_changed(*i)).for_each_init(
            || [size + 2 * WIDTH, size].map(|length| vec![false; length]),
            |buffers, (row, i)| layout.find_in_row(i, [around, set], &is_wanted, buffers, row),
        );
        self.groups.clear();
        self.groups.extend(self.rows.iter().flatten());
    }

    /// Marks them in a mask over the grid, or not.
    pub fn mark(&self, mask: &mut [bool], is_marked: bool) {
        for group in &self.groups {
            let members = mask[group.element..].iter_mut().zip(group.members);
            for (value, _) in members.filter(|(_, member)| *member) {
                *value = is_marked;
            }
        }
    }
}
