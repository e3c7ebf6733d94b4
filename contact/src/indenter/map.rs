//! An indenter measured point by point.

mod mean_profile;

use std::sync::{Arc, OnceLock};

use mean_profile::MeanProfile;
use pellicle_texture::{HeightMap, MeanPlane};

use super::Profile;

/// Radius of the smallest circle over which heights are averaged, in distances between samples.
const FINEST: f64 = 0.01;

/// Mean height of the two ends of a map above its mean, over the rms height of its mean profile along the axis above a
/// line, with which it counts as cut out of something larger: 2.2 for the scan of a paraboloid, wherever its axis lies,
/// 1.7 for the edge of a wedge, and at most 1.4 for a wave that fits in the map.
const RISING: f64 = 1.55;

/// The same over the rms height of the map: the mean profile of a rough punch, or along a cylinder, is nearly level.
const PART_OF_ROUGHNESS: f64 = 0.1;

/// A measured indenter: a height map, placed so that its lowest point is at the origin and at height 0.
///
/// Between samples the height is that of the map's [interpolation](pellicle_texture::Interpolation). Beyond the map's
/// rectangle the indenter ends, `f = +∞`: a contact that reaches the end is bounded by it as by the rim of a punch.
/// Where the map rises to both its ends along an axis, as the scan of a ball, a cone or a pyramid does, it was cut out
/// of something larger: then the [step](crate::Step) is marked as cut off.
#[derive(Clone, Debug)]
pub struct IndenterMap {
    map: HeightMap,
    lowest: f64,
    lowest_point: [f64; 2],
    /// Made on first use, once for all clones.
    mean_profile: Arc<OnceLock<MeanProfile>>,
}

impl PartialEq for IndenterMap {
    fn eq(&self, other: &Self) -> bool {
        self.map == other.map && self.lowest_point == other.lowest_point
    }
}

impl IndenterMap {
    /// An indenter from heights (m, upwards, above any plane) of its lower surface.
    ///
    /// Of several equally low points, the one nearest to the middle of the map is placed at the origin.
    #[must_use]
    pub fn new(map: HeightMap) -> Self {
        let (lowest, lowest_point) = (map.lowest(), map.lowest_point());
        Self {
            map,
            lowest,
            lowest_point,
            mean_profile: Arc::default(),
        }
    }

    /// The same heights, left where they are: the middle of the map lies at the origin, and the lowest point anywhere.
    /// So two maps that were measured together stay in register.
    #[must_use]
    pub fn in_place(map: HeightMap) -> Self {
        Self {
            lowest_point: [0.0; 2],
            ..Self::new(map)
        }
    }

    /// Whether the map rises towards both its ends along this axis (0 for x, 1 for y).
    pub(crate) fn rises_to_its_ends(&self, axis: usize) -> bool {
        self.leads_to_its_ends(axis, 1.0)
    }

    /// Whether the map falls towards both its ends along x and along y, as the scan of a tip that points upwards: its
    /// corners press.
    #[must_use]
    pub fn is_dome(&self) -> bool {
        [0, 1]
            .into_iter()
            .all(|axis| self.leads_to_its_ends(axis, -1.0))
    }

    /// Whether `sign` times the map rises towards both its ends along an axis.
    fn leads_to_its_ends(&self, axis: usize, sign: f64) -> bool {
        let (shape, heights) = (self.map.shape(), self.map.heights());
        let at = |line: usize, k: usize| match axis {
            0 => heights[line * shape[1] + k],
            _ => heights[k * shape[1] + line],
        };
        let across = shape[1 - axis];
        let of_line = |line: usize| (0..across).map(|k| at(line, k)).sum::<f64>() / across as f64;
        let profile: Vec<f64> = (0..shape[axis]).map(of_line).collect();
        let mean = profile.iter().sum::<f64>() / profile.len() as f64;
        let ends = f64::midpoint(profile[0], profile[profile.len() - 1]);
        let rms_height = |map: &HeightMap| MeanPlane::of(map).rms_height_above(map);
        let profile = HeightMap::new(profile, [shape[axis], 1], [1.0; 2]);
        let own = profile.map_or(f64::INFINITY, |profile| rms_height(&profile));
        let rise = sign * (ends - mean);
        rise > RISING * own && rise > PART_OF_ROUGHNESS * rms_height(&self.map)
    }

    /// The map as given.
    #[must_use]
    pub fn map(&self) -> &HeightMap {
        &self.map
    }

    fn made_mean_profile(&self) -> MeanProfile {
        let ([width, height], [rows, columns]) = (self.map.extent(), self.map.shape());
        let spacing = (width / rows as f64).min(height / columns as f64);
        MeanProfile::new(
            |x, y| self.height(x, y),
            [FINEST * spacing, width.hypot(height)],
        )
    }

    /// The rectangle of the map above the plane: its lower and its upper corner, m.
    pub(crate) fn rectangle(&self) -> [[f64; 2]; 2] {
        [-0.5, 0.5]
            .map(|half| [0, 1].map(|axis| half * self.map.extent()[axis] - self.lowest_point[axis]))
    }

