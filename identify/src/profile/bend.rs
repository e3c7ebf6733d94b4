//! The bend of a profile at the best fit, by which one side predicts the start of the other.
//!
//! With `z < 0` below the best fit, `x(z)` is smooth there, and so are the others as functions of `s = x − x₀`. Values
//! and slopes at the best fit and at one point define the cubics:
//!
//! ```text
//! x − x₀ = σ z + c z² + d z³          x_k − x_k0 = τ_k s + q_k s² + r_k s³
//! ```

use super::point::Point;

/// The quadratic and cubic coefficients of a profile.
#[derive(Debug, Clone)]
pub(crate) struct Bend {
    /// `c` and `d`.
    unknown: [f64; 2],
    /// `q_k` and `r_k` of each unknown.
    others: Vec<[f64; 2]>,
}

impl Bend {
    /// The bend from the best fit and a point on its side `sign`; `None` if the profile does not rise there.
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

    /// `x − x₀` at `z`, for a profile of slope `σ` at the best fit.
    pub fn stride(&self, slope: f64, z: f64) -> f64 {
        let [c, d] = self.unknown;
        z * (slope + z * (c + z * d))
    }

    /// The displacement of unknown `k` for a stride from the best fit.
    pub fn follow(&self, first: &Point, k: usize, stride: f64) -> f64 {
        let [q, r] = self.others[k];
        stride * (first.tangent[k] + stride * (q + stride * r))
    }
}

/// The coefficients `c` and `d` of the cubic `s₀ u + c u² + d u³` with this value at `u` and these slopes at zero and
/// `u`.
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
