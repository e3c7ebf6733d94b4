//! A measured height map and the surface between its samples.

use crate::error::{Quantity, TextureError, positive};
use crate::interpolation::{Interpolation, Stencil};

/// Rounding of a place, in samples, on a map of one sample.
const ON_A_SAMPLE: f64 = 4.0 * f64::EPSILON;

/// Heights (m) measured at the centres of `shape[0]` × `shape[1]` equal pixels that fill a rectangle centred on the
/// origin.
///
/// Sample `(i, j)` has the index `i * shape[1] + j` and stands at `x_i = (i + ½) w_x − L_x/2`,
/// `y_j = (j + ½) w_y − L_y/2`, where `L` is the extent and `w = L / shape` a pixel: the layout of a
/// [`Grid`](crate::Grid), and that of the usual instrument files.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMap {
    heights: Vec<f64>,
    shape: [usize; 2],
    extent: [f64; 2],
    interpolation: Interpolation,
}

impl HeightMap {
    /// A map of `shape[0] * shape[1]` heights (m, above any plane) over a rectangle of sides `extent` (m), bicubic
    /// between them.
    ///
    /// # Errors
    ///
    /// [`TextureError::MapShape`] if the number of heights is not the product of the shape or is zero,
    /// [`TextureError::NotPositive`] if a side of the extent is not positive and finite, [`TextureError::MapSample`] if
    /// a height is NaN or infinite.
    pub fn new(
        heights: Vec<f64>,
        shape: [usize; 2],
        extent: [f64; 2],
    ) -> Result<Self, TextureError> {
        let [rows, columns] = shape;
        if heights.is_empty() || rows.checked_mul(columns) != Some(heights.len()) {
            return Err(TextureError::MapShape {
                shape,
                found: heights.len(),
            });
        }
        for side in extent {
            positive(Quantity::Extent, side)?;
        }
        match heights.iter().position(|height| !height.is_finite()) {
            Some(n) => Err(TextureError::MapSample {
                index: [n / columns, n % columns],
                found: heights[n],
            }),
            None => Ok(Self {
                heights,
                shape,
                extent,
                interpolation: Interpolation::default(),
            }),
        }
    }

    /// The same samples with this interpolation between them.
    #[must_use]
    pub fn with_interpolation(self, interpolation: Interpolation) -> Self {
        Self {
            interpolation,
            ..self
        }
    }

    /// How heights between the samples are found.
    #[must_use]
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// The samples as given, m.
    #[must_use]
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// Samples along x and along y.
    #[must_use]
    pub fn shape(&self) -> [usize; 2] {
        self.shape
    }

    /// Sides of the rectangle along x and along y, m.
    #[must_use]
    pub fn extent(&self) -> [f64; 2] {
        self.extent
    }

