//! Points that fill a cube evenly for any number of them.
//!
//! The additive recurrence `u_i = frac(s + i α)`, `α_j = φ^−j`, `φ^(d+1) = φ + 1`, of low discrepancy: M. Roberts,
//! The unreasonable effectiveness of quasirandom sequences, 2018. In one dimension φ is the golden ratio.

use std::f64::consts::PI;

use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

/// The sequence from a random start.
pub(super) struct SamplePoints {
    start: Vec<f64>,
    step: Vec<f64>,
}

impl SamplePoints {
    pub fn new(dimensions: usize, seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut ratio = 2.0_f64;
        // φ ← (1 + φ)^(1/(d+1)) contracts by at least 1/(d+1) each time.
        for _ in 0..64 {
            ratio = (1.0 + ratio).powf(1.0 / (dimensions + 1) as f64);
        }
        Self {
            start: (0..dimensions).map(|_| random.random()).collect(),
            step: std::iter::successors(Some(1.0 / ratio), |step| Some(step / ratio))
                .take(dimensions)
                .collect(),
        }
    }

    /// Point `i`, evenly distributed in `[−1, 1]`.
    pub fn even(&self, i: usize) -> Vec<f64> {
        let unit = self.unit(i);
        unit.map(|u| 2.0 * u - 1.0).collect()
    }

    /// Point `i`, distributed like Chebyshev nodes, `t = −cos πu`.
    pub fn chebyshev(&self, i: usize) -> Vec<f64> {
        self.unit(i).map(|u| -(PI * u).cos()).collect()
    }

    fn unit(&self, i: usize) -> impl Iterator<Item = f64> {
        let pairs = self.start.iter().zip(&self.step);
        pairs.map(move |(start, step)| (i as f64).mul_add(*step, *start).fract())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sample_points_cover_the_square_evenly() {
        let points = SamplePoints::new(2, 7);
        let mut counts = [0; 16];
        for i in 0..1600 {
            let place = points.even(i);
            let cell = |t: f64| [-0.5, 0.0, 0.5].iter().filter(|edge| t >= **edge).count();
            counts[4 * cell(place[0]) + cell(place[1])] += 1;
        }
        // Random points would scatter by ten; these by the logarithm of their number.
        assert!(
            counts.iter().all(|c: &i32| (c - 100).abs() <= 4),
            "{counts:?}"
        );
    }
}
