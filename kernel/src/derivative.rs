//! Derivatives of the response with respect to a parameter of the foundation.

use crate::{Foundation, FoundationParameter, KernelError};

/// Points of the difference: the value and three steps on each side, or more of them on one side where the value lies
/// near an end of its range.
const POINTS: usize = 7;
/// Relative step of positive parameters; for Poisson's ratio, the step over the length of its range.
///
/// `∂Φ/∂ ln H` of a wave of `s = kH` falls like `e^{−2s}`, and its seventh derivative with respect to `ln H` is below
/// 800: its error, `h⁶/140` times that, is 6e-12. Rounding leaves `2 ε/h` = 5e-14.
const STEP: f64 = 1e-2;

/// `∂Φ/∂θ` at any wavenumber, for the response `Φ` and a parameter θ of a foundation, by sixth-order differences
/// between foundations with other values of θ.
///
/// The differences are central, or one-sided near 0 and ½ of Poisson's ratio. Error: 1e-10 of `Φ/θ` for moduli,
/// thicknesses and compliances, 1e-10 of Φ for Poisson's ratio (`tests/derivative.rs`). A value costs six responses.
///
/// ```
/// use pellicle_kernel::{Foundation, FoundationParameter, Material};
///
/// let (coating, steel) = (Material::new(400e9, 0.25)?, Material::new(210e9, 0.3)?);
/// let coated = Foundation::coated(2e-6, coating, steel)?;
/// let by_modulus = coated.response_derivative(FoundationParameter::YoungModulus { body: 1 })?;
/// // Long waves see the substrate alone: Φ → Φ(0) is inversely proportional to its modulus; 1e-5 is the coating's.
/// let relative = by_modulus.value(1.0) * 210e9 / coated.response(1.0);
/// assert!((relative + 1.0).abs() < 1e-4);
/// # Ok::<(), pellicle_kernel::KernelError>(())
/// ```
#[derive(Debug, Clone)]
pub struct ResponseDerivative {
    /// Foundations with other values of the parameter, and the weight of each, per unit of the parameter.
    terms: Vec<(f64, Foundation)>,
}

impl Foundation {
    /// The derivative of the response with respect to one parameter.
    ///
    /// # Errors
    ///
    /// [`KernelError::NoBody`] if the foundation has no such parameter; the errors of [`Foundation::with_parameter`] if
    /// a value a hundredth away gives no foundation.
    pub fn response_derivative(
        &self,
        parameter: FoundationParameter,
    ) -> Result<ResponseDerivative, KernelError> {
        let value = self.parameter(parameter).unwrap_or(f64::NAN);
        let (step, range) = match parameter {
            FoundationParameter::PoissonRatio { .. } => (STEP / 2.0, [0.0, 0.5]),
            _ => (STEP * value, [0.0, f64::INFINITY]),
        };
        let offsets = offsets(value, step, range);
        let weights = weights(&offsets);
        let terms = offsets
            .iter()
            .zip(weights)
            .filter(|(_, weight)| *weight != 0.0);
        let terms = terms.map(|(offset, weight)| {
            let [low, high] = range;
            let other = (value + offset * step).clamp(low, high);
            Ok((weight / step, self.with_parameter(parameter, other)?))
        });
        let terms = terms.collect::<Result<_, KernelError>>()?;
        Ok(ResponseDerivative { terms })
    }
}

impl ResponseDerivative {
    /// `∂Φ/∂θ` at the wavenumber `k` (1/m), per unit of θ.
    #[must_use]
    pub fn value(&self, wavenumber: f64) -> f64 {
        let terms = self.terms.iter();
        terms
            .map(|(weight, foundation)| weight * foundation.response(wavenumber))
            .sum()
    }
}

/// The points of the difference in steps from the value: central, or shifted into the range.
fn offsets(value: f64, step: f64, [low, high]: [f64; 2]) -> [f64; POINTS] {
    let reach = (POINTS / 2) as f64;
    // The value itself must be a point, so that it has weight 0 where the others lie symmetrically around it.
    let room = |distance: f64| (distance / step + 0.5).floor().clamp(0.0, reach);
    let shift = (reach - room(value - low)) - (reach - room(high - value));
    std::array::from_fn(|i| i as f64 - reach + shift)
}

/// Weights of the derivative at 0 of the polynomial through these points, one of which is 0 (Lagrange).
fn weights(points: &[f64; POINTS]) -> [f64; POINTS] {
    // ℓ_i'(0) = Π_{j ≠ i, 0} (−x_j) / Π_{j ≠ i} (x_i − x_j);  for x_i = 0 the sum of −1/x_j
    let others = |i: usize| (0..POINTS).filter(move |j| *j != i).map(|j| points[j]);
    std::array::from_fn(|i| {
        let own = points[i];
        if own == 0.0 {
            let sum: f64 = others(i).map(|x| 1.0 / x).sum();
            return if sum.abs() < f64::EPSILON { 0.0 } else { -sum };
        }
        let numerator: f64 = others(i).filter(|x| *x != 0.0).map(|x| -x).product();
        numerator / others(i).map(|x| own - x).product::<f64>()
    })
}

#[cfg(test)]
mod tests {
    use super::{POINTS, offsets, weights};

    #[test]
    fn the_weights_differentiate_polynomials_of_their_degree() {
        for shift in -3..=3 {
            let points: [f64; POINTS] = std::array::from_fn(|i| i as f64 - 3.0 + f64::from(shift));
            let weights = weights(&points);
            for power in 0..POINTS {
                let terms = points.iter().zip(weights);
                let found: f64 = terms
                    .map(|(x, w)| w * x.powi(i32::try_from(power).unwrap()))
                    .sum();
                let expected = if power == 1 { 1.0 } else { 0.0 };
                // Powers up to 6⁶ with weights up to 20: rounding of 1e6.
                assert!((found - expected).abs() < 1e-9, "{shift} {power}: {found}");
            }
        }
    }

    #[test]
    fn points_stay_in_the_range() {
        for (value, first) in [(0.25, -3.0), (0.0, 0.0), (0.5, -6.0), (0.011, -2.0)] {
            let found = offsets(value, 0.005, [0.0, 0.5]);
            assert!((found[0] - first).abs() < 1e-12, "{value}: {found:?}");
        }
    }
}
