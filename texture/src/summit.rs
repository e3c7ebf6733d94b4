//! The highest and the lowest point of a map's surface, which may lie between samples.
//!
//! A bicubic cell is bounded by its Bernstein coefficients. The cells that may be higher than the highest sample are
//! searched, each for its own summits.

use std::ops::Range;

use rayon::prelude::*;

use crate::height_map::HeightMap;
use crate::interpolation::{Interpolation, Stencil};
use crate::patch::{Corner, Patch};

/// Most cells searched, those of the largest bounds: a measured map has a few that come near the highest; one that
/// is a straight wave has some for every sample along its crests.
const MOST_CELLS: usize = 4096;

/// Two summits that differ by less than this, relative to the map's range, count as equally high: the rounding of 64
/// products, with a margin.
const EQUAL: f64 = 1e-13;

/// Lines of cells searched at once.
const BLOCK: usize = 64;

/// A point and the height of the surface there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Summit {
    pub(crate) point: [f64; 2],
    pub(crate) height: f64,
}

impl HeightMap {
    /// The lowest height of the surface, m; a bicubic surface may have it between samples.
    #[must_use]
    pub fn lowest(&self) -> f64 {
        match self.interpolation() {
            Interpolation::Bicubic => summit(self, -1.0).height,
            Interpolation::Linear => self.least(),
        }
    }

    /// The largest height of the surface, m; a bicubic surface may have it between samples.
    #[must_use]
    pub fn highest(&self) -> f64 {
        match self.interpolation() {
            Interpolation::Bicubic => summit(self, 1.0).height,
            Interpolation::Linear => self.greatest(),
        }
    }

    /// The lowest point of the surface, m; of several, the one nearest to the middle of the map.
    #[must_use]
    pub fn lowest_point(&self) -> [f64; 2] {
        match self.interpolation() {
            Interpolation::Bicubic => summit(self, -1.0).point,
            Interpolation::Linear => highest_sample(self, -1.0, 0.0).point,
        }
    }
}

/// The highest point of `sign` times the surface; of several equally high points, the one nearest to the middle of the
/// map.
pub(crate) fn summit(map: &HeightMap, sign: f64) -> Summit {
    let equal = EQUAL * (map.greatest() - map.least());
    let sample = highest_sample(map, sign, equal);
    let mut summits = vec![sample];
    let mut top = sample.height;
    for Cell {
        first,
        patch,
        bound,
    } in Cells::new(map, sign).near_the_top(equal)
    {
        if sample.height + bound < top - equal {
            break;
        }
        for at in patch.summits() {
            let point = map.point_in_cell(first, at);
            let height = sign * map.height(point);
            top = top.max(height);
            summits.push(Summit { point, height });
        }
    }
    let as_high = summits.iter().filter(|summit| summit.height >= top - equal);
    let nearest = as_high.min_by(|a, b| norm(a.point).total_cmp(&norm(b.point)));
    Summit {
        point: nearest.unwrap_or(&sample).point,
        height: sign * top,
    }
}

/// The highest sample of `sign` times the map; of several within `equal`, the nearest to the middle.
fn highest_sample(map: &HeightMap, sign: f64, equal: f64) -> Summit {
    let columns = map.shape()[1];
    let own = |i: usize| map.own_samples(1).map(move |j| [i, j]);
    let samples = map.own_samples(0).flat_map(own);
    let heights = samples.map(|[i, j]| ([i, j], sign * map.heights()[i * columns + j]));
    let top = heights.clone().map(|(_, height)| height);
    let top = top.fold(f64::NEG_INFINITY, f64::max);
    let as_high = heights.filter(|(_, height)| *height >= top - equal);
    let points = as_high.map(|(sample, _)| map.point(sample));
    let nearest = points.min_by(|a, b| norm(*a).total_cmp(&norm(*b)));
    Summit {
        point: nearest.unwrap_or_default(),
        height: top,
    }
}

