//! A square part of a grid that holds the whole contact, on which products cost as much less as it is smaller.
//!
//! Only elements with pressure or overlap take part in an iteration; as much of the rest as may overlap is looked at
//! once, by the certificate.

use pellicle_influence::{Sector, SurfaceElasticity};
use rayon::prelude::*;

/// Elements between the contact expected and the window's border, at least.
const MARGIN: usize = 3;
/// A window of more than this part of the grid's side saves less than it costs.
const LARGEST_PART: f64 = 0.9;

/// The margin around the contact expected is its extent over this, at least: it is known to an element or two.
const MARGIN_PART: usize = 24;

/// Elements worth a thread of their own.
const ELEMENTS_PER_THREAD: usize = 1 << 14;

/// Row and column among the elements of a window, which may lie before it: there is a mirror image, or nothing.
pub type Place = [isize; 2];

/// A window of a grid of N × N elements, or of a sector of one; on a quadrant it begins at the axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Window {
    origin: [usize; 2],
    size: usize,
    grid: usize,
    sector: Sector,
}

/// First and last index of some elements along both axes.
#[derive(Debug, Clone, Copy)]
struct IndexRange {
    first: [usize; 2],
    last: [usize; 2],
}

impl Window {
    /// The window that is all of the grid.
    pub fn whole(grid: usize) -> Self {
        Self::all_of(Sector::Whole, grid)
    }

    /// The window that is all of a sector of `grid` elements per side.
    pub fn all_of(sector: Sector, grid: usize) -> Self {
        Self {
            origin: [0, 0],
            size: grid,
            grid,
            sector,
        }
    }

    /// The window that is all of this one's grid.
    pub fn everywhere(&self) -> Self {
        Self::all_of(self.sector, self.grid)
    }

    /// The smallest window of a fast size around those of this window's elements that belong; the whole grid where none
    /// belongs.
    pub fn around(&self, belongs: impl Fn([usize; 2]) -> bool + Sync) -> Self {
        let grid = self.grid;
        let Some(extent) = self.extent(belongs) else {
            return self.everywhere();
        };
        let longest = extent.longest();
        let margin = MARGIN.max(self.sector.parts() * longest / MARGIN_PART);
        // A quadrant has none at the axis.
        let margins = 2 * margin / self.sector.parts();
        let size = SurfaceElasticity::fast_size(longest + margins);
        if size as f64 > LARGEST_PART * grid as f64 {
            return self.everywhere();
        }
        extent.centred(size, &self.everywhere())
    }

    /// The smallest window of a finer grid over the same square that holds what lies within one element of those of
    /// this window that belong; none where none does.
    pub fn on_finer(
        &self,
        belongs: impl Fn([usize; 2]) -> bool + Sync,
        finer: usize,
    ) -> Option<Self> {
        let IndexRange { first, last } = self.extent(belongs)?;
        let low = |i: usize| i.saturating_sub(1) * finer / self.grid;
        let high = |i: usize| ((i + 2) * finer).div_ceil(self.grid).min(finer) - 1;
        let extent = IndexRange {
            first: first.map(low),
            last: last.map(high),
        };
        let everywhere = Self::all_of(self.sector, finer);
        Some(extent.centred(extent.longest(), &everywhere))
    }

    /// First and last of this window's elements that belong, or lie between the axis and those on a quadrant.
    fn extent(&self, belongs: impl Fn([usize; 2]) -> bool + Sync) -> Option<IndexRange> {
        let [above, left] = self.origin;
        let columns = left..left + self.size;
        let of_row = |i: usize| {
            let belongs = |j: &usize| belongs([i, *j]);
            let first = columns.clone().find(belongs)?;
            let last = (first..columns.end).rfind(belongs)?;
            Some(IndexRange {
                first: [i, first],
                last: [i, last],
            })
        };
        let rows = (above..above + self.size).into_par_iter();
        let rows = rows.with_min_len(ELEMENTS_PER_THREAD / self.size + 1);
        let extents: Vec<IndexRange> = rows.filter_map(of_row).collect();
        let extent = extents.into_iter().reduce(IndexRange::and)?;
        Some(match self.sector {
            Sector::Whole => extent,
            Sector::Quadrant => IndexRange {
                first: [0, 0],
                ..extent
            },
        })
    }

    /// The window of twice the side around the same centre.
    pub fn grown(&self) -> Self {
        let size = SurfaceElasticity::fast_size(2 * self.size);
        if size as f64 > LARGEST_PART * self.grid as f64 {
            return self.everywhere();
        }
        self.resized(size)
    }

