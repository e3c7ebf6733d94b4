//! A square part of a grid that holds the whole contact, on which products cost as much less as it is smaller.
//!
//! Only elements with pressure or overlap take part in an iteration; the rest of the grid is looked at once, by the
//! certificate.

use pellicle_influence::SurfaceElasticity;
use rayon::prelude::*;

/// Elements between the contact expected and the window's border, at least.
const MARGIN: usize = 3;
/// A window of more than this part of the grid's side saves less than it costs.
const LARGEST_PART: f64 = 0.9;

/// The margin around the contact expected is its extent over this, at least: it is known to an element or two.
const MARGIN_PART: usize = 24;

/// What a window is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Room {
    /// One load: the window is as small as it may be.
    ForOne,
    /// A path of loads: windows are of few sizes, so that several loads share what is made for one.
    ForMany,
}

impl Room {
    /// The size of a window of no less than `least` elements along a side.
    fn size(self, least: usize) -> usize {
        SurfaceElasticity::fast_size(match self {
            Self::ForOne => least,
            // Eighths of a power of two: larger by a quarter at most.
            Self::ForMany => least.next_multiple_of((least.next_power_of_two() / 8).max(1)),
        })
    }
}

/// A window of a grid of N × N elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Window {
    origin: [usize; 2],
    size: usize,
    grid: usize,
}

/// First and last index of some elements along both axes.
#[derive(Debug, Clone, Copy)]
struct Extent {
    first: [usize; 2],
    last: [usize; 2],
}

impl Window {
    /// The window that is all of the grid.
    pub fn whole(grid: usize) -> Self {
        Self {
            origin: [0, 0],
            size: grid,
            grid,
        }
    }

    /// The smallest window of a fast size around the elements that belong; the whole grid where none belongs.
    pub fn around(grid: usize, belongs: impl Fn(usize) -> bool + Sync, room: Room) -> Self {
        let Some(extent) = Extent::of(grid, belongs) else {
            return Self::whole(grid);
        };
        let longest = [0, 1].map(|axis: usize| extent.last[axis] + 1 - extent.first[axis]);
        let longest = longest[0].max(longest[1]);
        let margin = MARGIN.max(longest / MARGIN_PART);
        let size = room.size(longest + 2 * margin);
        if size as f64 > LARGEST_PART * grid as f64 {
            return Self::whole(grid);
        }
        let origin = [0, 1].map(|axis: usize| {
            let twice_centre = extent.first[axis] + extent.last[axis] + 1;
            (twice_centre.saturating_sub(size) / 2).min(grid - size)
        });
        Self { origin, size, grid }
    }

    /// The window of twice the side around the same centre.
    pub fn grown(&self) -> Self {
        let size = SurfaceElasticity::fast_size(2 * self.size);
        if size as f64 > LARGEST_PART * self.grid as f64 {
            return Self::whole(self.grid);
        }
        let origin = self.origin.map(|first| {
            first
                .saturating_sub((size - self.size) / 2)
                .min(self.grid - size)
        });
        Self {
            origin,
            size,
            grid: self.grid,
        }
    }

    /// The other window if it is the larger, else the whole grid.
    pub fn wider(&self, other: Self) -> Self {
        if other.size > self.size {
            other
        } else {
            Self::whole(self.grid)
        }
    }

    pub fn is_whole(&self) -> bool {
        self.size == self.grid
    }

    /// Elements per side.
    pub fn size(&self) -> usize {
        self.size
    }

    /// The first element along both axes.
    pub fn origin(&self) -> [usize; 2] {
        self.origin
    }

    /// The part of a field of the grid that lies in the window.
    pub fn cut(&self, field: &[f64]) -> Vec<f64> {
        let [first, left] = self.origin;
        let mut part = vec![0.0; self.size * self.size];
        let rows = field.par_chunks(self.grid).skip(first);
        let rows = part.par_chunks_mut(self.size).zip(rows);
        rows.for_each(|(values, row)| values.copy_from_slice(&row[left..left + self.size]));
        part
    }

    /// The field of the grid that is `part` in the window and 0 outside.
    pub fn spread(&self, part: &[f64]) -> Vec<f64> {
        let [first, left] = self.origin;
        let mut field = vec![0.0; self.grid * self.grid];
        let rows = field.par_chunks_mut(self.grid).skip(first);
        let rows = rows.zip(part.par_chunks(self.size));
        rows.for_each(|(row, values)| row[left..left + self.size].copy_from_slice(values));
        field
    }
}

impl Extent {
    fn of(grid: usize, belongs: impl Fn(usize) -> bool + Sync) -> Option<Self> {
        let rows = (0..grid).into_par_iter();
        let of_row = |i: usize| {
            let first = (0..grid).find(|j| belongs(i * grid + j))?;
            let last = (first..grid).rfind(|j| belongs(i * grid + j))?;
            Some(Self {
                first: [i, first],
                last: [i, last],
            })
        };
        let extents: Vec<Self> = rows.filter_map(of_row).collect();
        extents.into_iter().reduce(Self::and)
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
mod tests {
    use std::collections::BTreeSet;

    use super::{Room, Window};

    #[test]
    fn a_window_holds_what_belongs_with_a_margin() {
        let belongs = |e: usize| (e / 200) / 10 == 7 && (e % 200) / 20 == 9;
        let window = Window::around(200, belongs, Room::ForOne);
        let mask: Vec<f64> = (0..200 * 200)
            .map(|e| f64::from(u8::from(belongs(e))))
            .collect();
        let part = window.cut(&mask);
        assert!(window.size() < 40 && !window.is_whole());
        assert_eq!(window.spread(&part), mask);
        // The elements lie at the grid's end along y, but nowhere else at the window's border.
        let last = window.size() - 1;
        let border =
            |e: &usize| [0, last].contains(&(e / window.size())) || e.is_multiple_of(window.size());
        assert!((0..part.len()).filter(border).all(|e| part[e] == 0.0));
    }

    #[test]
    fn a_window_grows_until_it_is_the_whole_grid() {
        let mut window = Window::around(500, |e| e == 250 * 500 + 3, Room::ForOne);
        for _ in 0..8 {
            window = window.grown();
        }
        assert_eq!(window, Window::whole(500));
        assert!(Window::around(500, |_| false, Room::ForOne).is_whole());
    }

    #[test]
    fn many_loads_share_windows_of_few_sizes() {
        let mut sizes = BTreeSet::new();
        for half in 20..150 {
            let inside = |i: usize| i.abs_diff(250) < half;
            let belongs = |e: usize| inside(e / 500) && inside(e % 500);
            let [one, many] =
                [Room::ForOne, Room::ForMany].map(|room| Window::around(500, belongs, room));
            assert!(one.size() <= many.size() && 4 * many.size() <= 5 * one.size());
            sizes.insert(many.size());
        }
        assert!(sizes.len() <= 14, "{sizes:?}");
    }
}
