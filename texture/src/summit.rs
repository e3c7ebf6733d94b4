//! The highest and the lowest point of a map's surface, which may lie between samples.
//!
//! A crest of a surface that its samples resolve lies within one sample of a sample at least as high as its neighbours.
//! The parabola through three samples bounds the height of the crest. The few crests that may be the highest are
//! searched closely.

use crate::height_map::HeightMap;
use crate::interpolation::{Interpolation, Stencil};

/// Most crests searched: a measured map has one or two whose parabolas come near the highest; one of rounded numbers
/// may have many.
const MOST_CRESTS: usize = 256;

/// Points along each axis in one search.
const POINTS: i32 = 8;

/// Searches, each over a region of a third of the previous side: down to 3⁻¹⁸ of a sample, below which heights no
/// longer distinguish points.
const LOOKS: usize = 18;

/// Newton steps to the point of zero slope, begun where the searches end; two suffice.
const NEWTON_STEPS: usize = 4;

/// The longest Newton step, in samples: a longer one leaves the summit, as on a plateau.
const LONGEST_STEP: f64 = 1e-3;

/// Two crests that differ by less than this, relative to the map's range, count as equally high: the rounding of 64
/// products, with a margin.
const EQUAL: f64 = 1e-13;

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
            Interpolation::Linear => self.least_point(),
        }
    }

    /// Position of the smallest sample; of several, the nearest to the middle.
    fn least_point(&self) -> [f64; 2] {
        let lowest = self.least();
        let columns = self.shape()[1];
        let candidates = (0..self.heights().len()).filter(|&n| self.heights()[n] <= lowest);
        candidates
            .map(|n| self.point([n / columns, n % columns]))
            .min_by(|p, q| p[0].hypot(p[1]).total_cmp(&q[0].hypot(q[1])))
            .unwrap_or([0.0, 0.0])
    }
}

/// A sample at least as high as its neighbours.
struct Crest {
    sample: [usize; 2],
    /// Rise of the crest's parabolas above the sample.
    rise: f64,
    height: f64,
}

impl Crest {
    /// An upper bound of the crest's height. For a wave of four samples, half of whose samples lie beside a crest, the
    /// surface rises by 0.68 of the parabola's rise; for a flat line with a slope at its end, by 8/27.
    fn most(&self) -> f64 {
        self.height + 2.0 * self.rise
    }

    /// A lower bound of the crest's height.
    fn least(&self) -> f64 {
        self.height + 0.25 * self.rise
    }
}

/// The highest point of `sign` times the surface; of several equally high points, the one nearest to the middle of the
/// map.
pub(crate) fn summit(map: &HeightMap, sign: f64) -> Summit {
    let equal = EQUAL * (map.greatest() - map.least());
    let crests = near_the_top(map, crests(map, sign, equal));
    let summits: Vec<_> = crests.iter().map(|crest| climb(map, sign, crest)).collect();
    let top = summits.iter().map(|summit| summit.height);
    let enough = top.fold(f64::NEG_INFINITY, f64::max) - equal;
    let as_high = summits.iter().filter(|summit| summit.height >= enough);
    let nearest = as_high.min_by(|a, b| norm(a.point).total_cmp(&norm(b.point)));
    // A map has at least one sample, and the highest sample is a crest.
    nearest.map_or(Summit::default(), |summit| Summit {
        height: sign * summit.height,
        ..*summit
    })
}

/// The crests that may be the highest, those nearest to the middle of the map first among equals. Every sample of a
/// plateau is a crest, so the list is sorted and cut to the number searched whenever it reaches twice that number.
fn near_the_top(map: &HeightMap, crests: impl Iterator<Item = Crest>) -> Vec<Crest> {
    let mut least = f64::NEG_INFINITY;
    let distance = |crest: &Crest| norm(map.point(crest.sample));
    let cut = |kept: &mut Vec<Crest>| {
        kept.sort_by(|a, b| {
            let by_height = b.most().total_cmp(&a.most());
            by_height.then(distance(a).total_cmp(&distance(b)))
        });
        kept.truncate(MOST_CRESTS);
    };
    let mut kept = Vec::new();
    for crest in crests {
        least = crest.least().max(least);
        if crest.most() < least {
            continue;
        }
        kept.push(crest);
        if kept.len() == 2 * MOST_CRESTS {
            cut(&mut kept);
        }
    }
    kept.retain(|crest| crest.most() >= least);
    cut(&mut kept);
    kept
}

