//! The elements on which a field is given: all of a grid, of its half or quadrant or of a cell that repeats, or a
//! square in it that holds the whole contact, on which products cost proportionally less.
//!
//! Only elements with pressure or overlap take part in an iteration; the rest, as far as it may overlap, is checked
//! once, by the certificate.

mod fields;
mod places;

use std::ops::Range;

use pellicle_influence::{SectorGrid, SurfaceElasticity};
use pellicle_texture::{Grid, TextureError};
use rayon::prelude::*;

/// Fewest elements between the expected contact and the region's border.
const MARGIN: usize = 3;

/// Largest side of a region, relative to the grid: beyond this it saves less than it costs.
const LARGEST_PART: f64 = 0.9;

/// The margin around the expected contact is at least its extent divided by this: the contact is known to an element or
/// two.
const MARGIN_PART: usize = 24;

/// Fewest elements per thread.
const ELEMENTS_PER_THREAD: usize = 1 << 14;

/// Row and column relative to a region; negative values denote mirror images, or nothing.
pub type Place = [isize; 2];

/// The boundary condition of a square domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Boundary {
    /// The surface continues without load.
    #[default]
    Free,
    /// The square repeats periodically.
    Periodic,
}

/// A square of a grid, or the part of one within a sector, which begins at the sector's axes; all of the grid, square
/// or oblong, if it repeats.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Region {
    origin: [usize; 2],
    /// Elements per row.
    size: usize,
    grid: SectorGrid,
    boundary: Boundary,
}

impl Region {
    /// The region that is all of a grid of `size` × `size` elements.
    pub fn whole(size: usize) -> Self {
        Self::all_of(SectorGrid::whole(size))
    }

    /// The region that is all of a grid or a sector of one.
    pub fn all_of(grid: SectorGrid) -> Self {
        Self::bounded(grid, Boundary::Free)
    }

    /// The region that is all of a grid of `size` × `size` elements with this boundary condition.
    pub fn domain(size: usize, boundary: Boundary) -> Self {
        Self::bounded(SectorGrid::whole(size), boundary)
    }

    /// The region that is all of a grid with this boundary condition.
    pub fn of_grid(grid: &Grid, boundary: Boundary) -> Self {
        Self::bounded(SectorGrid::oblong(grid.lengths()), boundary)
    }

    /// The same for a sector of a grid; a cell has none.
    pub fn bounded(grid: SectorGrid, boundary: Boundary) -> Self {
        Self {
            origin: [0, 0],
            size: grid.size(),
            grid,
            boundary,
        }
    }

    /// The region that is all of this one's grid.
    pub fn everywhere(&self) -> Self {
        Self::bounded(self.grid, self.boundary)
    }

    /// All of the same domain with other numbers of elements along x and y.
    pub fn with_lengths(&self, lengths: [usize; 2]) -> Self {
        Self::bounded(self.grid.for_lengths(lengths), self.boundary)
    }

    /// The smallest region of a fast size around the elements of this region for which `belongs` holds; the whole grid
    /// if there are none, or if it repeats.
    pub fn around(&self, belongs: impl Fn([usize; 2]) -> bool + Sync) -> Self {
        let extent = if self.repeats() {
            None
        } else {
            self.extent(belongs)
        };
        let Some(extent) = extent else {
            return self.everywhere();
        };
        let side = extent.side_of_square(self.grid);
        let margin = MARGIN.max(side / MARGIN_PART);
        let size = SurfaceElasticity::fast_size(self.grid.for_square(side + 2 * margin).size());
        if size as f64 > LARGEST_PART * self.grid.size() as f64 {
            return self.everywhere();
        }
        self.everywhere().centred(&extent, size)
    }

    /// The same for elements that press, according to the pressure on this region; none if no element presses.
    pub fn around_pressing(&self, pressure: &[f64]) -> Option<Self> {
        let is_pressed = pressure.iter().any(|p| *p > 0.0);
        is_pressed.then(|| self.around(|element| self.presses(pressure, element)))
    }