    /// The point of the map above a point of the plane, m.
    fn on_map(&self, x: f64, y: f64) -> [f64; 2] {
        [x + self.lowest_point[0], y + self.lowest_point[1]]
    }
}

impl Profile for IndenterMap {
    fn height(&self, x: f64, y: f64) -> f64 {
        let point = self.on_map(x, y);
        if self.map.covers(point) {
            self.map.height(point) - self.lowest
        } else {
            f64::INFINITY
        }
    }

    /// Averages over the part of the circle that lies on the map; infinite if none does.
    fn mean_profile(&self, radius: f64) -> f64 {
        let made = self.mean_profile.get_or_init(|| self.made_mean_profile());
        made.at(radius)
    }

    fn distance_to_rim(&self, x: f64, y: f64) -> f64 {
        self.map.distance_to_border(self.on_map(x, y))
    }

    fn distance_to_edge(&self, x: f64, y: f64, _scale: f64) -> f64 {
        let point = self.on_map(x, y);
        let rim = self.map.distance_to_border(point).abs();
        rim.min(self.map.distance_to_ridge(point))
    }
}

#[cfg(test)]
mod tests {
    use pellicle_texture::Interpolation;

    use super::*;
    use crate::indenter::Paraboloid;

    #[test]
    fn the_lowest_sample_is_at_the_origin_and_the_map_ends_at_its_rim() {
        let map = HeightMap::new(vec![9.0, 7.0, 8.0], [3, 1], [3.0, 1.0]).unwrap();
        let indenter = IndenterMap::new(map.with_interpolation(Interpolation::Linear));
        assert_eq!(
            [-1.0, 0.0, 0.5, 1.0].map(|x| indenter.height(x, 0.0)),
            [2.0, 0.0, 0.5, 1.0]
        );
        assert_eq!(
            [indenter.height(1.6, 0.0), indenter.height(0.0, 0.6)],
            [f64::INFINITY; 2]
        );
    }

    #[test]
    fn an_off_centre_tip_is_moved_to_the_origin_along_both_axes() {
        let heights = vec![8.0, 9.0, 7.0, 9.0, 9.0, 9.0];
        let map = HeightMap::new(heights, [2, 3], [2.0, 3.0]).unwrap();
        let indenter = IndenterMap::new(map);
        assert_eq!(
            [-2.0, -1.0, 0.0].map(|y| indenter.height(0.0, y)),
            [1.0, 2.0, 0.0]
        );
        approx::assert_relative_eq!(indenter.height(1.0, 0.0), 2.0);
    }

    #[test]
    fn scans_of_balls_cones_and_pyramids_rise_to_their_ends_and_punches_do_not() {
        let rises = |shape: &dyn Fn(f64, f64) -> f64| {
            let at = |i: usize| (i as f64 + 0.5) / 16.0 - 1.0;
            let heights = (0..32 * 32).map(|k| shape(at(k / 32), at(k % 32)));
            let map = HeightMap::new(heights.collect(), [32; 2], [2.0, 2.0]).unwrap();
            [0, 1].map(|axis| IndenterMap::new(map.clone()).rises_to_its_ends(axis))
        };
        let is_dome = |shape: &dyn Fn(f64, f64) -> f64| {
            let at = |i: usize| (i as f64 + 0.5) / 16.0 - 1.0;
            let heights = (0..32 * 32).map(|k| shape(at(k / 32), at(k % 32)));
            let map = HeightMap::new(heights.collect(), [32; 2], [2.0, 2.0]).unwrap();
            IndenterMap::new(map).is_dome()
        };
        for axis in [0.0, 0.4, 1.5] {
            assert_eq!(rises(&|x, y| (x - axis).powi(2) + y * y), [true; 2]);
            assert!(is_dome(&|x, y| -(x - axis).powi(2) - y * y));
        }
        // A tip, a ridge and a rough punch.
        assert!(!is_dome(&|x, y| x * x + y * y) && !is_dome(&|x, _| -x * x));
        assert!(!is_dome(&|x, y| (17.0 * x).sin() * (23.0 * y).cos()));
        assert_eq!(rises(&f64::hypot), [true; 2]);
        assert_eq!(rises(&|x, y| x.abs().max(y.abs())), [true; 2]);
        assert_eq!(rises(&|x, y| x.abs() + y.abs()), [true; 2]);
        // A cylinder along y, a punch, a tilted one, one with waves.
        assert_eq!(rises(&|x, _| x * x), [true, false]);
        assert_eq!(rises(&|x, y| x * x + 9.0 * y * y), [true; 2]);
        let faces = |x: f64, y: f64| {
            [0.0, 1.0, 2.0].map(|k: f64| {
                let (sine, cosine) = (k * std::f64::consts::TAU / 3.0).sin_cos();
                x * cosine + y * sine
            })
        };
        let berkovich = |x: f64, y: f64| faces(x, y).into_iter().fold(0.0, f64::max);
        assert_eq!(rises(&berkovich), [true; 2]);
        assert_eq!(rises(&|_, _| 3.0), [false; 2]);
        assert_eq!(rises(&|x, y| 0.1 * x - 0.2 * y), [false; 2]);
        assert_eq!(rises(&|x, y| (9.0 * x).sin() * (7.0 * y).cos()), [false; 2]);
    }

