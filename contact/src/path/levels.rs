//! The grids of a path, and the accuracy of the coarser ones.
//!
//! The coarser grids provide the start for the finest one, and their cheap solutions show how each result changes with
//! the grid.

use pellicle_influence::SectorGrid;
use pellicle_texture::Grid;

use crate::{Boundary, Method, Model, SolverOptions};

/// The coarsest grid of a path: a contact has about four elements across the radius.
const COARSEST: usize = 12;
/// A grid of at least as many elements has two coarser ones, enough to estimate an error.
pub const FEWEST_FOR_THREE_GRIDS: usize = 4 * COARSEST;
/// Tolerance of the coarser grids, unless that of the finest grid is looser: far below their own discretisation error,
/// so that their differences show only the effect of the grid.
pub const COARSE_TOLERANCE: f64 = 1e-6;

/// Elements per side of the levels coarser than `finest`, coarsest first; each is half of the next, rounded up to an
/// even number, as mirror images require.
pub fn coarser_sizes(finest: usize) -> Vec<usize> {
    let half = |size: &usize| Some(size.div_ceil(2).next_multiple_of(2));
    let halves = std::iter::successors(Some(finest), half);
    let mut sizes: Vec<usize> = halves
        .skip(1)
        .take_while(|size| *size >= COARSEST)
        .collect();
    sizes.reverse();
    sizes
}

/// The elements along x and y of the levels coarser than a grid, coarsest first. On an oblong grid they end where the
/// shorter side would no longer be a whole number of square elements.
pub fn coarser_lengths(finest: [usize; 2]) -> Vec<[usize; 2]> {
    let longer = finest[0].max(finest[1]);
    let lengths = |size: &usize| {
        let exact = |length: usize| (length * size).is_multiple_of(longer);
        let along = |length: usize| length * size / longer;
        finest.into_iter().all(exact).then(|| finest.map(along))
    };
    let sizes = coarser_sizes(longer);
    let mut coarser: Vec<_> = sizes.iter().rev().map_while(lengths).collect();
    coarser.reverse();
    coarser
}

/// The elements that a path solves on a grid: a quadrant or a half of an even one if
/// the [model's symmetry](Model::sector) and the options allow it, else all.
#[must_use]
pub fn solved_grid(
    model: &Model,
    grid: &Grid,
    boundary: Boundary,
    options: &SolverOptions,
) -> SectorGrid {
    let is_for_sectors = options.method == Method::Gradient && options.mirror_symmetry;
    if boundary == Boundary::Free && grid.size().is_multiple_of(2) && is_for_sectors {
        SectorGrid::of_square(model.sector(), grid.size())
    } else {
        SectorGrid::oblong(grid.lengths())
    }
}

#[cfg(test)]
mod tests {
    use super::{coarser_lengths, coarser_sizes};

    #[test]
    fn each_level_is_half_of_the_next_down_to_the_coarsest() {
        assert_eq!(coarser_sizes(256), [16, 32, 64, 128]);
        assert_eq!(coarser_sizes(300), [20, 38, 76, 150]);
        assert_eq!(coarser_sizes(48), [12, 24]);
        assert!(coarser_sizes(20).is_empty() && coarser_sizes(8).is_empty());
    }

    #[test]
    fn levels_of_an_oblong_grid_keep_its_shape() {
        let wanted = [[12, 16], [24, 32], [48, 64]];
        assert_eq!(coarser_lengths([96, 128]), wanted);
        assert_eq!(coarser_lengths([128, 96]), wanted.map(|[x, y]| [y, x]));
        // 37.5 elements would be half of 75.
        assert_eq!(coarser_lengths([150, 200]), [[75, 100]]);
        let square = coarser_sizes(300).into_iter().map(|size| [size; 2]);
        assert!(square.eq(coarser_lengths([300; 2])));
    }
}
