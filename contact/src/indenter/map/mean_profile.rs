//! The mean height of a map over circles around its tip, from a table.
//!
//! The first guess of a domain needs it about a thousand times per load: without a table that took 25 times as long as
//! the solution on 64 × 64 elements.

use std::f64::consts::TAU;

/// Ratio of neighbouring radii.
const RATIO: f64 = 1.1;
/// Number of points on a circle, some of which may lie beyond the end of the map.
const ANGLES: u32 = 360;

/// Mean heights at radii in equal ratios, interpolated by a power of the radius.
#[derive(Debug, Clone)]
pub struct MeanProfile {
    /// The smallest radius, m.
    first: f64,
    heights: Vec<f64>,
}

impl MeanProfile {
    /// The mean of `height` over circles with radii from `first` to `last`, m, without infinite values.
    pub fn new(height: impl Fn(f64, f64) -> f64, [first, last]: [f64; 2]) -> Self {
        let direction = |k: u32| ((f64::from(k) + 0.5) * TAU / f64::from(ANGLES)).sin_cos();
        let directions: Vec<(f64, f64)> = (0..ANGLES).map(direction).collect();
        let mean = |radius: f64| {
            let heights = directions
                .iter()
                .map(|(sine, cosine)| height(radius * cosine, radius * sine));
            let heights = heights.filter(|height| height.is_finite());
            let (count, sum) =
                heights.fold((0, 0.0), |(count, sum), height| (count + 1, sum + height));
            if count == 0 {
                f64::INFINITY
            } else {
                sum / f64::from(count)
            }
        };
        let radii = std::iter::successors(Some(first), |radius| Some(radius * RATIO));
        let radii = radii.take_while(|radius| *radius < last * RATIO);
        Self {
            first,
            heights: radii.map(mean).collect(),
        }
    }

    /// The mean over a circle, m; infinite beyond the last one.
    pub fn at(&self, radius: f64) -> f64 {
        // Below the first radius the power between the first two continues.
        let place = ((radius / self.first).ln() / RATIO.ln()).floor().max(0.0);
        if place + 2.0 > self.heights.len() as f64 {
            return f64::INFINITY;
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number from 0 to below a length"
        )]
        let index = place as usize;
        let (low, high) = (self.heights[index], self.heights[index + 1]);
        if low.is_infinite() || high.is_infinite() {
            return f64::INFINITY;
        }
        let ratio = radius / (self.first * RATIO.powf(place));
        if low > 0.0 && high > 0.0 {
            // f ∝ ρⁿ
            low * ratio.powf((high / low).ln() / RATIO.ln())
        } else {
            low + (high - low) * (ratio - 1.0) / (RATIO - 1.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::MeanProfile;

    #[test]
    fn a_power_law_is_exact_within_and_below_the_radii() {
        for power in [1.0, 2.0, 3.5] {
            let height = |x: f64, y: f64| x.hypot(y).powf(power);
            let mean = MeanProfile::new(height, [1e-3, 2.0]);
            for radius in [1e-5, 1e-3, 0.0123, 1.0, 1.9999] {
                let exact = f64::powf(radius, power);
                // Rounding of powers and of a sum of 360.
                assert!(
                    (mean.at(radius) / exact - 1.0).abs() < 1e-12,
                    "{power} {radius}"
                );
            }
        }
    }

    #[test]
    fn points_beyond_the_end_are_left_out_and_a_circle_wholly_beyond_is_infinite() {
        let height = |x: f64, y: f64| {
            if x.abs() < 1.0 && y.abs() < 2.0 {
                x * x + y * y
            } else {
                f64::INFINITY
            }
        };
        let mean = MeanProfile::new(height, [0.01, 3.0]);
        assert!((mean.at(1.5) - 2.25).abs() < 1e-12);
        assert_eq!([mean.at(2.6), mean.at(1e9)], [f64::INFINITY; 2]);
        let beyond = (0..60).map(|k| 2.6 + 0.05 * f64::from(k));
        assert!(beyond.map(|radius| mean.at(radius)).all(f64::is_infinite));
    }

    #[test]
    fn a_dent_at_the_tip_is_interpolated_linearly() {
        let mean = MeanProfile::new(|x, y| x.hypot(y) - 1.0, [0.5, 4.0]);
        assert!((mean.at(0.52) + 0.48).abs() < 1e-12, "{}", mean.at(0.52));
        // The error of a power through both ends of a straight line with an offset.
        assert!((mean.at(3.0) - 2.0).abs() < 2e-3, "{}", mean.at(3.0));
    }

    #[test]
    fn from_a_flat_tip_the_mean_rises_linearly() {
        // The mean is 0 up to a radius of 1, and ρ − 1 beyond: a power of the radius would be infinite or undefined.
        let mean = MeanProfile::new(|x, y| (x.hypot(y) - 1.0).max(0.0), [0.5, 4.0]);
        // The radii around 1: 0.5 · 1.1⁷ and 0.5 · 1.1⁸.
        let [low, high] = [7, 8].map(|k| 0.5 * 1.1_f64.powi(k));
        for part in [0.25, 0.5, 0.75] {
            let found = mean.at(low + part * (high - low));
            assert!(
                (found - part * (high - 1.0)).abs() < 1e-12,
                "{part}: {found}"
            );
        }
        assert_eq!([mean.at(0.1), mean.at(0.7)], [0.0; 2]);
    }

    #[test]
    fn to_a_flat_ring_the_mean_falls_linearly() {
        // 1 − ρ down to 0 from a radius of 1 on.
        let mean = MeanProfile::new(|x, y| (1.0 - x.hypot(y)).max(0.0), [0.5, 4.0]);
        let [low, high] = [7, 8].map(|k| 0.5 * 1.1_f64.powi(k));
        for part in [0.25, 0.5, 0.75] {
            let found = mean.at(low + part * (high - low));
            assert!(
                (found - (1.0 - part) * (1.0 - low)).abs() < 1e-12,
                "{part}: {found}"
            );
        }
    }
}