    /// The window with so many more elements on every side, as far as the grid goes.
    pub fn with_rim(&self, rim: usize) -> Self {
        self.resized((self.size + 2 * rim).min(self.grid))
    }

    /// The window of another, larger size around the same centre, moved into the grid.
    fn resized(&self, size: usize) -> Self {
        let more = (size - self.size) / 2;
        let last = self.grid - size;
        Self {
            origin: self
                .origin
                .map(|first| first.saturating_sub(more).min(last)),
            size,
            ..*self
        }
    }

    /// The other window if it is the larger, else the whole grid.
    pub fn wider(&self, other: Self) -> Self {
        if other.size > self.size {
            other
        } else {
            self.everywhere()
        }
    }

    /// This window as one of another that holds it, which takes the place of the grid.
    pub fn within(&self, other: &Self) -> Self {
        Self {
            origin: [0, 1].map(|axis: usize| self.origin[axis] - other.origin[axis]),
            grid: other.size,
            ..*self
        }
    }

    pub fn is_whole(&self) -> bool {
        self.size == self.grid
    }

    /// Elements per side.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Elements per side of the grid.
    pub fn grid(&self) -> usize {
        self.grid
    }

    /// The sector that this is a window of.
    pub fn sector(&self) -> Sector {
        self.sector
    }

    /// The first element along both axes.
    pub fn origin(&self) -> [usize; 2] {
        self.origin
    }

    /// Elements per side of the whole grid, of which the window's grid is a sector.
    pub fn whole_grid(&self) -> usize {
        self.sector.parts() * self.grid
    }

    /// Indices on the whole grid of the element at a place in the window.
    pub fn index_on_whole(&self, [i, j]: Place) -> [isize; 2] {
        let first = self.sector.first_index(self.whole_grid());
        let [above, left] = self.origin.map(|origin| (first + origin).cast_signed());
        [above + i, left + j]
    }

    /// The element of the window at a place, itself or as the mirror image; none outside the window.
    pub fn element(&self, place: Place) -> Option<usize> {
        let along = |i: isize| {
            let lines = if i < 0 {
                self.sector.mirrored_lines(self.size)
            } else {
                self.size
            };
            let image = if i < 0 { -1 - i } else { i };
            usize::try_from(image).ok().filter(|image| *image < lines)
        };
        Some(along(place[0])? * self.size + along(place[1])?)
    }

    /// The first, by index, of the elements of the whole grid that the element in a row and column stands for.
    pub fn first_image(&self, [row, column]: [usize; 2]) -> [usize; 2] {
        let [above, left] = self.origin;
        let element = [above + row, left + column];
        self.sector.first_image(element, self.whole_grid())
    }

    /// The place of the element whose first image is this element of the whole grid.
    pub fn place_of_image(&self, image: [usize; 2]) -> Place {
        // An element is the first image of its own first image.
        let element = self.sector.first_image(image, self.whole_grid());
        [0, 1].map(|axis: usize| element[axis].cast_signed() - self.origin[axis].cast_signed())
    }

    /// The part of the cell between four places from this one on that belongs to the sector: one across an axis of
    /// symmetry belongs to several quadrants.
    pub fn share_of_cell(&self, place: Place) -> f64 {
        let part = |i: isize| if i < 0 { self.sector.parts() } else { 1 };
        1.0 / place.map(part).iter().product::<usize>() as f64
    }

    /// The elements on the window's border, which the axes of a quadrant are not.
    pub fn border(&self) -> impl Iterator<Item = usize> + use<> {
        let size = self.size;
        let last = size * (size - 1);
        let sides = match self.sector {
            Sector::Whole => 4,
            Sector::Quadrant => 2,
        };
        let of_line = move |i: usize| {
            [last + i, i * size + size - 1, i, i * size]
                .into_iter()
                .take(sides)
        };
        (0..size).flat_map(of_line)
    }

    /// The place within the window of the element in a row and column of the grid; none of one outside.
    pub fn place(&self, [row, column]: [usize; 2]) -> Option<usize> {
        let [line, column] = [
            row.checked_sub(self.origin[0])?,
            column.checked_sub(self.origin[1])?,
        ];
        (line < self.size && column < self.size).then(|| line * self.size + column)
    }

