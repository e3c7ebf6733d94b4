//! A measured height map and its bilinear interpolation.

use crate::error::{Quantity, TextureError, positive};

/// Heights (m) measured at the centres of `shape[0]` × `shape[1]` equal pixels that fill a rectangle centred on the origin.
///
/// Sample `(i, j)` has the index `i * shape[1] + j` and stands at `x_i = (i + ½) w_x − L_x/2`, `y_j = (j + ½) w_y − L_y/2`, where
/// `L` is the extent and `w = L / shape` a pixel: the layout of a [`Grid`](crate::Grid), and that of the usual instrument files.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMap {
    heights: Vec<f64>,
    shape: [usize; 2],
    extent: [f64; 2],
}

impl HeightMap {
    /// A map of `shape[0] * shape[1]` heights (m, above any plane) over a rectangle of sides `extent` (m).
    ///
    /// # Errors
    ///
    /// [`TextureError::MapShape`] if the number of heights is not the product of the shape or is zero,
    /// [`TextureError::NotPositive`] if a side of the extent is not positive and finite, [`TextureError::MapSample`] if a height
    /// is NaN or infinite.
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
            }),
        }
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

    /// The smallest sample, m; no interpolated height lies below it.
    #[must_use]
    pub fn lowest(&self) -> f64 {
        self.heights.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// The largest sample, m; no interpolated height lies above it.
    #[must_use]
    pub fn highest(&self) -> f64 {
        self.heights
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// Where the smallest sample stands, m; of several equal ones the one nearest to the middle of the map.
    #[must_use]
    pub fn lowest_point(&self) -> [f64; 2] {
        let lowest = self.lowest();
        let columns = self.shape[1];
        let candidates = (0..self.heights.len()).filter(|&n| self.heights[n] <= lowest);
        candidates
            .map(|n| {
                [
                    self.coordinate(0, n / columns),
                    self.coordinate(1, n % columns),
                ]
            })
            .min_by(|p, q| p[0].hypot(p[1]).total_cmp(&q[0].hypot(q[1])))
            .unwrap_or([0.0, 0.0])
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

    /// Height at a point (m) by bilinear interpolation; beyond the outermost samples, the height of the nearest point among them.
    #[must_use]
    pub fn height(&self, point: [f64; 2]) -> f64 {
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

    /// Coordinate of sample `i` along an axis.
    fn coordinate(&self, axis: usize, i: usize) -> f64 {
        let pixel = self.extent[axis] / self.shape[axis] as f64;
        ((2 * i + 1) as f64 - self.shape[axis] as f64) * (0.5 * pixel)
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
    fn a_bilinear_surface_is_reproduced_between_the_samples() {
        let surface = |x: f64, y: f64| 1.0 + 2.0 * x - 3.0 * y + 4.0 * x * y;
        let (shape, extent) = ([4, 5], [2.0, 5.0]);
        let samples = (0..20)
            .map(|n| surface(f64::from(n / 5) * 0.5 - 0.75, f64::from(n % 5) - 2.0))
            .collect();
        let map = HeightMap::new(samples, shape, extent).unwrap();
        for (x, y) in [(-0.75, -2.0), (0.1, 0.3), (0.74, 1.99), (0.0, 0.0)] {
            // Heights up to 12, a dozen roundings.
            assert!((map.height([x, y]) - surface(x, y)).abs() < 2e-14);
        }
    }

    #[test]
    fn beyond_the_samples_the_edge_value_continues() {
        let map = HeightMap::new(vec![1.0, 2.0, 3.0, 4.0], [2, 2], [2.0, 2.0]).unwrap();
        assert_eq!(map.height([-9.0, -0.5]), 1.0);
        assert_eq!(map.height([9.0, 9.0]), 4.0);
        assert!(map.covers([1.0, -1.0]) && !map.covers([1.01, 0.0]));
    }

    #[test]
    fn the_lowest_of_equal_points_is_the_middlemost() {
        let mut heights = vec![0.0; 25];
        heights[0] = 1.0;
        assert_eq!(
            HeightMap::new(heights, [5, 5], [1.0, 1.0])
                .unwrap()
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