    /// Whether an element of the grid presses, according to the pressure on this region, which must hold all that do.
    pub fn presses(&self, pressure: &[f64], element: [usize; 2]) -> bool {
        self.place(element).is_some_and(|at| pressure[at] > 0.0)
    }

    /// The smallest region of a finer grid over the same square that covers the elements of this region for which
    /// `belongs` holds, and one more around them; none if there are none.
    pub fn on_finer(
        &self,
        belongs: impl Fn([usize; 2]) -> bool + Sync,
        finer: usize,
    ) -> Option<Self> {
        let IndexRange { first, last } = self.extent(belongs)?;
        let everywhere = Self::bounded(self.grid.with_size(finer), self.boundary);
        let (lines, coarse) = (everywhere.lengths(), self.grid.size());
        let low = |i: usize| i.saturating_sub(1) * finer / coarse;
        let high = |axis: usize| {
            let end = ((last[axis] + 2) * finer).div_ceil(coarse);
            end.min(lines[axis]) - 1
        };
        let extent = IndexRange {
            first: first.map(low),
            last: [0, 1].map(high),
        };
        let square = self.grid.for_square(extent.side_of_square(self.grid));
        Some(everywhere.centred(&extent, square.size()))
    }

    /// The extent of the elements of this region for which `belongs` holds, extended to the axes of the sector.
    fn extent(&self, belongs: impl Fn([usize; 2]) -> bool + Sync) -> Option<IndexRange> {
        let [above, left] = self.origin;
        let [rows, columns] = self.lengths();
        let columns = left..left + columns;
        let of_row = |i: usize| {
            let belongs = |j: &usize| belongs([i, *j]);
            let first = columns.clone().find(belongs)?;
            let last = (first..columns.end).rfind(belongs)?;
            Some(IndexRange {
                first: [i, first],
                last: [i, last],
            })
        };
        let extents = self.in_rows(above..above + rows, &of_row);
        let extent = extents.into_iter().reduce(IndexRange::and)?;
        let first = |axis: usize| {
            if self.grid.mirrored()[axis] {
                0
            } else {
                extent.first[axis]
            }
        };
        Some(IndexRange {
            first: [0, 1].map(first),
            ..extent
        })
    }

    /// The results of some rows, in order; compiled once for all rules.
    fn in_rows(
        &self,
        rows: Range<usize>,
        of_row: &(dyn Fn(usize) -> Option<IndexRange> + Sync),
    ) -> Vec<IndexRange> {
        let rows = rows.into_par_iter().with_min_len(self.rows_per_thread());
        rows.filter_map(of_row).collect()
    }

    /// The region of `size` elements per row around the centre of an extent, moved into the grid; it begins at an axis
    /// if the extent does.
    fn centred(&self, extent: &IndexRange, size: usize) -> Self {
        let (lengths, all) = (self.grid.with_size(size).lengths(), self.lengths());
        let origin = [0, 1].map(|axis: usize| {
            let twice_centre = extent.first[axis] + extent.last[axis] + 1;
            (twice_centre.saturating_sub(lengths[axis]) / 2).min(all[axis] - lengths[axis])
        });
        Self {
            origin,
            size,
            ..*self
        }
    }

    /// The region of twice the side around the same centre.
    pub fn grown(&self) -> Self {
        let size = SurfaceElasticity::fast_size(2 * self.size);
        if size as f64 > LARGEST_PART * self.grid.size() as f64 {
            return self.everywhere();
        }
        self.resized(size)
    }

    /// The region with `rim` more elements on every side, limited to the grid.
    pub fn with_rim(&self, rim: usize) -> Self {
        self.resized((self.size + 2 * rim).min(self.grid.size()))
    }

