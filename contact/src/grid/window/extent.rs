//! The rows and columns that some elements of a window take.

use pellicle_influence::Sector;
use rayon::prelude::*;

use super::Window;

/// First and last index of some elements along both axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct IndexRange {
    pub first: [usize; 2],
    pub last: [usize; 2],
}

impl Window {
    /// First and last of this window's elements that belong, or lie between those and an axis of the sector.
    pub(super) fn extent(&self, belongs: impl Fn([usize; 2]) -> bool + Sync) -> Option<IndexRange> {
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
        let rows = (above..above + rows).into_par_iter();
        let rows = rows.with_min_len(self.rows_per_thread());
        let extents: Vec<IndexRange> = rows.filter_map(of_row).collect();
        let extent = extents.into_iter().reduce(IndexRange::and)?;
        let first = |axis: usize| {
            if self.sector.mirrored()[axis] {
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
}

impl IndexRange {
    /// Elements along the side of the smallest square that holds them and their mirror images.
    pub fn side_of_square(&self, sector: Sector) -> usize {
        let parts = sector.parts();
        let lengths =
            [0, 1].map(|axis: usize| parts[axis] * (self.last[axis] + 1 - self.first[axis]));
        lengths[0].max(lengths[1])
    }

    /// The window of `size` elements a row around the centre, moved into the grid; from the axis on where the extent
    /// reaches from there.
    pub fn centred(&self, size: usize, everywhere: &Window) -> Window {
        let (lengths, all) = (everywhere.sector.lengths(size), everywhere.lengths());
        let origin = [0, 1].map(|axis: usize| {
            let twice_centre = self.first[axis] + self.last[axis] + 1;
            (twice_centre.saturating_sub(lengths[axis]) / 2).min(all[axis] - lengths[axis])
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
