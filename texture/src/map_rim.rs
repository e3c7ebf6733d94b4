//! The rim of a map: how well its opposite edges fit together, and a map whose edges do.
//!
//! In a periodic cell the last samples of a map are neighbours of its first ones. A scan cut out of a larger surface
//! does not continue so: the step across its rim is a wall, which carries the load of a flat.
//!
//! **The part that continues.** Half of the step is taken from either edge. With `h` the map, `v` the steps across its
//! rim, with opposite signs on the two sides, and `Δ` the difference operator of a periodic map, the part `s` that is
//! subtracted solves `Δ s = v` with mean 0 (Moisan, Journal of Mathematical Imaging and Vision 39, 2011). Inside, `s`
//! is harmonic: a wave of the step fades from the rim inwards as `exp(−2π d/λ)`, over a sixth of its own length `λ`.
//! Short waves therefore stay as they are beyond the first samples, and long ones are bent as little as possible.

use std::f64::consts::TAU;

use pellicle_fourier::{Complex, Transformed};
use rayon::prelude::*;

use crate::HeightMap;

/// The step across the rim of a map against the steps between its neighbouring lines of samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RimStep {
    /// Root mean square of the difference between the last and the first line, m.
    pub across: f64,
    /// The same between neighbouring lines of samples inside, the largest of all pairs, m.
    pub inside: f64,
}

impl RimStep {
    /// The step along x, and that along y.
    #[must_use]
    pub fn of(map: &HeightMap) -> [Self; 2] {
        let ([rows, columns], heights) = (map.shape(), map.heights());
        let between = |first: usize, second: usize, axis: usize| {
            let (lines, at): (usize, &dyn Fn(usize, usize) -> f64) = match axis {
                0 => (columns, &|line, k| heights[line * columns + k]),
                _ => (rows, &|line, k| heights[k * columns + line]),
            };
            let squares = (0..lines).map(|k| (at(first, k) - at(second, k)).powi(2));
            (squares.sum::<f64>() / lines as f64).sqrt()
        };
        [0, 1].map(|axis| {
            let last = map.shape()[axis] - 1;
            let inside = (0..last).map(|line| between(line, line + 1, axis));
            Self {
                across: between(last, 0, axis),
                inside: inside.fold(0.0, f64::max),
            }
        })
    }
}

impl HeightMap {
    /// The part of the map that continues periodically: half of the step across the rim is taken from either edge, each
    /// of its waves fading inwards within its own length.
    #[must_use]
    pub fn tapered(self) -> Self {
        let smooth = smooth_part(&self);
        let heights = self.heights().iter().zip(smooth);
        let heights = heights.map(|(height, smooth)| height - smooth);
        let heights = heights.collect();
        self.with_heights(heights)
    }
}

/// `s`, m.
fn smooth_part(map: &HeightMap) -> Vec<f64> {
    let ([rows, columns], pixel) = (map.shape(), map.pixel());
    let weight = pixel.map(|side| (pixel[0] / side).powi(2));
    let mut waves: Vec<Complex<f64>> = steps(map, weight)
        .into_iter()
        .map(|step| Complex::new(step, 0.0))
        .collect();
    transform(&mut waves, [rows, columns], Direction::Forward);
    // Δ exp(i(k x + l y)) = (2 cos k − 2 + 2 cos l − 2) exp(…)
    let along = |k: usize, n: usize| 2.0 * (TAU * k as f64 / n as f64).cos() - 2.0;
    let lines = waves.par_chunks_mut(columns).enumerate();
    lines.for_each(|(k, line)| {
        for (l, wave) in line.iter_mut().enumerate() {
            let operator = weight[0] * along(k, rows) + weight[1] * along(l, columns);
            *wave = match [k, l] {
                [0, 0] => Complex::default(),
                _ => *wave / operator,
            };
        }
    });
    transform(&mut waves, [rows, columns], Direction::Inverse);
    let count = waves.len() as f64;
    waves.into_iter().map(|wave| wave.re / count).collect()
}

