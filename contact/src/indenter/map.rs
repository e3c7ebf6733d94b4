//! An indenter measured point by point.

mod mean_profile;

use std::sync::{Arc, OnceLock};

use mean_profile::MeanProfile;
use pellicle_texture::HeightMap;

use super::Profile;

/// Radius of the smallest circle over which heights are averaged, in distances between samples.
const FINEST: f64 = 0.01;

/// A measured indenter: a height map, placed so that its lowest point is at the origin and at height 0.
///
/// Between samples the height is that of the map's [interpolation](pellicle_texture::Interpolation). Beyond the map's
/// rectangle the indenter ends, `f = +∞`: a contact that reaches the rim of the measurement is bounded by it as by the
/// rim of a punch, and the [step](crate::Step) is marked as cut off.
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
        self.map == other.map
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
