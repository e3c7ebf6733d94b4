//! Steps of a map, beside which a bicubic surface is limited to the range of its samples.
//!
//! A polynomial through a vertical wall overshoots: ridges of some 5 % of the step along its edge, and smaller ones up
//! to three samples away. They would carry the load of a flat top. Within three samples of a step no height therefore
//! lies outside the range of the four samples around it. Along the step's own wall the surface may jump.
//!
//! A step is a difference between neighbouring samples that is large compared with at least half of all differences of
//! the map, and with those around the next two samples on one side, a plateau. Waves that the samples resolve, pyramids
//! and random roughness have none, so their surface is the same to the last bit.

use std::sync::Arc;

/// A step is so many times larger than half of all differences. The largest of a million random differences is eight
/// times the median.
const TIMES_TYPICAL: f64 = 8.0;

/// A step is so many times larger than each difference along and across the next two samples on one side.
const TIMES_PLATEAU: f64 = 8.0;

/// A step is larger than this part of the range of the map: the tail of a smooth bump is not a step.
const PART_OF_RANGE: f64 = 1e-3;

/// Samples over which the slopes beside a step depend on it.
const REACH: usize = 3;

/// Bits of a positive float below its exponent and four digits: differences are counted in classes of 6 %.
const CLASS: u32 = 48;

/// The samples near steps of a map.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct StepLimit {
    columns: usize,
    is_near: Arc<Vec<bool>>,
}

impl StepLimit {
    /// Finds the steps; none if there are none.
    pub(crate) fn of(heights: &[f64], [rows, columns]: [usize; 2]) -> Option<Self> {
        let at = |i: usize, j: usize| heights[i * columns + j];
        let least_step = least_step(heights, columns)?;
        let mut is_near = vec![false; heights.len()];
        let mut found = false;
        let mut mark = |n: usize| {
            is_near[n] = true;
            found = true;
        };
        for i in 0..rows {
            for j in steps([columns, rows], i, least_step, |j, i| at(i, j)) {
                [j, j + 1].into_iter().for_each(|j| mark(i * columns + j));
            }
        }
        for j in 0..columns {
            for i in steps([rows, columns], j, least_step, at) {
                [i, i + 1].into_iter().for_each(|i| mark(i * columns + j));
            }
        }
        found.then(|| Self {
            columns,
            is_near: Arc::new(widened(&is_near, columns)),
        })
    }

    /// Whether the surface is limited in the cell whose first corner is this sample.
    pub(crate) fn limits(&self, [i, j]: [usize; 2]) -> bool {
        let rows = self.is_near.len() / self.columns;
        let [next, beside] = [(i + 1).min(rows - 1), (j + 1).min(self.columns - 1)];
        let is_near = |i: usize, j: usize| self.is_near[i * self.columns + j];
        is_near(i, j) || is_near(next, j) || is_near(i, beside) || is_near(next, beside)
    }

    /// The range of the samples at the corners of a cell.
    pub(crate) fn range(&self, heights: &[f64], [i, j]: [usize; 2]) -> [f64; 2] {
        let rows = heights.len() / self.columns;
        let lines = i..=(i + 1).min(rows - 1);
        let samples = j..=(j + 1).min(self.columns - 1);
        let corners = lines.flat_map(|i| &heights[i * self.columns..][samples.clone()]);
        range(corners)
    }
}

/// The least and the greatest of some heights.
fn range<'a>(heights: impl Iterator<Item = &'a f64>) -> [f64; 2] {
    heights.fold(
        [f64::INFINITY, f64::NEG_INFINITY],
        |[least, most], height| [least.min(*height), most.max(*height)],
    )
}

