//! From coarse to fine: each grid is solved from the solution of the one before.
//!
//! The coarser grids give the finest one its start, and their solutions, which cost little, show how every number
//! changes with the grid.

/// The coarsest grid worth a level: below it nothing of an indenter's shape is left.
const COARSEST: usize = 32;
/// Coarser grids are solved to this, or to the finest grid's tolerance if that is looser: far below their own
/// discretisation error, so that their differences show the grid and nothing else.
pub const COARSE_TOLERANCE: f64 = 1e-6;

/// Elements per side of the levels coarser than `finest`, coarsest first; each is half of the next, rounded up.
pub fn coarser_sizes(finest: usize) -> Vec<usize> {
    let halves = std::iter::successors(Some(finest), |size| Some(size.div_ceil(2)));
    let mut sizes: Vec<usize> = halves
        .skip(1)
        .take_while(|size| *size >= COARSEST)
        .collect();
    sizes.reverse();
    sizes
}

/// The pressure of a grid of `from` × `from` elements at the centres of `to` × `to` elements over the same square,
/// bilinear between centres and constant beyond the outermost.
#[must_use]
pub fn prolong(pressure: &[f64], from: usize, to: usize) -> Vec<f64> {
    let places: Vec<(usize, usize, f64)> = (0..to).map(|i| place(i, from, to)).collect();
    let mut fine = Vec::with_capacity(to * to);
    for (low_x, high_x, x) in &places {
        for (low_y, high_y, y) in &places {
            let along_y = |row: usize| {
                (1.0 - y) * pressure[row * from + low_y] + y * pressure[row * from + high_y]
            };
            fine.push((1.0 - x) * along_y(*low_x) + x * along_y(*high_x));
        }
    }
    fine
}

/// The two coarse centres around the `i`-th fine centre and the weight of the second.
fn place(i: usize, from: usize, to: usize) -> (usize, usize, f64) {
    let position = ((i as f64 + 0.5) * from as f64 / to as f64 - 0.5).clamp(0.0, (from - 1) as f64);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to 0 ..= from − 1"
    )]
    let low = position as usize;
    (low, (low + 1).min(from - 1), position - low as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_level_is_half_of_the_next_down_to_the_coarsest() {
        assert_eq!(coarser_sizes(256), [32, 64, 128]);
        assert_eq!(coarser_sizes(300), [38, 75, 150]);
        assert!(coarser_sizes(8).is_empty());
    }

    #[test]
    fn a_plane_is_prolonged_exactly_between_the_outermost_centres() {
        let (from, to) = (8, 15);
        let plane = |i: usize, j: usize, n: usize| {
            (2.0 * i as f64 + 1.0) / n as f64 + 3.0 * (2.0 * j as f64 + 1.0) / n as f64
        };
        let coarse: Vec<f64> = (0..from * from)
            .map(|e| plane(e / from, e % from, from))
            .collect();
        let fine = prolong(&coarse, from, to);
        for (i, j) in [(1, 1), (7, 3), (13, 9)] {
            approx::assert_relative_eq!(fine[i * to + j], plane(i, j, to), max_relative = 1e-14);
        }
    }
}