fn norm([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

/// The samples at least as high as their four neighbours; a slope that rises by no more than `equal` per sample is
/// ignored.
fn crests(map: &HeightMap, sign: f64, equal: f64) -> impl Iterator<Item = Crest> + '_ {
    let [rows, columns] = map.shape();
    let at = move |i: usize, j: usize| sign * map.heights()[i * columns + j];
    let samples = (0..rows).flat_map(move |i| (0..columns).map(move |j| [i, j]));
    let crest = move |[i, j]: [usize; 2]| {
        let along_x = SampleLine::new(i, rows, |i| at(i, j))?;
        let along_y = SampleLine::new(j, columns, |j| at(i, j))?;
        Some(Crest {
            sample: [i, j],
            rise: along_x.rise(equal) + along_y.rise(equal),
            height: at(i, j),
        })
    };
    samples.filter_map(crest)
}

/// A line of samples through one that is at least as high as its neighbours on the line.
struct SampleLine<F> {
    sample: usize,
    samples: usize,
    at: F,
}

impl<F: Fn(usize) -> f64> SampleLine<F> {
    /// Returns `None` if a neighbour is higher.
    fn new(sample: usize, samples: usize, at: F) -> Option<Self> {
        let last = (sample + 1).min(samples - 1);
        let is_highest = (sample.saturating_sub(1)..=last).all(|k| at(k) <= at(sample));
        is_highest.then_some(Self {
            sample,
            samples,
            at,
        })
    }

    /// Rise above the sample of the parabola with the slope and the second difference there.
    fn rise(&self, equal: f64) -> f64 {
        let height = (self.at)(self.sample);
        let terms = Stencil::slope(self.sample, self.samples);
        // Take differences, so that a map far from its reference plane loses no accuracy.
        let slope = terms
            .terms()
            .map(|(k, weight)| weight * ((self.at)(k) - height));
        let slope = slope.sum::<f64>();
        let is_outward =
            (self.sample == 0 && slope < 0.0) || (self.sample + 1 == self.samples && slope > 0.0);
        let slope = slope.abs();
        if is_outward || slope <= equal {
            return 0.0;
        }
        let middle = self.sample.clamp(1, self.samples.saturating_sub(2).max(1));
        let near = |k: usize| (self.at)(k.min(self.samples - 1));
        let bend = 2.0 * near(middle) - near(middle - 1) - near(middle + 1);
        // A surface that does not bend at the sample bends before the next.
        (slope * slope / (2.0 * bend.max(0.0))).min(0.5 * slope)
    }
}

/// Searches for the highest point within a sample of the crest.
fn climb(map: &HeightMap, sign: f64, crest: &Crest) -> Summit {
    let mut best = Summit {
        point: map.point(crest.sample),
        height: crest.height,
    };
    if crest.rise == 0.0 {
        return best;
    }
    let mut reach = map.pixel();
    for _ in 0..LOOKS {
        let [x, y] = best.point;
        for k in 0..(POINTS + 1).pow(2) {
            let step = |k: i32| f64::from(2 * k - POINTS) / f64::from(POINTS);
            let point = [
                x + reach[0] * step(k / (POINTS + 1)),
                y + reach[1] * step(k % (POINTS + 1)),
            ];
            let height = sign * map.height(point);
            if height > best.height {
                best = Summit { point, height };
            }
        }
        reach = reach.map(|side| side / 3.0);
    }
    level(map, sign, best)
}

/// The point of zero slope near a summit. Heights locate it to the square root of their rounding, 1e-8 of a sample;
/// slopes locate it to rounding.
fn level(map: &HeightMap, sign: f64, summit: Summit) -> Summit {
    let pixel = map.pixel();
    let mut point = summit.point;
    for _ in 0..NEWTON_STEPS {
        let ([along_x, along_y], [xx, xy, yy]) = map.slopes_and_bends(point);
        // δ = −H⁻¹ ∇f; at the border of the samples, only along it.
        let step = match [0, 1].map(|axis| map.is_between_samples(axis, point[axis])) {
            [true, true] => {
                let determinant = xx * yy - xy * xy;
                [
                    (xy * along_y - yy * along_x) / determinant,
                    (xy * along_x - xx * along_y) / determinant,
                ]
            }
            [true, false] => [-along_x / xx, 0.0],
            [false, true] => [0.0, -along_y / yy],
            [false, false] => return summit,
        };
        // False for NaN.
        let is_short = step.iter().all(|step| step.abs() <= LONGEST_STEP);
        if !is_short {
            return summit;
        }
        for axis in [0, 1] {
            point[axis] += step[axis] * pixel[axis];
        }
    }
    let height = sign * map.height(point);
    Summit { point, height }
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
