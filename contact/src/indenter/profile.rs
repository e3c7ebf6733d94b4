//! The interface of an indenter: a height above each point of the plane.

use std::{f64::consts::TAU, fmt::Debug};

use pellicle_texture::Grid;
use rayon::prelude::*;

/// Midpoints in the average over a circle; a smooth profile needs far fewer, one with kinks has an error of about
/// 1/360².
const ANGLES: u32 = 360;
/// Number of points of a thread at a time.
const AT_ONCE: usize = 1024;

/// Finds the heights at some points.
type OfPart<'a> = dyn Fn(&[[f64; 2]], &mut [f64]) + Sync + 'a;

/// The heights at some points, of so many at once. The work on them is a trait object, so that the loop over threads is
/// compiled once and not for each shape.
fn by_parts(points: &[[f64; 2]], of_part: &OfPart<'_>) -> Vec<f64> {
    let mut heights = vec![0.0; points.len()];
    let parts = heights
        .par_chunks_mut(AT_ONCE)
        .zip(points.par_chunks(AT_ONCE));
    parts.for_each(|(heights, points)| of_part(points, heights));
    heights
}

/// The lower surface of a rigid indenter; [`custom`](crate::Indenter::custom) makes an [`Indenter`](crate::Indenter) of
/// a shape of your own.
pub trait Profile: Debug + Send + Sync {
    /// Height f(x, y) of the surface above its lowest point, m: 0 at the origin, not negative, `+∞` where the indenter
    /// ends.
    fn height(&self, x: f64, y: f64) -> f64;

    /// The heights at some points (m), the same as those of [`height`](Self::height). Override this for shapes that are
    /// faster for many points at once.
    fn heights(&self, points: &[[f64; 2]]) -> Vec<f64> {
        by_parts(points, &|points, heights| {
            let pairs = heights.iter_mut().zip(points);
            pairs.for_each(|(height, [x, y])| *height = self.height(*x, *y));
        })
    }

    /// Average of the height over the circle of the given radius about the axis, m; infinite if the indenter ends on
    /// it.
    ///
    /// Uses the midpoint rule in the angle: meant for estimates, and exact for axisymmetric shapes.
    fn mean_profile(&self, radius: f64) -> f64 {
        let point = |k: u32| {
            let (sine, cosine) = ((f64::from(k) + 0.5) * TAU / f64::from(ANGLES)).sin_cos();
            [radius * cosine, radius * sine]
        };
        let points: Vec<_> = (0..ANGLES).map(point).collect();
        self.heights(&points).iter().sum::<f64>() / f64::from(ANGLES)
    }

    /// Slope of the [mean profile](Self::mean_profile); by default a central difference.
    fn mean_slope(&self, radius: f64) -> f64 {
        let step = 1e-3 * radius;
        (self.mean_profile(radius + step) - self.mean_profile(radius - step)) / (2.0 * step)
    }

    /// Whether `f(x, y) = f(−x, y) = f(x, −y)`, so that a quadrant suffices where relief and grid allow it.
    fn is_mirrored(&self) -> bool {
        false
    }

    /// Distance from the point to the rim at which the indenter ends, m: positive under the indenter, negative beyond;
    /// infinite if it has no rim.
    fn distance_to_rim(&self, _x: f64, _y: f64) -> f64 {
        f64::INFINITY
    }

    /// Distance from the point to the nearest rim, tip or ridge, m. A feature rounded over less than two lengths of
    /// `scale` (m) counts as sharp.
    fn distance_to_edge(&self, x: f64, y: f64, _scale: f64) -> f64 {
        self.distance_to_rim(x, y).abs()
    }

    /// Heights at the element centres of a grid, m: N² values, index `i * N + j`, first index along x.
    fn sample(&self, grid: &Grid) -> Vec<f64> {
        grid.centres().map(|[x, y]| self.height(x, y)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Profile;

    /// `1 + y + x⁴`.
    #[derive(Debug)]
    struct Shape;

    impl Profile for Shape {
        fn height(&self, x: f64, y: f64) -> f64 {
            1.0 + y + x.powi(4)
        }
    }

    #[test]
    fn a_mean_profile_is_the_mean_over_the_circle() {
        for radius in [0.0, 0.5, 2.0_f64] {
            // The mean of cos⁴ is 3/8, and the midpoint rule is exact for it.
            let wanted = 1.0 + 0.375 * radius.powi(4);
            assert!((Shape.mean_profile(radius) / wanted - 1.0).abs() < 1e-14);
        }
    }
}