/// `v`: the steps across the rim, at the samples beside it.
fn steps(map: &HeightMap, weight: [f64; 2]) -> Vec<f64> {
    let ([rows, columns], heights) = (map.shape(), map.heights());
    let mut steps = vec![0.0; heights.len()];
    let mut add = |first: usize, last: usize, weight: f64| {
        let step = weight * (heights[last] - heights[first]);
        steps[first] += step;
        steps[last] -= step;
    };
    (0..columns).for_each(|j| add(j, (rows - 1) * columns + j, weight[0]));
    (0..rows).for_each(|i| add(i * columns, (i + 1) * columns - 1, weight[1]));
    steps
}

#[derive(Clone, Copy)]
enum Direction {
    Forward,
    Inverse,
}

/// Transforms a field along both axes, in place.
fn transform(field: &mut [Complex<f64>], [rows, columns]: [usize; 2], direction: Direction) {
    let plan = |n: usize| match direction {
        Direction::Forward => f64::forward(n),
        Direction::Inverse => f64::inverse(n),
    };
    let along = plan(columns);
    let lines = field.par_chunks_mut(columns);
    lines.for_each(|line| along.process(line));
    let across = plan(rows);
    let transformed: Vec<Vec<Complex<f64>>> = (0..columns)
        .into_par_iter()
        .map(|j| {
            let mut line: Vec<_> = field.iter().skip(j).step_by(columns).copied().collect();
            across.process(&mut line);
            line
        })
        .collect();
    for (j, line) in transformed.into_iter().enumerate() {
        for (i, value) in line.into_iter().enumerate() {
            field[i * columns + j] = value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// n × n samples of a surface on the square of side 1.
    fn map(n: usize, surface: impl Fn(f64, f64) -> f64) -> HeightMap {
        let at = |i: usize| (i as f64 + 0.5) / n as f64 - 0.5;
        let heights = (0..n * n).map(|k| surface(at(k / n), at(k % n)));
        HeightMap::new(heights.collect(), [n; 2], [1.0; 2]).unwrap()
    }

    fn wave(x: f64, y: f64) -> f64 {
        (TAU * (3.0 * x + 2.0 * y)).sin() + 0.3 * (TAU * (x - 7.0 * y)).cos()
    }

    #[test]
    fn the_step_across_the_rim_of_waves_that_fit_is_one_of_those_inside() {
        for RimStep { across, inside } in RimStep::of(&map(48, wave)) {
            // All lines of a wave along both axes have the same step, up to the mixed terms of the two waves.
            assert!((across / inside - 1.0).abs() < 0.05, "{across} {inside}");
        }
        let [x, y] = RimStep::of(&map(48, |x, y| wave(x, y) + x));
        // A tilt of 1 along x: its step is 1, beside the wave's own of 0.3.
        assert!(
            x.across > 2.0 * x.inside && y.across < 1.05 * y.inside,
            "{x:?} {y:?}"
        );
    }

    #[test]
    fn a_map_without_a_step_across_its_rim_is_left_as_it_is() {
        let level = map(32, |_, _| 5.0);
        assert!(
            level
                .clone()
                .tapered()
                .heights()
                .iter()
                .all(|h| (h - 5.0).abs() < 1e-14)
        );
    }

    #[test]
    fn opposite_edges_of_a_tapered_map_fit_and_its_middle_keeps_its_short_waves() {
        let n = 96;
        let scan = map(n, |x, y| wave(0.83 * x, 0.77 * y) + 0.8 * x);
        let tapered = scan.clone().tapered();
        for (before, after) in RimStep::of(&scan).into_iter().zip(RimStep::of(&tapered)) {
            assert!(before.across > 2.0 * before.inside);
            assert!(after.across <= after.inside, "{after:?}");
        }
        // Δ s is zero inside: second differences of the map are kept there.
        let bend = |map: &HeightMap, i: usize, j: usize| {
            let at = |i: usize, j: usize| map.heights()[i * n + j];
            at(i + 1, j) + at(i - 1, j) + at(i, j + 1) + at(i, j - 1) - 4.0 * at(i, j)
        };
        for (i, j) in [(1, 1), (48, 48), (94, 20)] {
            // Rounding of the transforms.
            assert!((bend(&scan, i, j) - bend(&tapered, i, j)).abs() < 1e-12);
        }
    }
}
