//! The power with which the force of a contact grows with its depth, `F = A (D − D₀)ᵖ`: 1 under a flat punch, 3/2 under
//! a ball, 2 under a cone. It gives the shape of the indenter and a start for the modulus.

/// The exponents, of a flat punch, a ball and a cone.
pub(super) const EXPONENTS: [f64; 3] = [1.0, 1.5, 2.0];
/// Forces below this part of the largest are not used: there zeros matter most.
const LEAST_FORCE: f64 = 0.1;
/// At least so many points.
const FEWEST_POINTS: usize = 3;

/// A law `F = A (D − D₀)ᵖ`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PowerLaw {
    /// The exponent p.
    pub(super) exponent: f64,
    /// The coefficient A, N/mᵖ.
    pub(super) coefficient: f64,
    /// The depth D₀ of the contact, m.
    pub(super) zero: f64,
    /// Mean square of the depths about the law, m².
    misfit: f64,
}

impl PowerLaw {
    /// The law of an exponent through the points of a loading: a line of the depth over `F^(1/p)`.
    pub(super) fn with_exponent(exponent: f64, depths: &[f64], forces: &[f64]) -> Option<Self> {
        let largest = forces.iter().copied().fold(0.0, f64::max);
        let pairs = depths.iter().zip(forces);
        let used = pairs.filter(|(_, force)| **force > LEAST_FORCE * largest);
        let (x, y): (Vec<f64>, Vec<f64>) = used
            .map(|(depth, force)| (force.powf(1.0 / exponent), *depth))
            .unzip();
        if x.len() < FEWEST_POINTS {
            return None;
        }
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let (x0, y0) = (mean(&x), mean(&y));
        let sum = |term: &dyn Fn(f64, f64) -> f64| -> f64 {
            x.iter().zip(&y).map(|(x, y)| term(x - x0, y - y0)).sum()
        };
        let slope = sum(&|x, y| x * y) / sum(&|x, _| x * x);
        let misfit = sum(&|x, y| (y - slope * x).powi(2)) / x.len() as f64;
        (slope > 0.0 && slope.is_finite()).then(|| Self {
            exponent,
            coefficient: slope.powf(-exponent),
            zero: y0 - slope * x0,
            misfit,
        })
    }

    /// The law of the exponent that follows the points best.
    pub(super) fn best(depths: &[f64], forces: &[f64]) -> Option<Self> {
        let laws = EXPONENTS
            .iter()
            .filter_map(|p| Self::with_exponent(*p, depths, forces));
        laws.min_by(|one, other| one.misfit.total_cmp(&other.misfit))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponent_coefficient_and_contact_of_a_law_are_found() {
        for exponent in EXPONENTS {
            let depths: Vec<f64> = (0..100).map(|i| 1e-9 * f64::from(i)).collect();
            let force = |d: &f64| 3.0 * (d - 2e-8).max(0.0).powf(exponent);
            let forces: Vec<f64> = depths.iter().map(force).collect();
            let law = PowerLaw::best(&depths, &forces).unwrap();
            assert_eq!(law.exponent, exponent);
            // Some hundred roundings of sums.
            assert!((law.coefficient / 3.0 - 1.0).abs() < 1e-9);
            assert!((law.zero - 2e-8).abs() < 1e-16);
        }
    }
}