    /// The smallest sample, m.
    pub(crate) fn least(&self) -> f64 {
        self.heights.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// The largest sample, m.
    pub(crate) fn greatest(&self) -> f64 {
        self.heights
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// Whether the point (m) lies in the rectangle of the map, its rim included.
    #[must_use]
    pub fn covers(&self, [x, y]: [f64; 2]) -> bool {
        x.abs() <= 0.5 * self.extent[0] && y.abs() <= 0.5 * self.extent[1]
    }

    /// Distance from the point to the border of the map's rectangle, m: positive inside, negative outside.
    #[must_use]
    pub fn distance_to_border(&self, [x, y]: [f64; 2]) -> f64 {
        let [along_x, along_y] = [
            0.5 * self.extent[0] - x.abs(),
            0.5 * self.extent[1] - y.abs(),
        ];
        if along_x < 0.0 && along_y < 0.0 {
            -along_x.hypot(along_y)
        } else {
            along_x.min(along_y)
        }
    }

    /// Distance from the point to the nearest line of samples along which the surface has a ridge, m: infinite where
    /// the interpolation is smooth.
    #[must_use]
    pub fn distance_to_ridge(&self, point: [f64; 2]) -> f64 {
        if self.interpolation == Interpolation::Bicubic {
            return f64::INFINITY;
        }
        let along = |axis: usize| {
            let pixel = self.extent[axis] / self.shape[axis] as f64;
            let (_, _, part) = self.bracket(axis, point[axis]);
            pixel * part.min(1.0 - part)
        };
        along(0).min(along(1))
    }

    /// Height at a point (m) by the map's interpolation; beyond the outermost samples, the height of the nearest point
    /// among them.
    #[must_use]
    pub fn height(&self, point: [f64; 2]) -> f64 {
        match self.interpolation {
            Interpolation::Bicubic => self.bicubic(point),
            Interpolation::Linear => self.bilinear(point),
        }
    }

    fn bicubic(&self, point: [f64; 2]) -> f64 {
        let [along_x, along_y] = [0, 1].map(|axis| {
            let (before, after, t) = self.bracket(axis, point[axis]);
            let samples = self.shape[axis];
            // A point that is a sample's up to rounding has the height of the sample.
            if t > 1.0 - ON_A_SAMPLE * samples as f64 {
                Stencil::cubic(after, 0.0, samples)
            } else if t < ON_A_SAMPLE * samples as f64 {
                Stencil::cubic(before, 0.0, samples)
            } else {
                Stencil::cubic(before, t, samples)
            }
        });
        self.weighed([&along_x, &along_y], 0.0)
    }

    /// Slopes along x and y and second derivatives along x, both and y of the bicubic surface at a point (m), in
    /// heights per distance between samples.
    pub(crate) fn slopes_and_bends(&self, point: [f64; 2]) -> ([f64; 2], [f64; 3]) {
        let [along_x, along_y] = [0, 1].map(|axis| {
            let (before, _, t) = self.bracket(axis, point[axis]);
            let samples = self.shape[axis];
            [
                Stencil::cubic(before, t, samples),
                Stencil::cubic_slope(before, t, samples),
                Stencil::cubic_bend(before, t, samples),
            ]
        });
        // Derivatives of differences, so that a map far from its plane of reference is none the worse.
        let reference = self.height(point);
        let derivative = |x: usize, y: usize| self.weighed([&along_x[x], &along_y[y]], reference);
        let slopes = [derivative(1, 0), derivative(0, 1)];
        (
            slopes,
            [derivative(2, 0), derivative(1, 1), derivative(0, 2)],
        )
    }

    /// The sum of the heights above a reference, weighed along both axes.
    fn weighed(&self, [along_x, along_y]: [&Stencil; 2], reference: f64) -> f64 {
        let row = |i: usize| {
            let row = &self.heights[i * self.shape[1]..];
            along_y
                .terms()
                .map(|(j, weight)| weight * (row[j] - reference))
                .sum::<f64>()
        };
        along_x.terms().map(|(i, weight)| weight * row(i)).sum()
    }

    fn bilinear(&self, point: [f64; 2]) -> f64 {
        let [(i0, i1, u), (j0, j1, v)] = [0, 1].map(|axis| self.bracket(axis, point[axis]));
        let sample = |i: usize, j: usize| self.heights[i * self.shape[1] + j];
        let along_y = |i: usize| (1.0 - v) * sample(i, j0) + v * sample(i, j1);
        let interpolated = (1.0 - u) * along_y(i0) + u * along_y(i1);
        let corners = [
            sample(i0, j0),
            sample(i0, j1),
            sample(i1, j0),
            sample(i1, j1),
        ];
        // Rounding must not carry the mean beyond its corners; a NaN coordinate stays NaN.
        let [low, high] = [
            corners.into_iter().fold(f64::INFINITY, f64::min),
            corners.into_iter().fold(f64::NEG_INFINITY, f64::max),
        ];
        interpolated.clamp(low, high)
    }

    /// Sides of a pixel, m.
    pub(crate) fn pixel(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.extent[axis] / self.shape[axis] as f64)
    }

    /// Where a sample stands, m.
    pub(crate) fn point(&self, [i, j]: [usize; 2]) -> [f64; 2] {
        [self.coordinate(0, i), self.coordinate(1, j)]
    }

    /// Coordinate of sample `i` along an axis.
    fn coordinate(&self, axis: usize, i: usize) -> f64 {
        let pixel = self.extent[axis] / self.shape[axis] as f64;
        ((2 * i + 1) as f64 - self.shape[axis] as f64) * (0.5 * pixel)
    }

    /// Whether a coordinate lies inside the outermost samples, where the surface has slopes of both signs.
    pub(crate) fn is_between_samples(&self, axis: usize, coordinate: f64) -> bool {
        coordinate.abs() < self.coordinate(axis, self.shape[axis] - 1)
    }

    /// The samples on either side of a coordinate, and the weight of the second.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to the indices of the map"
    )]
    fn bracket(&self, axis: usize, coordinate: f64) -> (usize, usize, f64) {
        let samples = self.shape[axis];
        let last = (samples - 1) as f64;
        // t = (x − x_0)/w = x/w + (n − 1)/2
        let position =
            (coordinate * samples as f64 / self.extent[axis] + 0.5 * last).clamp(0.0, last);
        let before = position.floor() as usize;
        (
            before,
            (before + 1).min(samples - 1),
            position - position.floor(),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_map_has_ridges_along_its_samples_and_a_bicubic_one_has_none() {
        let map = HeightMap::new(vec![0.0; 20], [4, 5], [2.0, 5.0]).unwrap();
        assert_eq!(map.distance_to_ridge([0.1, 0.2]), f64::INFINITY);
        // Samples at x = ±0.25, ±0.75 and y = 0, ±1, ±2.
        let linear = map.with_interpolation(Interpolation::Linear);
        for (point, wanted) in [([0.25, 0.4], 0.0), ([0.05, 0.4], 0.2), ([0.0, 0.1], 0.1)] {
            let found = linear.distance_to_ridge(point);
            // a few roundings of numbers up to 5
            assert!((found - wanted).abs() < 1e-15, "{point:?}: {found}");
        }
    }

    #[test]
    fn a_bilinear_surface_is_reproduced_between_the_samples() {
        let surface = |x: f64, y: f64| 1.0 + 2.0 * x - 3.0 * y + 4.0 * x * y;
        let (shape, extent) = ([4, 5], [2.0, 5.0]);
        let samples = (0..20)
            .map(|n| surface(f64::from(n / 5) * 0.5 - 0.75, f64::from(n % 5) - 2.0))
            .collect();
        let map = HeightMap::new(samples, shape, extent).unwrap();
        for interpolation in [Interpolation::Linear, Interpolation::Bicubic] {
            let map = map.clone().with_interpolation(interpolation);
            for (x, y) in [(-0.75, -2.0), (0.1, 0.3), (0.74, 1.99), (0.0, 0.0)] {
                // Heights up to 12, a dozen roundings.
                assert!((map.height([x, y]) - surface(x, y)).abs() < 2e-14);
            }
        }
    }

    #[test]
    fn beyond_the_samples_the_edge_value_continues() {
        let map = HeightMap::new(vec![1.0, 2.0, 3.0, 4.0], [2, 2], [2.0, 2.0]).unwrap();
        assert_eq!(map.height([-9.0, -0.5]), 1.0);
        assert_eq!(map.height([9.0, 9.0]), 4.0);
        assert!(map.covers([1.0, -1.0]) && !map.covers([1.01, 0.0]));
    }

    /// n × n samples of a surface on the square of side 2.
    fn sampled(n: u32, surface: impl Fn(f64, f64) -> f64) -> HeightMap {
        let at = |i: u32| (2.0 * f64::from(i) + 1.0) / f64::from(n) - 1.0;
        let heights = (0..n * n).map(|k| surface(at(k / n), at(k % n)));
        HeightMap::new(heights.collect(), [n as usize; 2], [2.0, 2.0]).unwrap()
    }

    #[test]
    fn a_bicubic_surface_is_reproduced_away_from_the_rim_and_the_samples_to_the_bit() {
        let cubic = |x: f64| 1.0 + x * (2.0 - x * (3.0 - 4.0 * x));
        let surface = |x: f64, y: f64| cubic(x) * cubic(y) - 2.0 * y * x;
        let map = sampled(12, surface);
        for k in 0..1000_u32 {
            let [x, y] = [k % 37, k % 41].map(|k| f64::from(k) / 37.0 - 0.5);
            // Heights up to 30, 64 products.
            assert!((map.height([x, y]) - surface(x, y)).abs() < 1e-13);
        }
        for (n, height) in map.heights().iter().enumerate() {
            assert_eq!(map.height(map.point([n / 12, n % 12])), *height);
        }
    }

    #[test]
    fn heights_and_slopes_are_continuous_across_the_samples() {
        let map = sampled(9, |x, y| (7.0 * x + y).sin() + (5.0 * x * y).cos());
        let [x, _] = map.point([4, 4]);
        let h = 1e-4;
        for k in 0..80_u32 {
            let y = f64::from(k) / 40.0 - 1.0;
            let [before, here, after] = [-h, 0.0, h].map(|dx| map.height([x + dx, y]));
            // A ridge's second difference is of the order h, as a bilinear map has it; that of a smooth surface h² f″,
            // f″ < 100.
            let bend = (after - 2.0 * here + before).abs();
            assert!(bend < 100.0 * h * h, "{y}: {bend:e}");
        }
        let linear = map.with_interpolation(Interpolation::Linear);
        let bend = linear.height([x + h, 0.7]) - 2.0 * linear.height([x, 0.7])
            + linear.height([x - h, 0.7]);
        assert!(bend.abs() > 1000.0 * h * h, "{bend:e}");
    }

    #[test]
    fn the_error_between_samples_falls_with_the_fourth_power_of_their_distance() {
        let surface = |x: f64, y: f64| (3.0 * x).sin() * (2.0 * y).cos();
        let error = |n: u32| {
            let map = sampled(n, surface);
            let errors = (0..41 * 41_u32).map(|k| {
                let [x, y] = [k / 41, k % 41].map(|k| f64::from(k) / 41.0 - 0.5);
                (map.height([x, y]) - surface(x, y)).abs()
            });
            errors.fold(0.0, f64::max)
        };
        let errors = [16, 32, 64].map(error);
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!((3.8..4.3).contains(&order), "order {order}");
        }
    }

    #[test]
    fn a_linear_map_has_its_extremes_in_samples_and_the_bits_of_the_bilinear_formula() {
        let map = sampled(6, |x, y| (9.0 * x).sin() - (4.0 * y).cos());
        let map = map.with_interpolation(Interpolation::Linear);
        let [least, greatest] = [map.least(), map.greatest()];
        assert_eq!([map.lowest(), map.highest()], [least, greatest]);
        // Sample 2 of x and 3 of y stand at −1/6 and 1/6: u = ⅜ and v = ¼ of the way to the next.
        let f = |i: usize, j: usize| map.heights()[6 * i + j];
        let along_y = |i: usize| 0.75 * f(i, 3) + 0.25 * f(i, 4);
        let expected = 0.625 * along_y(2) + 0.375 * along_y(3);
        let found = map.height([-1.0 / 24.0, 0.25]);
        assert!((found - expected).abs() < 1e-15, "{found} {expected}");
    }

    #[test]
    fn the_lowest_of_equal_points_is_the_middlemost() {
        let mut heights = vec![0.0; 25];
        heights[0] = 1.0;
        assert_eq!(
            HeightMap::new(heights, [5, 5], [1.0, 1.0])
                .unwrap()
                .with_interpolation(Interpolation::Linear)
                .lowest_point(),
            [0.0, 0.0]
        );
        let ramp = HeightMap::new(vec![3.0, 2.0, 1.0], [3, 1], [3.0, 1.0]).unwrap();
        assert_eq!(ramp.lowest_point(), [1.0, 0.0]);
    }

    #[test]
    fn maps_that_do_not_fit_their_shape_or_hold_no_numbers_are_refused() {
        let wrong = HeightMap::new(vec![0.0; 5], [2, 3], [1.0, 1.0]);
        assert_eq!(
            wrong,
            Err(TextureError::MapShape {
                shape: [2, 3],
                found: 5
            })
        );
        assert!(HeightMap::new(vec![], [0, 3], [1.0, 1.0]).is_err());
        assert!(HeightMap::new(vec![0.0; 4], [2, 2], [1.0, 0.0]).is_err());
        let infinite = HeightMap::new(vec![0.0, 0.0, 0.0, f64::INFINITY], [2, 2], [1.0, 1.0]);
        assert_eq!(
            infinite,
            Err(TextureError::MapSample {
                index: [1, 1],
                found: f64::INFINITY
            })
        );
    }
}