    /// The region of another, larger size around the same centre, moved into the grid.
    fn resized(&self, size: usize) -> Self {
        let (before, after) = (self.lengths(), self.grid.with_size(size).lengths());
        let all = self.grid.lengths();
        let first = |axis: usize| {
            let more = (after[axis] - before[axis]) / 2;
            let last = all[axis] - after[axis];
            self.origin[axis].saturating_sub(more).min(last)
        };
        Self {
            origin: [0, 1].map(first),
            size,
            ..*self
        }
    }

    /// The other region if it is larger, else the whole grid.
    pub fn wider(&self, other: Self) -> Self {
        if other.size > self.size {
            other
        } else {
            self.everywhere()
        }
    }

    /// This region relative to another that holds it, which replaces the grid.
    pub fn within(&self, other: &Self) -> Self {
        Self {
            origin: [0, 1].map(|axis: usize| self.origin[axis] - other.origin[axis]),
            grid: other.shape(),
            ..*self
        }
    }

    pub fn is_whole(&self) -> bool {
        self.size == self.grid.size()
    }

    /// Elements per row.
    pub fn size(&self) -> usize {
        self.size
    }

    /// The region's elements as a separate grid.
    pub fn shape(&self) -> SectorGrid {
        self.grid.with_size(self.size)
    }

    /// Number of lines before the first element along each axis, out of `reach`, that are mirror images of those on
    /// this side.
    pub fn mirrored_lines(&self, reach: usize) -> [usize; 2] {
        self.grid.mirrored_lines(reach)
    }

    /// Rows, and elements per row.
    pub fn lengths(&self) -> [usize; 2] {
        self.shape().lengths()
    }

    /// Fewest rows per thread.
    fn rows_per_thread(&self) -> usize {
        ELEMENTS_PER_THREAD / self.size + 1
    }

    /// Number of elements.
    pub fn elements(&self) -> usize {
        self.shape().elements()
    }

    /// The boundary condition of the grid.
    pub fn boundary(&self) -> Boundary {
        self.boundary
    }

    /// Whether the region repeats in both directions.
    pub fn repeats(&self) -> bool {
        self.boundary == Boundary::Periodic
    }

    /// Elements along the longer side of the whole grid of which this is a part.
    pub fn grid_size(&self) -> usize {
        self.grid.whole_size()
    }

    /// The whole grid, whose longer side (m) is given.
    pub fn whole_grid(&self, side: f64) -> Result<Grid, TextureError> {
        Grid::oblong(side, self.grid.whole_lengths())
    }

    /// Elements of the whole grid for which one stands, itself included.
    pub fn weight(&self) -> usize {
        self.grid.images()
    }

    /// The grid, or sector of one, of which this is a region.
    pub fn grid(&self) -> SectorGrid {
        self.grid
    }

    /// Index of the grid's first element along each axis of the whole grid.
    pub fn first_index(&self) -> [usize; 2] {
        self.grid.first_index()
    }

    /// Index of the first element along both axes.
    pub fn origin(&self) -> [usize; 2] {
        self.origin
    }
}

/// First and last index of some elements along both axes.
#[derive(Debug, Clone, Copy)]
struct IndexRange {
    first: [usize; 2],
    last: [usize; 2],
}

impl IndexRange {
    /// Elements along the side of the smallest square that holds the range and its mirror images.
    fn side_of_square(&self, grid: SectorGrid) -> usize {
        let parts = grid.parts();
        let lengths =
            [0, 1].map(|axis: usize| parts[axis] * (self.last[axis] + 1 - self.first[axis]));
        lengths[0].max(lengths[1])
    }

    /// The smallest range that holds both.
    fn and(self, other: Self) -> Self {
        Self {
            first: [0, 1].map(|axis: usize| self.first[axis].min(other.first[axis])),
            last: [0, 1].map(|axis: usize| self.last[axis].max(other.last[axis])),
        }
    }
}

#[cfg(test)]
mod tests;