/// The smallest difference that may be a step; none on a flat map.
fn least_step(heights: &[f64], columns: usize) -> Option<f64> {
    let [least, most] = range(heights.iter());
    let mut counts = vec![0_usize; 1 << (64 - CLASS)];
    let mut count = |a: f64, b: f64| {
        let class = (a - b).abs().to_bits() >> CLASS;
        counts[usize::try_from(class).unwrap_or_default()] += 1;
    };
    for line in heights.chunks_exact(columns) {
        line.windows(2).for_each(|pair| count(pair[0], pair[1]));
    }
    let next = heights.iter().skip(columns);
    heights.iter().zip(next).for_each(|(a, b)| count(*a, *b));
    let half = counts.iter().sum::<usize>().div_ceil(2);
    let mut below = 0;
    let class = counts.iter().position(|count| {
        below += count;
        below >= half
    })?;
    // The upper end of the class of the median.
    let median = f64::from_bits((class as u64 + 1) << CLASS);
    let least_step = (PART_OF_RANGE * (most - least)).max(TIMES_TYPICAL * median);
    (most > least).then_some(least_step)
}

/// The samples of a line after which there is a step; heights are given by the place on the line and that across it.
fn steps(
    [samples, lines]: [usize; 2],
    line: usize,
    least_step: f64,
    at: impl Fn(usize, usize) -> f64,
) -> Vec<usize> {
    let difference = |k: usize| (at(k + 1, line) - at(k, line)).abs();
    let is_step = |k: &usize| {
        let step = difference(*k);
        if step < least_step {
            return false;
        }
        let most = step / TIMES_PLATEAU;
        // A plateau is level along the line and across it.
        let is_level = |k: usize| {
            let across = [line.saturating_sub(1), (line + 1).min(lines - 1)];
            let mut across = across
                .into_iter()
                .map(|beside| (at(k, beside) - at(k, line)).abs());
            across.all(|difference| difference <= most)
        };
        let is_plateau = |differences: [usize; 2], samples: [usize; 2]| {
            let mut along = differences.into_iter().map(difference);
            along.all(|difference| difference <= most) && samples.into_iter().all(is_level)
        };
        let before = *k >= 2 && is_plateau([k - 1, k - 2], [k - 1, k - 2]);
        let after = k + 3 < samples && is_plateau([k + 1, k + 2], [k + 2, k + 3]);
        before || after
    };
    (0..samples.saturating_sub(1)).filter(is_step).collect()
}

