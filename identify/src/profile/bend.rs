//! How a profile bends through the best fit, so that one side tells where the other begins.
//!
//! With `z < 0` below the best fit, `x(z)` is smooth there, and so are the others over `s = x − x₀`. Value and slope at
//! the best fit and at one point make each a cubic:
//!
//! ```text
//! x − x₀ = σ z + c z² + d z³          x_k − x_k0 = τ_k s + q_k s² + r_k s³
//! ```

use super::point::Point;

/// Square and cube of the profile's cubics.
#[derive(Debug, Clone)]
pub(crate) struct Bend {
    /// `c` and `d`.
    unknown: [f64; 2],
    /// `q_k` and `r_k` of each unknown.
    others: Vec<[f64; 2]>,
}

impl Bend {
    /// From the best fit and a point on its side `sign`; none where the profile does not rise there.
    pub fn between(first: &Point, point: &Point, sign: f64) -> Option<Self> {
        if !(point.slope > 0.0 && point.z > 0.0) {
            return None;
        }
        let stride = point.x - first.x;
        let slopes = [first, point].map(|of| 1.0 / of.slope);
        let others = (0..first.tangent.len()).map(|k| {
            let change = point.least[k] - first.least[k];
            powers(stride, change, [first.tangent[k], point.tangent[k]])
        });
        Some(Self {
            unknown: powers(sign * point.z, stride, slopes),
            others: others.collect(),
        })
    }

    /// `x − x₀` at a `z`, for a profile of this slope `σ` at the best fit.
    pub fn stride(&self, slope: f64, z: f64) -> f64 {
        let [c, d] = self.unknown;
        z * (slope + z * (c + z * d))
    }

    /// How far unknown `k` follows a stride from the best fit.
    pub fn follow(&self, first: &Point, k: usize, stride: f64) -> f64 {
        let [q, r] = self.others[k];
        stride * (first.tangent[k] + stride * (q + stride * r))
    }
}

/// Square and cube of a cubic `s₀ u + c u² + d u³` that has this value at `u` and these slopes at zero and there.
fn powers(u: f64, value: f64, [at_zero, there]: [f64; 2]) -> [f64; 2] {
    // c + d u and 2c + 3d u
    let (by_value, by_slope) = ((value / u - at_zero) / u, (there - at_zero) / u);
    let d = (by_slope - 2.0 * by_value) / u;
    [by_value - d * u, d]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_found_from_one_value_and_two_slopes() {
        let (s, c, d, u) = (0.7, -0.3, 0.11, -1.9);
        let value = u * (s + u * (c + u * d));
        let slope = s + u * (2.0 * c + 3.0 * u * d);
        let [found_c, found_d] = powers(u, value, [s, slope]);
        // A few roundings of differences of numbers about one.
        assert!((found_c - c).abs() < 1e-14 && (found_d - d).abs() < 1e-14);
    }
}