    /// The part of a field of the grid that lies in the window's `line`-th row.
    pub fn line<'a, T>(&self, field: &'a [T], line: usize) -> &'a [T] {
        let [above, left] = self.origin;
        let first = (above + line) * self.grid + left;
        &field[first..first + self.size]
    }

    /// The results of `of_line` for each row of a field on the window, in order.
    pub fn by_lines<T: Send>(
        &self,
        part: &[f64],
        of_line: impl Fn(usize, &[f64]) -> T + Sync,
    ) -> Vec<T> {
        let lines = part.par_chunks(self.size).enumerate();
        let lines = lines.with_min_len(ELEMENTS_PER_THREAD / self.size + 1);
        lines.map(|(line, values)| of_line(line, values)).collect()
    }

    /// Adds a field on the window to the grid's.
    pub fn add(&self, field: &mut [f64], part: &[f64]) {
        let [above, left] = self.origin;
        let lines = field
            .par_chunks_mut(self.grid)
            .skip(above)
            .zip(part.par_chunks(self.size));
        let lines = lines.with_min_len(ELEMENTS_PER_THREAD / self.size + 1);
        lines.for_each(|(line, part)| {
            let line = line[left..left + self.size].iter_mut();
            line.zip(part).for_each(|(to, value)| *to += value);
        });
    }

    /// The part of a field of the grid that lies in the window.
    pub fn cut<T: Copy + Default + Send + Sync>(&self, field: &[T]) -> Vec<T> {
        self.take_over(&self.everywhere(), field)
    }

    /// The field of the whole grid that is `part` in the window and its mirror images, and 0 outside, where no memory
    /// is touched.
    pub fn spread(&self, part: Vec<f64>) -> Vec<f64> {
        match self.sector {
            Sector::Whole if self.is_whole() => part,
            Sector::Whole => self.everywhere().take_over(self, &part),
            Sector::Quadrant => self.unfold(&part),
        }
    }

    /// The same of a window of a quadrant, which begins at the axis.
    fn unfold(&self, part: &[f64]) -> Vec<f64> {
        let (axis, width) = (self.grid, 2 * self.grid);
        let mut field = vec![0.0; width * width];
        let rows = field.par_chunks_exact_mut(width).enumerate();
        let rows = rows.skip(axis - self.size).take(2 * self.size);
        let rows = rows.with_min_len(ELEMENTS_PER_THREAD / self.size + 1);
        rows.for_each(|(i, row)| {
            let line = if i < axis { axis - 1 - i } else { i - axis };
            let values = &part[line * self.size..(line + 1) * self.size];
            let (left, right) = row.split_at_mut(axis);
            right[..self.size].copy_from_slice(values);
            let left = left.iter_mut().rev();
            left.zip(values).for_each(|(left, value)| *left = *value);
        });
        field
    }

    /// The field on this window that is `part` where the other lies in it and 0 elsewhere.
    pub fn take_over<T: Copy + Default + Send + Sync>(&self, other: &Self, part: &[T]) -> Vec<T> {
        let mut field = vec![T::default(); self.size * self.size];
        let [rows, columns] = [0, 1].map(|axis: usize| {
            let first = self.origin[axis].max(other.origin[axis]);
            let end = (self.origin[axis] + self.size).min(other.origin[axis] + other.size);
            first..end.max(first)
        });
        let lines = field.par_chunks_mut(self.size).enumerate();
        let lines = lines.with_min_len(ELEMENTS_PER_THREAD / self.size + 1);
        lines.for_each(|(line, values)| {
            let i = self.origin[0] + line;
            if rows.contains(&i) {
                let to = columns.start - self.origin[1];
                let from = (i - other.origin[0]) * other.size + columns.start - other.origin[1];
                values[to..to + columns.len()].copy_from_slice(&part[from..from + columns.len()]);
            }
        });
        field
    }
}

impl IndexRange {
    /// Elements along the longer side.
    fn longest(&self) -> usize {
        let lengths = [0, 1].map(|axis: usize| self.last[axis] + 1 - self.first[axis]);
        lengths[0].max(lengths[1])
    }

    /// The window of `size` elements per side around the centre, moved into the grid; from the axis on where the extent
    /// reaches from there.
    fn centred(&self, size: usize, everywhere: &Window) -> Window {
        let origin = [0, 1].map(|axis: usize| {
            let twice_centre = self.first[axis] + self.last[axis] + 1;
            (twice_centre.saturating_sub(size) / 2).min(everywhere.grid - size)
        });
        Window {
            origin,
            size,
            ..*everywhere
        }
    }

    /// The smallest extent that holds both.
    fn and(self, other: Self) -> Self {
        Self {
            first: [0, 1].map(|axis: usize| self.first[axis].min(other.first[axis])),
            last: [0, 1].map(|axis: usize| self.last[axis].max(other.last[axis])),
        }
    }
}

#[cfg(test)]
mod tests;