fn norm([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

/// A cell that may be higher than the highest sample.
#[derive(Clone)]
struct Cell {
    /// Its first sample.
    first: [usize; 2],
    /// The cell, relative to the highest sample.
    patch: Patch,
    /// Its bound, relative to the highest sample.
    bound: f64,
}

/// The cells of a bicubic surface, above the highest sample and with the sign of the search.
struct Cells<'a> {
    map: &'a HeightMap,
    sign: f64,
    /// The highest sample; heights are taken relative to it, so that a map far from its reference plane loses no
    /// accuracy.
    top: f64,
    /// The stencil of the slope at each sample along x and along y.
    slopes: [Vec<Stencil>; 2],
}

impl<'a> Cells<'a> {
    fn new(map: &'a HeightMap, sign: f64) -> Self {
        let stencils = |axis: usize| {
            let samples = map.shape()[axis];
            (0..samples).map(|i| Stencil::slope(i, samples)).collect()
        };
        Self {
            map,
            sign,
            top: if sign > 0.0 {
                map.greatest()
            } else {
                map.least()
            },
            slopes: [stencils(0), stencils(1)],
        }
    }

    /// The height of a sample above the highest one: not positive.
    fn height(&self, [i, j]: [usize; 2]) -> f64 {
        self.sign * (self.map.heights()[i * self.map.shape()[1] + j] - self.top)
    }

    /// Heights, slopes and twists at a line of samples of constant x.
    fn line(&self, i: usize) -> Vec<Corner> {
        let columns = self.map.shape()[1];
        let mut along_x = vec![0.0; columns];
        for (k, weight) in self.slopes[0][i].terms() {
            let samples = along_x.iter_mut().enumerate();
            samples.for_each(|(j, sum)| *sum += weight * self.height([k, j]));
        }
        let corner = |j: usize| {
            let stencil = &self.slopes[1][j];
            let weighted = |of: &dyn Fn(usize) -> f64| -> f64 {
                stencil.terms().map(|(k, weight)| weight * of(k)).sum()
            };
            Corner {
                height: self.height([i, j]),
                along_x: along_x[j],
                along_y: weighted(&|k| self.height([i, k])),
                twist: weighted(&|k| along_x[k]),
            }
        };
        (0..columns).map(corner).collect()
    }

    /// The cells that may be higher than the highest sample by more than `equal`, with their bounds (m), in falling
    /// order; of equal ones, those nearest to the middle of the map first.
    fn near_the_top(&self, equal: f64) -> Vec<Cell> {
        let Range { start, end: last } = self.map.own_cells(0);
        let blocks = (start..last).into_par_iter().step_by(BLOCK);
        let found =
            blocks.map(|first| self.near_the_top_in(first..(first + BLOCK).min(last), equal));
        let mut found = found.collect::<Vec<_>>().concat();
        self.cut(&mut found);
        found
    }

    /// These cells between some lines of samples and the next.
    fn near_the_top_in(&self, lines: Range<usize>, equal: f64) -> Vec<Cell> {
        let [rows, columns] = self.map.shape();
        let mut found = Vec::new();
        let mut next = self.line(lines.start);
        for i in lines {
            let line = std::mem::replace(&mut next, self.line((i + 1).min(rows - 1)));
            let is_high = |corner: &Corner| corner.bound() > equal;
            let pairs = line.iter().zip(&next);
            let high: Vec<bool> = pairs.map(|(a, b)| is_high(a) | is_high(b)).collect();
            for j in self.map.own_cells(1) {
                let k = (j + 1).min(columns - 1);
                if !(high[j] || high[k]) {
                    continue;
                }
                let patch = Patch::new([[line[j], line[k]], [next[j], next[k]]]);
                let bound = patch.bound();
                if bound > equal && !self.map.is_limited([i, j]) {
                    found.push(Cell {
                        first: [i, j],
                        patch,
                        bound,
                    });
                }
            }
            if found.len() > MOST_CELLS {
                self.cut(&mut found);
            }
        }
        found
    }

    /// Sorts cells and keeps the first ones.
    fn cut(&self, cells: &mut Vec<Cell>) {
        let distance = |cell: &Cell| norm(self.map.point_in_cell(cell.first, [0.5; 2]));
        cells.sort_by(|a, b| {
            let by_bound = b.bound.total_cmp(&a.bound);
            by_bound.then(distance(a).total_cmp(&distance(b)))
        });
        cells.truncate(MOST_CELLS);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 24 × 30 samples of a surface over a rectangle of 2.4 × 3.
    fn map(surface: impl Fn(f64, f64) -> f64) -> HeightMap {
        let at = |k: u32, count: u32| (f64::from(k) + 0.5 - f64::from(count) / 2.0) * 0.1;
        let heights = (0..24 * 30).map(|n| surface(at(n / 30, 24), at(n % 30, 30)));
        HeightMap::new(heights.collect(), [24, 30], [2.4, 3.0]).unwrap()
    }

    #[test]
    fn a_crest_between_samples_is_located() {
        let map = map(|x, y| 7.0 - (x - 0.123).powi(2) - 2.0 * (y + 0.456).powi(2));
        let found = summit(&map, 1.0);
        // The quadratic is reproduced, and its slope locates the summit to a few roundings of heights up to 7 over a
        // second derivative of 2.
        assert!((found.height - 7.0).abs() < 1e-14, "{found:?}");
        let [x, y] = found.point;
        assert!((x - 0.123).hypot(y + 0.456) < 1e-13, "{found:?}");
        assert_eq!(summit(&map, -1.0).point, map.point([0, 29]));
    }

    #[test]
    fn no_height_of_a_rough_map_lies_above_its_summit_or_below_its_ground() {
        let map = map(|x, y| {
            // Waves of 4 samples and more in all directions.
            let wave =
                |k: f64| (15.7 * k * (x * (9.0 * k).cos() + y * (9.0 * k).sin()) + 40.0 * k).cos();
            wave(0.99) + wave(0.7) + wave(0.45) + 0.6 * wave(0.2)
        });
        let [top, bottom] = [1.0, -1.0].map(|sign| summit(&map, sign));
        assert!(top.height > map.greatest() && bottom.height < map.least());
        for n in 0..400 * 500 {
            let [i, j] = [n / 500, n % 500].map(f64::from);
            let height = map.height([i * 0.006 - 1.2, j * 0.006 - 1.5]);
            assert!(height <= top.height && height >= bottom.height, "{i}, {j}");
        }
    }

    /// A map of the same surface after one of the eight symmetries of the square.
    fn transformed(map: &HeightMap, symmetry: usize) -> HeightMap {
        let [rows, columns] = map.shape();
        let [width, height] = map.extent();
        let swaps = symmetry & 4 != 0;
        let (shape, extent) = if swaps {
            ([columns, rows], [height, width])
        } else {
            ([rows, columns], [width, height])
        };
        let sample = |n: usize| {
            let [mut i, mut j] = [n / shape[1], n % shape[1]];
            if swaps {
                (i, j) = (j, i);
            }
            if symmetry & 1 != 0 {
                i = rows - 1 - i;
            }
            if symmetry & 2 != 0 {
                j = columns - 1 - j;
            }
            map.heights()[i * columns + j]
        };
        let heights = (0..rows * columns).map(sample).collect();
        HeightMap::new(heights, shape, extent).unwrap()
    }

    #[test]
    fn maps_mirrored_and_turned_have_the_same_summits_to_rounding() {
        for seed in 0..200_u32 {
            let shape = [2 + seed as usize % 7, 2 + seed as usize % 5];
            // Numbers that look random, from 0 to 1; some maps are rounded, so that samples are equal.
            let sample = |n: u32| {
                let x = (f64::from(n * 200 + seed) * 12.9898).sin() * 43_758.545;
                let x = x - x.floor();
                if seed % 3 == 0 {
                    (4.0 * x).round() / 4.0
                } else {
                    x
                }
            };
            let count = u32::try_from(shape[0] * shape[1]).unwrap();
            let map = HeightMap::new((0..count).map(sample).collect(), shape, [2.1, 2.5]).unwrap();
            for sign in [1.0, -1.0] {
                let wanted = summit(&map, sign);
                for symmetry in 0..8 {
                    let found = summit(&transformed(&map, symmetry), sign);
                    let apart = (found.height - wanted.height).abs();
                    assert!(apart < 1e-14, "{seed}, {symmetry}: {apart:e}");
                    // Of several equal summits, each way may find another one as near to the middle.
                    let apart = (norm(found.point) - norm(wanted.point)).abs();
                    assert!(apart < 1e-7, "{seed}, {symmetry}: {apart:e}");
                }
                assert!(sign * map.height(wanted.point) <= sign * wanted.height);
                for k in 0..41 * 41 {
                    let point = [
                        1.05 * (f64::from(k / 41) / 20.0 - 1.0),
                        1.25 * (f64::from(k % 41) / 20.0 - 1.0),
                    ];
                    let over = sign * (map.height(point) - wanted.height);
                    assert!(over < 1e-14, "{seed}: {over:e}");
                }
            }
        }
    }

    /// The corner of a measured map whose summit lies on a long crest beside sample (1, 0). Searching ever smaller
    /// squares around the highest point found loses it on one side: 3e-6 of the range too low.
    #[test]
    fn a_summit_on_a_long_crest_near_the_rim_is_found_from_both_sides() {
        let heights = vec![
            1246.40, 1100.85, 847.63, 602.74, 547.89, 673.95, 1481.21, 1335.83, 887.03, 552.38,
            505.91, 693.21, 1135.99, 1009.37, 636.99, 350.46, 99.05, 413.75, 901.63, 633.43,
            316.87, 93.66, 112.91, 387.10, 666.99, 517.47, 266.25, 0.00, 170.60, 279.13, 575.82,
            463.11, 403.08, 23.71, 102.22, 328.26,
        ];
        let map = HeightMap::new(heights, [6, 6], [6.0, 6.0]).unwrap();
        let wanted = summit(&map, 1.0).height;
        for symmetry in 1..8 {
            let found = summit(&transformed(&map, symmetry), 1.0).height;
            // Some roundings of 1500.
            assert!(
                (found - wanted).abs() < 1e-12,
                "{symmetry}: {found} {wanted}"
            );
        }
    }

    #[test]
    fn the_summit_of_a_flat_top_is_its_point_nearest_to_the_middle() {
        let flat = HeightMap::new(vec![1e3; 25], [5, 5], [1.0, 1.0]).unwrap();
        assert_eq!(
            summit(&flat, 1.0),
            Summit {
                point: [0.0, 0.0],
                height: 1e3
            }
        );
        let two = HeightMap::new(vec![2.0, 1.0, 1.0, 2.0, 1.0], [5, 1], [5.0, 1.0]).unwrap();
        assert_eq!(summit(&two, 1.0).point[0].abs(), 1.0);
    }
}
