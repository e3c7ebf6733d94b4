//! A smooth function of the force through its values at the loads of a path, with its derivatives.

use super::spline::Spline;

/// Exponent of the power of the force that is divided out before interpolation: that of the energy of a paraboloid on a
/// homogeneous body, `E ∝ Q^(5/3)`. The remainder changes slowly with `ln Q` under any indenter.
const EXPONENT: f64 = 5.0 / 3.0;

/// A function of the force `V(Q) = Q^(5/3) f(ln Q)` with a quintic spline `f` through given values.
///
/// From the energy `E` of a path it gives the penetration, `D = dE/dQ`, between loads and without the steps that occur
/// as elements enter the contact. From `∂E/∂θ` it gives `∂D/∂θ`.
///
/// Accuracy: 0.1 to 0.4 % of `∂D/∂θ` with 400 elements in contact and six loads a decade (`tests/sensitivities.rs`).
///
/// ```
/// use pellicle_contact::ForceCurve;
///
/// // Hertz: E = (2/5) c Q^(5/3), D = c Q^(2/3).
/// let forces: Vec<f64> = (0..8).map(|i| 10_f64.powf(-3.0 + 0.25 * f64::from(i))).collect();
/// let energies: Vec<f64> = forces.iter().map(|force| 0.6 * force.powf(5.0 / 3.0)).collect();
/// let curve = ForceCurve::through(&forces, &energies).unwrap();
/// // Of rounding alone.
/// assert!((curve.derivative(0.02) / 0.02_f64.powf(2.0 / 3.0) - 1.0).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ForceCurve {
    /// `f` and its first three derivatives.
    splines: [Spline; 4],
}

impl ForceCurve {
    /// Smallest number of points for a curve.
    pub const FEWEST: usize = Spline::FEWEST;

    /// The curve through values at forces (N), which are positive and ascending; none for fewer than six.
    #[must_use]
    pub fn through(forces: &[f64], values: &[f64]) -> Option<Self> {
        let places: Vec<f64> = forces.iter().map(|force| force.ln()).collect();
        let pairs = forces.iter().zip(values);
        let reduced: Vec<f64> = pairs.map(|(q, v)| v / q.powf(EXPONENT)).collect();
        let spline = Spline::through(&places, &reduced)?;
        let first = spline.derivative();
        let second = first.derivative();
        let third = second.derivative();
        Some(Self {
            splines: [spline, first, second, third],
        })
    }

    /// `V`.
    #[must_use]
    pub fn value(&self, force: f64) -> f64 {
        let [f, ..] = self.at(force);
        force.powf(EXPONENT) * f
    }

    /// `dV/dQ = Q^(m−1) (m f + f′)`.
    #[must_use]
    pub fn derivative(&self, force: f64) -> f64 {
        let [f, slope, ..] = self.at(force);
        force.powf(EXPONENT - 1.0) * (EXPONENT * f + slope)
    }

    /// `d²V/dQ² = Q^(m−2) ((m − 1)(m f + f′) + m f′ + f″)`.
    #[must_use]
    pub fn second_derivative(&self, force: f64) -> f64 {
        let [f, slope, bend, _] = self.at(force);
        let m = EXPONENT;
        force.powf(m - 2.0) * ((m - 1.0) * (m * f + slope) + m * slope + bend)
    }

    /// `d³V/dQ³ = Q^(m−3) ((m − 2) h + h′)` with `h = (m − 1)(m f + f′) + m f′ + f″`.
    #[must_use]
    pub fn third_derivative(&self, force: f64) -> f64 {
        let [f, slope, bend, jerk] = self.at(force);
        let m = EXPONENT;
        let second = (m - 1.0) * (m * f + slope) + m * slope + bend;
        let change = (m - 1.0) * (m * slope + bend) + m * bend + jerk;
        force.powf(m - 3.0) * ((m - 2.0) * second + change)
    }

    fn at(&self, force: f64) -> [f64; 4] {
        let place = force.ln();
        [0, 1, 2, 3].map(|order: usize| self.splines[order].value(place))
    }
}

#[cfg(test)]
mod tests {
    use super::ForceCurve;

    #[test]
    fn power_laws_within_the_range_of_all_indenters_are_reproduced_with_their_derivatives() {
        let forces: Vec<f64> = (0..=12)
            .map(|i| 10_f64.powf(f64::from(i) / 6.0 - 9.0))
            .collect();
        for power in [1.5, 5.0 / 3.0, 2.0] {
            let values: Vec<f64> = forces.iter().map(|q| q.powf(power)).collect();
            let curve = ForceCurve::through(&forces, &values).unwrap();
            for q in [1.1e-9, 7e-9, 8.8e-8] {
                let first = power * f64::powf(q, power - 1.0);
                let second = (power - 1.0) * first / q;
                let third = (power - 2.0) * second / q;
                // Of a paraboloid's size where it is zero.
                let error_of_third = (curve.third_derivative(q) - third) / (second / q);
                assert!(
                    error_of_third.abs() < 2e-4,
                    "{power} {q}: {error_of_third:e}"
                );
                let errors = [
                    curve.value(q) / f64::powf(q, power) - 1.0,
                    curve.derivative(q) / first - 1.0,
                    curve.second_derivative(q) / second - 1.0,
                ];
                // An exponential of x/3 at places 0.38 apart; near an end a quintic has an error of 0.13⁶/6! of it.
                for (error, bound) in errors.into_iter().zip([2e-7, 1e-6, 2e-5]) {
                    assert!(error.abs() < bound, "{power} {q}: {errors:?}");
                }
            }
        }
    }
}