    #[test]
    fn a_map_in_place_keeps_its_middle_at_the_origin() {
        let map = HeightMap::new(vec![9.0, 7.0, 5.0], [3, 1], [3.0, 1.0]).unwrap();
        let indenter = IndenterMap::in_place(map.with_interpolation(Interpolation::Linear));
        assert_eq!(
            [-1.0, 0.0, 1.0].map(|x| indenter.height(x, 0.0)),
            [4.0, 2.0, 0.0]
        );
        assert_eq!(indenter.height(1.6, 0.0), f64::INFINITY);
    }

    /// n × n samples of a paraboloid of radius 1 with its axis at x = 0.03, on the square of side 2.
    fn sampled(n: u32, interpolation: Interpolation) -> IndenterMap {
        let paraboloid = Paraboloid::new(1.0).unwrap();
        let at = |i: u32| (f64::from(i) + 0.5) * 2.0 / f64::from(n) - 1.0;
        let heights = (0..n * n).map(|k| paraboloid.height(at(k / n) - 0.03, at(k % n)));
        let map = HeightMap::new(heights.collect(), [n as usize; 2], [2.0, 2.0]).unwrap();
        IndenterMap::new(map.with_interpolation(interpolation))
    }

    #[test]
    fn a_sampled_paraboloid_with_its_axis_between_samples_is_recovered() {
        let indenter = sampled(20, Interpolation::Bicubic);
        for (x, y) in [(0.0, 0.0), (0.1, 0.2), (-0.7, 0.3), (0.003, -0.001)] {
            // Some roundings of heights up to 1, which determine the axis.
            let error = indenter.height(x, y) - 0.5 * (x * x + y * y);
            assert!(error.abs() < 1e-14, "{x}, {y}: {error:e}");
        }
    }

    #[test]
    fn mean_heights_resolve_the_finer_spacing_along_either_axis() {
        // A ridge along the axis with few samples; the height rises with slope 1 along the other.
        let ridge = |many: usize, along_x: bool| {
            let rise = |i: usize| (i as f64 - (many / 2) as f64).abs() * 1e-4;
            let (heights, shape, extent) = if along_x {
                let heights = (0..many * 3).map(|k| rise(k / 3));
                (heights.collect(), [many, 3], [1e-4 * many as f64, 3.0])
            } else {
                let heights = (0..many * 3).map(|k| rise(k % many));
                (heights.collect(), [3, many], [3.0, 1e-4 * many as f64])
            };
            let map = HeightMap::new(heights, shape, extent).unwrap();
            IndenterMap::new(map.with_interpolation(Interpolation::Linear))
        };
        for along_x in [true, false] {
            // The mean of the height |x| over a circle within the ridge is 2/π of the radius; it rises less where the
            // circle is wider than the map.
            let (indenter, radius) = (ridge(101, along_x), 0.002);
            let mean = indenter.mean_profile(radius);
            assert!(
                (mean / (radius * std::f64::consts::FRAC_2_PI) - 1.0).abs() < 0.01,
                "{mean}"
            );
        }
    }

    #[test]
    fn a_linear_map_of_a_paraboloid_converges_with_second_order() {
        let error = |n: u32| {
            let indenter = sampled(n, Interpolation::Linear);
            let [x, y] = indenter.lowest_point;
            // A height halfway between samples along x and on a sample along y is too high by h²/8, h = 2/n, compared
            // with the samples on the axis.
            let half = 1.0 / f64::from(n);
            let height = indenter.height(half, 0.0) + indenter.lowest;
            height - 0.5 * ((x + half - 0.03).powi(2) + y * y)
        };
        let order = (error(5) / error(15)).log(3.0);
        assert!((order - 2.0).abs() < 0.05, "order {order}");
    }

    #[test]
    fn rim_and_edges_are_those_of_the_shifted_map() {
        // The tip is the sample at x = 1 of a map that ends at ±1.5 and ±0.5.
        let map = HeightMap::new(vec![9.0, 7.0, 5.0], [3, 1], [3.0, 1.0]).unwrap();
        let indenter = IndenterMap::new(map.with_interpolation(Interpolation::Linear));
        let rim = |x, y| indenter.distance_to_rim(x, y);
        for (place, wanted) in [
            ([0.0, 0.0], 0.5),
            ([0.4, 0.0], 0.1),
            ([-1.0, 0.3], 0.2),
            ([0.7, 0.0], -0.2),
        ] {
            approx::assert_relative_eq!(rim(place[0], place[1]), wanted, epsilon = 1e-15);
        }
        // A rim is also an edge, from either side.
        assert!(indenter.distance_to_edge(0.7, 0.0, 1.0) <= 0.2 + 1e-15);
    }
}
