//! Hertz: a paraboloid with two radii of curvature on an elastic half-space, whose contact is an ellipse.
//!
//! With `a` the semi-axis along the larger radius, `κ = b/a` and Carlson's symmetric integrals, the equations of K. L.
//! Johnson, Contact Mechanics, 1985, §4.2, read
//!
//! ```text
//! R_a/R_b = R_D(0, 1, κ²)/R_D(0, κ², 1),    a³ = Q R_a R_D(0, κ², 1)/(π E*),
//! p₀ = 3Q/(2πab),                           D = 3Q/(2πE*) R_F(0, a², b²)
//! ```

use std::f64::consts::PI;

use crate::path::domain::root_finding::where_zero;

/// The contact of a paraboloid `f = x²/2Rx + y²/2Ry` with an elastic half-space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipticHertzContact {
    /// Force Q, N.
    pub force: f64,
    /// Penetration D, m.
    pub penetration: f64,
    /// Semi-axes of the contact along x and y, m.
    pub semi_axes: [f64; 2],
    /// Pressure on the axis, the largest, Pa.
    pub peak_pressure: f64,
}

/// The contact under a force Q (N), for the indenter's radii Rx and Ry (m) and the plane-strain modulus E* (Pa);
/// accurate to 1e-13 for radii in any ratio up to a million.
///
/// ```
/// use pellicle_contact::reference::{elliptic_hertz, hertz};
///
/// let [ellipse, circle] = [
///     elliptic_hertz::from_force([2.0, 2.0], 1.0, 0.3).penetration,
///     hertz::from_force(2.0, 1.0, 0.3).penetration,
/// ];
/// // Rounding of the iterations.
/// assert!((ellipse / circle - 1.0).abs() < 1e-13);
/// ```
#[must_use]
pub fn from_force(radii: [f64; 2], plane_strain_modulus: f64, force: f64) -> EllipticHertzContact {
    let [large, small] = [radii[0].max(radii[1]), radii[0].min(radii[1])];
    let ratio = axis_ratio(large / small);
    // a³ = Q R_a R_D(0, κ², 1)/(π E*)
    let along = carlson_d(ratio * ratio, 1.0);
    let a = (force * large * along / (PI * plane_strain_modulus)).cbrt();
    let b = ratio * a;
    EllipticHertzContact {
        force,
        // R_F(0, a², b²) = π/(2 agm(a, b))
        penetration: 3.0 * force / (4.0 * plane_strain_modulus * arithmetic_geometric_mean(a, b)),
        semi_axes: if radii[0] >= radii[1] { [a, b] } else { [b, a] },
        peak_pressure: 1.5 * force / (PI * a * b),
    }
}

impl EllipticHertzContact {
    /// Pressure at a point (m), Pa: `p = p₀ √(1 − x²/a² − y²/b²)`, 0 outside the contact.
    #[must_use]
    pub fn pressure(&self, [x, y]: [f64; 2]) -> f64 {
        let [a, b] = self.semi_axes;
        let square = 1.0 - (x / a).powi(2) - (y / b).powi(2);
        self.peak_pressure * square.max(0.0).sqrt()
    }
}

/// `κ = b/a` for a ratio of radii of at least 1.
fn axis_ratio(radii: f64) -> f64 {
    // The ratio of the integrals falls from ∞ to 1 where κ grows to 1.
    let of_curvatures = |ratio: f64| {
        let square = ratio * ratio;
        carlson_d(1.0, square) / carlson_d(square, 1.0)
    };
    let found = where_zero(|inverse| (of_curvatures(1.0 / inverse) / radii).ln());
    found.recip().min(1.0)
}

/// Carlson's `R_D(0, y, z) = 3/2 ∫₀^∞ dt/(√t √(t + y) (t + z)^(3/2))`, by duplication (B. C. Carlson, Numer. Algor. 10,
/// 1995, 13–26).
fn carlson_d(y: f64, z: f64) -> f64 {
    /// Duplications: each divides the differences of the arguments by 4, and the series errs by their sixth power, so
    /// that 40 suffice for arguments in any ratio up to 1e12.
    const DUPLICATIONS: usize = 40;
    let (mut arguments, mut sum, mut weight) = ([0.0, y, z], 0.0, 1.0);
    for _ in 0..DUPLICATIONS {
        let [x, y, z] = arguments.map(f64::sqrt);
        // λ = √x √y + √y √z + √z √x
        let lambda = x * y + y * z + z * x;
        sum += weight / (z * (arguments[2] + lambda));
        weight *= 0.25;
        arguments = arguments.map(|of| 0.25 * (of + lambda));
    }
    let [x, y, z] = arguments;
    let mean = (x + y + 3.0 * z) / 5.0;
    3.0 * sum + weight / (mean * mean.sqrt())
}

/// Gauss' mean of two positive numbers.
fn arithmetic_geometric_mean(mut a: f64, mut b: f64) -> f64 {
    /// The differences are squared by each step: from a ratio of 1e-300 to rounding.
    const STEPS: usize = 16;
    for _ in 0..STEPS {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::hertz;

    /// `Rx`, the semi-axes along x and y, the peak and the penetration, for `Ry = 1`, `E* = 1` and `Q = 1`, by a
    /// quadrature of the integrals independent of this file; ten digits are given.
    const TABLE: [[f64; 5]; 3] = [
        [
            1.0,
            0.908_560_296_4,
            0.908_560_296_4,
            0.578_407_449_1,
            0.825_481_812_2,
        ],
        [
            2.0,
            1.275_820_798_2,
            0.804_527_111_1,
            0.465_169_279,
            0.730_561_613_6,
        ],
        [
            10.0,
            2.650_850_107_2,
            0.589_150_161_9,
            0.305_724_479_2,
            0.524_899_271_2,
        ],
    ];

    #[test]
    fn ellipses_have_the_tabulated_numbers() {
        for [radius, a, b, peak, penetration] in TABLE {
            for swapped in [false, true] {
                let radii = if swapped {
                    [1.0, radius]
                } else {
                    [radius, 1.0]
                };
                let found = from_force(radii, 1.0, 1.0);
                let [x, y] = found.semi_axes;
                let axes = if swapped { [y, x] } else { [x, y] };
                let found = [axes[0], axes[1], found.peak_pressure, found.penetration];
                for (found, wanted) in found.into_iter().zip([a, b, peak, penetration]) {
                    assert!(
                        (found / wanted - 1.0).abs() < 1e-9,
                        "{radius}: {found} {wanted}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_round_ellipse_is_hertzs_circle_and_a_long_one_has_the_right_pressure_and_work() {
        let circle = hertz::from_force(2.0, 3.0, 0.7);
        let found = from_force([2.0, 2.0], 3.0, 0.7);
        assert!((found.semi_axes[0] / circle.contact_radius - 1.0).abs() < 1e-13);
        assert!((found.penetration / circle.penetration - 1.0).abs() < 1e-13);
        for ratio in [3.0, 50.0, 1e6] {
            let at = |force| from_force([ratio, 1.0], 1.0, force);
            let found = at(1.0);
            // D ∝ Q^⅔
            let exponent =
                (at(1.001).penetration / at(0.999).penetration).ln() / (1.001_f64 / 0.999).ln();
            assert!((exponent - 2.0 / 3.0).abs() < 1e-9, "{exponent}");
            // ∫ p dA = 2/3 p₀ π a b
            let [a, b] = found.semi_axes;
            let force = 2.0 / 3.0 * found.peak_pressure * PI * a * b;
            assert!((force - 1.0).abs() < 1e-14 && a > b);
        }
    }
}
