//! Where the band's elements lie, on the grid and in the field that its stencil is laid over.

use std::ops::Range;

use rayon::prelude::*;

use super::{
    REACH,
    part::{LANES, ROWS},
};
use crate::grid::sector::Sector;

/// Elements from the set to the outer rim of the band, along both axes. One more gains nothing, one less costs a tenth more products.
const WIDTH: usize = 3;
/// The band, its coefficients and the last neighbours of a block stay on the grid.
const MARGIN: usize = 3;
const _: () = assert!(MARGIN >= WIDTH && MARGIN >= REACH && MARGIN + 1 >= LANES);

/// The elements, and where they lie in the field that the stencil is laid over.
#[derive(Clone, Copy)]
pub struct BandGrid {
    /// Elements per side.
    pub size: usize,
    /// Rows and columns before the first that the stencil reaches.
    beyond: usize,
}

impl BandGrid {
    pub fn new(size: usize, sector: Sector) -> Self {
        let beyond = match sector {
            Sector::Whole => 0,
            Sector::Quadrant => REACH,
        };
        Self { size, beyond }
    }

    /// Places in a row.
    pub fn width(self) -> usize {
        self.size + self.beyond
    }

    /// A field of zeros that the stencil can be laid over, with some room behind it.
    pub fn field(self) -> Vec<f32> {
        vec![0.0; self.width().pow(2) + LANES]
    }

    /// Where an element lies.
    pub fn place(self, [i, j]: [usize; 2]) -> usize {
        (i + self.beyond) * self.width() + j + self.beyond
    }

    /// Where the mirror images of an element lie that the stencil reaches beyond the axes.
    pub fn images(self, [i, j]: [usize; 2]) -> impl Iterator<Item = usize> {
        // The image of the element k from the axis lies as far on the other side.
        let along = move |k: usize| {
            let other = self.beyond.checked_sub(k + 1);
            std::iter::once(k + self.beyond).chain(other)
        };
        let places = along(i).flat_map(move |i| along(j).map(move |j| i * self.width() + j));
        places.skip(1)
    }

    /// Where the rows of a part begin.
    pub fn first_place(self, part: usize) -> usize {
        (part * ROWS + self.beyond) * self.width()
    }

    /// The rows of each part.
    pub fn rows_of(self, spread: &mut [f32]) -> impl IndexedParallelIterator<Item = &mut [f32]> {
        let rows = self.first_place(0)..self.width().pow(2);
        spread[rows].par_chunks_mut(ROWS * self.width())
    }

    /// Rows, and columns, that the band may lie in: neither it nor the stencil leaves the grid.
    pub fn lines(self) -> Range<usize> {
        let first = if self.beyond > 0 { 0 } else { MARGIN };
        first..self.size.saturating_sub(MARGIN)
    }
}

/// What is near the set, and what of it is of the band, in one row.
pub struct RowBuffers {
    /// Whether the set is within [`WIDTH`] along the column: of each of the row's elements, with as many on both sides.
    near: Vec<bool>,
    pub band: Vec<bool>,
}

impl RowBuffers {
    pub fn new(size: usize) -> Self {
        Self {
            near: vec![false; size + 2 * WIDTH],
            band: vec![false; size],
        }
    }

    /// Finds the band in row `i`.
    pub fn find(&mut self, grid: BandGrid, i: usize, mask: &[bool]) {
        let (Self { near, band }, size) = (self, grid.size);
        near.fill(false);
        band.fill(false);
        // What lies beyond an axis is mirrored by what lies on this side, and nearer.
        let first = i.saturating_sub(WIDTH);
        for row in mask[first * size..(i + WIDTH + 1) * size].chunks_exact(size) {
            let near = near[WIDTH..].iter_mut();
            near.zip(row).for_each(|(near, member)| *near |= member);
        }
        if !near.contains(&true) {
            return;
        }
        for shift in 0..=2 * WIDTH {
            let band = band.iter_mut().zip(&near[shift..]);
            band.for_each(|(band, near)| *band |= near);
        }
        let own = &mask[i * size..(i + 1) * size];
        (band.iter_mut().zip(own)).for_each(|(band, member)| *band &= !member);
        band[..grid.lines().start].fill(false);
        band[grid.lines().end..].fill(false);
    }
}