/// The samples at most [`REACH`] away, along either axis, from marked ones.
fn widened(marked: &[bool], columns: usize) -> Vec<bool> {
    let reach = |k: usize, count: usize| k.saturating_sub(REACH)..(k + REACH + 1).min(count);
    let mut along_y = vec![false; marked.len()];
    for (line, wide) in marked
        .chunks_exact(columns)
        .zip(along_y.chunks_exact_mut(columns))
    {
        for j in (0..columns).filter(|j| line[*j]) {
            wide[reach(j, columns)].fill(true);
        }
    }
    let rows = marked.len() / columns;
    let mut all = vec![false; marked.len()];
    for (i, line) in along_y.chunks_exact(columns).enumerate() {
        if !line.contains(&true) {
            continue;
        }
        for wide in all
            .chunks_exact_mut(columns)
            .take((i + REACH + 1).min(rows))
            .skip(i.saturating_sub(REACH))
        {
            wide.iter_mut()
                .zip(line)
                .for_each(|(wide, marked)| *wide |= marked);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{HeightMap, Interpolation};

    /// n × n samples of a surface on the square from −1 to 1.
    fn map(n: usize, surface: impl Fn(f64, f64) -> f64) -> HeightMap {
        let at = |i: usize| (2 * i + 1) as f64 / n as f64 - 1.0;
        let heights = (0..n * n).map(|k| surface(at(k / n), at(k % n)));
        HeightMap::new(heights.collect(), [n; 2], [2.0; 2]).unwrap()
    }

    /// Numbers that look random, from −1 to 1.
    fn noise(x: f64, y: f64) -> f64 {
        let large = 1e4 * (12.9898 * x + 78.233 * y).sin();
        2.0 * (large - large.floor()) - 1.0
    }

    /// Square pillars of height 200 and width 0.4 at a period of 0.8, with this roughness.
    fn pillar(x: f64, y: f64, rough: f64) -> f64 {
        let is_on = |x: f64| (x / 0.8).rem_euclid(1.0) < 0.5;
        let height = if is_on(x) && is_on(y) { 200.0 } else { 0.0 };
        height + rough * noise(x, y)
    }

    #[test]
    fn a_bicubic_surface_beside_steps_stays_within_its_samples_and_is_level_on_flat_tops() {
        let pillars = map(64, |x, y| pillar(x, y, 0.0));
        assert_eq!((pillars.highest(), pillars.lowest()), (200.0, 0.0));
        let linear = pillars.clone().with_interpolation(Interpolation::Linear);
        let mut tops = 0;
        for k in 0..500 * 500 {
            let point = [k / 500, k % 500].map(|i| f64::from(i) * 0.004 - 0.998);
            let [height, straight] = [&pillars, &linear].map(|map| map.height(point));
            // The rounding of 64 products. Without the limit: up to 222 on the tops.
            let rounding = 1e-12;
            let samples = -rounding..=200.0 + rounding;
            assert!(samples.contains(&height), "{point:?}: {height}");
            if straight == 200.0 {
                assert!((height - straight).abs() < rounding, "{point:?}: {height}");
                tops += 1;
            }
        }
        assert!(tops > 10_000);
    }

    #[test]
    fn rough_tops_exceed_the_samples_around_them_by_nothing() {
        // A roughness of 2 on steps of 200; unlimited ridges would be 10 high.
        let pillars = map(64, |x, y| pillar(x, y, 2.0));
        let greatest = pillars.heights().iter().copied().fold(0.0, f64::max);
        assert!(pillars.highest() <= greatest + 1.0, "{}", pillars.highest());
    }

    #[test]
    fn a_blurred_step_and_a_flat_land_around_a_dimple_are_limited() {
        let blurred = map(40, |x, _| (10.0 * x).clamp(0.0, 1.0));
        assert_eq!((blurred.highest(), blurred.lowest()), (1.0, 0.0));
        let dimple = map(40, |x, y| -(0.25 - x * x - y * y).max(0.0));
        assert_eq!(dimple.highest(), 0.0);
    }

    #[test]
    fn smooth_and_random_surfaces_have_no_steps() {
        let none = |name: &str, surface: &dyn Fn(f64, f64) -> f64| {
            let map = map(96, surface);
            assert!(
                StepLimit::of(map.heights(), map.shape()).is_none(),
                "{name}"
            );
        };
        none("flat", &|_, _| 0.1);
        none("tilted", &|x, y| 0.3 * x + 0.1 * y);
        none("paraboloid", &|x, y| x * x + y * y);
        none("ball", &|x, y| (4.0 - x * x - y * y).sqrt());
        none("roller", &|x, _| x * x);
        none("cone", &f64::hypot);
        none("pyramid", &|x, y| x.abs().max(y.abs()));
        none("bump", &|x, y| (-50.0 * (x * x + y * y)).exp());
        none("waves", &|x, y| (60.0 * x).cos() * (60.0 * y).cos());
        none("random", &noise);
    }

    #[test]
    fn a_limited_surface_is_continuous_beside_a_straight_step() {
        let step = map(16, |x, y| if x > 0.0 { 1.0 + 0.01 * y } else { 0.0 });
        for k in 0..200 {
            let y = f64::from(k) * 0.009 - 0.9;
            for line in 3..13 {
                let x = f64::from(2 * line + 1) / 16.0 - 1.0;
                let [before, after] = [-1e-9, 1e-9].map(|by| step.height([x + by, y]));
                assert!((before - after).abs() < 1e-7, "{x}, {y}");
            }
        }
    }
}
