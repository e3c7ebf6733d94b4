//! The range of rows and columns of some elements of a window.

use pellicle_influence::SectorGrid;

/// First and last index of some elements along both axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct IndexRange {
    pub first: [usize; 2],
    pub last: [usize; 2],
}

impl IndexRange {
    /// Elements along the side of the smallest square that holds the range and its mirror images.
    pub fn side_of_square(&self, grid: SectorGrid) -> usize {
        let parts = grid.parts();
        let lengths =
            [0, 1].map(|axis: usize| parts[axis] * (self.last[axis] + 1 - self.first[axis]));
        lengths[0].max(lengths[1])
    }

    /// The smallest range that holds both.
    pub fn and(self, other: Self) -> Self {
        Self {
            first: [0, 1].map(|axis: usize| self.first[axis].min(other.first[axis])),
            last: [0, 1].map(|axis: usize| self.last[axis].max(other.last[axis])),
        }
    }
}
