//! Weighted least squares with a few terms and several right-hand sides.

use nalgebra::{SMatrix, SVector};

/// Pivots below this part of the largest diagonal entry leave a fit undetermined.
const UNDETERMINED: f64 = 1e-9;

/// The normal equations of a fit of `T` terms to `Q` quantities at once.
pub struct LeastSquares<const T: usize, const Q: usize> {
    products: SMatrix<f64, T, T>,
    sums: SMatrix<f64, T, Q>,
    count: usize,
}

impl<const T: usize, const Q: usize> LeastSquares<T, Q> {
    pub fn new() -> Self {
        Self {
            products: SMatrix::zeros(),
            sums: SMatrix::zeros(),
            count: 0,
        }
    }

    /// Adds a point with its weight, terms and values.
    pub fn add(&mut self, weight: f64, terms: [f64; T], values: [f64; Q]) {
        let terms = SVector::from(terms);
        let values = SVector::from(values);
        self.products += terms * terms.transpose() * weight;
        self.sums += terms * values.transpose() * weight;
        self.count += 1;
    }

    /// The coefficients of the terms, for each quantity; none if the points do not determine them.
    pub fn solve(&self) -> Option<[[f64; T]; Q]> {
        if self.count < T {
            return None;
        }
        let largest = self.products.diagonal().max();
        let factor = self.products.cholesky()?;
        let least = factor.l_dirty().diagonal().map(|pivot| pivot * pivot).min();
        let solution = (least > UNDETERMINED * largest).then(|| factor.solve(&self.sums))?;
        Some(std::array::from_fn(|quantity| {
            std::array::from_fn(|term| solution[(term, quantity)])
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::LeastSquares;

    #[test]
    fn polynomials_are_recovered_and_too_few_points_or_terms_alike_give_none() {
        let mut fit = LeastSquares::<3, 2>::new();
        let mut alike = LeastSquares::<3, 2>::new();
        for i in 0..7 {
            let x = f64::from(i) - 3.0;
            let values = [1.0 - 2.0 * x + 0.5 * x * x, x];
            assert_eq!(fit.solve().is_some(), i >= 3);
            fit.add(1.0 + 0.1 * x, [1.0, x, x * x], values);
            alike.add(1.0, [1.0, x, 1.0 + x], values);
        }
        let [one, other] = fit.solve().unwrap();
        let near = |found: [f64; 3], wanted: [f64; 3]| {
            // Rounding of products of order 100.
            found
                .iter()
                .zip(wanted)
                .all(|(found, wanted)| (found - wanted).abs() < 1e-12)
        };
        assert!(near(one, [1.0, -2.0, 0.5]) && near(other, [0.0, 1.0, 0.0]));
        assert!(alike.solve().is_none());
    }
}
