//! B-splines through given points (de Boor, *A Practical Guide to Splines*, 1978).

/// A spline of some degree: `Σ c_i B_i(x)`.
#[derive(Debug, Clone, PartialEq)]
pub struct Spline {
    degree: usize,
    /// As many as degree plus coefficients plus one.
    knots: Vec<f64>,
    coefficients: Vec<f64>,
}

/// Degree of interpolating splines.
const DEGREE: usize = 5;
/// Bandwidth of their system.
const WIDTH: usize = 2 * DEGREE + 1;

impl Spline {
    /// Smallest number of points for a spline.
    pub const FEWEST: usize = DEGREE + 1;

    /// The quintic spline through points with ascending places. Its knots are the places except the second and third
    /// from either end. None for fewer than six places, or places that do not ascend.
    pub fn through(places: &[f64], values: &[f64]) -> Option<Self> {
        let count = places.len();
        let ascends = places.windows(2).all(|pair| pair[0] < pair[1]);
        if count < Self::FEWEST || !ascends {
            return None;
        }
        let (first, last) = (places[0], places[count - 1]);
        let knots = [first; DEGREE + 1].into_iter();
        let knots = knots.chain(places[3..count - 3].iter().copied());
        let mut spline = Self {
            degree: DEGREE,
            knots: knots.chain([last; DEGREE + 1]).collect(),
            coefficients: values.to_vec(),
        };
        spline.interpolate(places);
        Some(spline)
    }

    /// Turns values at places into coefficients by banded elimination, which needs no pivoting because the matrix is
    /// totally positive.
    fn interpolate(&mut self, places: &[f64]) {
        let count = places.len();
        // Row i holds B_j(x_i) for j = i − 5 … i + 5.
        let mut rows = vec![[0.0; WIDTH]; count];
        for (i, place) in places.iter().enumerate() {
            let span = self.span(*place);
            for (offset, value) in self.basis(span, *place).into_iter().enumerate() {
                if let Some(entry) = rows[i].get_mut(span - DEGREE + offset + DEGREE - i) {
                    *entry = value;
                }
            }
        }
        for i in 0..count {
            for below in i + 1..count.min(i + DEGREE + 1) {
                let shift = below - i;
                let factor = rows[below][DEGREE - shift] / rows[i][DEGREE];
                for column in 0..=DEGREE {
                    let value = rows[i][DEGREE + column];
                    rows[below][DEGREE + column - shift] -= factor * value;
                }
                self.coefficients[below] -= factor * self.coefficients[i];
            }
        }
        for i in (0..count).rev() {
            let after = 1..=DEGREE.min(count - 1 - i);
            let known: f64 = after
                .map(|shift| rows[i][DEGREE + shift] * self.coefficients[i + shift])
                .sum();
            self.coefficients[i] = (self.coefficients[i] - known) / rows[i][DEGREE];
        }
    }

    /// The index of the knot that begins the piece with x; outside, that of the first or last piece.
    fn span(&self, x: f64) -> usize {
        let after = self.knots.partition_point(|knot| *knot <= x);
        after.clamp(self.degree + 1, self.coefficients.len()) - 1
    }

    /// The B-splines that are not zero on the piece, from the first (Cox, de Boor).
    fn basis(&self, span: usize, x: f64) -> [f64; DEGREE + 1] {
        let mut basis = [0.0; DEGREE + 1];
        basis[0] = 1.0;
        for degree in 1..=self.degree {
            let mut carried = 0.0;
            for (r, value) in basis.into_iter().enumerate().take(degree) {
                let [right, left] = [self.knots[span + 1 + r], self.knots[span + 1 + r - degree]];
                let part = value / (right - left);
                basis[r] = carried + (right - x) * part;
                carried = (x - left) * part;
            }
            basis[degree] = carried;
        }
        basis
    }

    /// The value at x; outside the points, that of the outermost polynomial.
    pub fn value(&self, x: f64) -> f64 {
        let span = self.span(x);
        let basis = self.basis(span, x);
        let coefficients = &self.coefficients[span - self.degree..];
        basis
            .iter()
            .zip(coefficients)
            .take(self.degree + 1)
            .map(|(b, c)| b * c)
            .sum()
    }

    /// The derivative, a spline of one degree less.
    pub fn derivative(&self) -> Self {
        let degree = self.degree;
        let pairs = self.coefficients.windows(2).enumerate();
        let coefficients = pairs.map(|(i, pair)| {
            // p (c_(i+1) − c_i)/(t_(i+p+1) − t_(i+1))
            degree as f64 * (pair[1] - pair[0]) / (self.knots[i + degree + 1] - self.knots[i + 1])
        });
        Self {
            degree: degree - 1,
            coefficients: coefficients.collect(),
            knots: self.knots[1..self.knots.len() - 1].to_vec(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Spline;

    fn places(count: u32) -> Vec<f64> {
        let stretched = |i: u32| f64::from(i) + 0.3 * f64::from(i).sin();
        (0..count).map(stretched).collect()
    }

    #[test]
    fn a_quintic_and_its_derivatives_are_reproduced_exactly() {
        let polynomial = |x: f64| 1.0 + x * (0.5 + x * x * (0.01 - 1e-4 * x * x));
        let slope = |x: f64| 0.5 + x * x * (0.03 - 5e-4 * x * x);
        let bend = |x: f64| x * (0.06 - 2e-3 * x * x);
        for count in [6, 7, 8, 9, 14, 40] {
            let places = places(count);
            let values: Vec<f64> = places.iter().map(|x| polynomial(*x)).collect();
            let spline = Spline::through(&places, &values).unwrap();
            let (first, second) = (spline.derivative(), spline.derivative().derivative());
            let end = places[places.len() - 1];
            let scale = values
                .iter()
                .fold(1.0, |most: f64, value| most.max(value.abs()));
            // The outermost polynomials continue outside.
            for i in -1..=51 {
                let x = end * f64::from(i) / 50.0;
                for (found, expected) in [
                    (spline.value(x), polynomial(x)),
                    (first.value(x), slope(x)),
                    (second.value(x), bend(x)),
                ] {
                    // Rounding of the largest value, times the system's condition number of about 1e3.
                    assert!((found - expected).abs() < 1e-12 * scale, "{count} {x}");
                }
            }
        }
    }

    #[test]
    fn the_error_falls_with_the_sixth_power_of_the_spacing() {
        let error = |count: u32| {
            let places: Vec<f64> = (0..=count)
                .map(|i| f64::from(i) / f64::from(count))
                .collect();
            let values: Vec<f64> = places.iter().map(|x| (3.0 * x).exp()).collect();
            let spline = Spline::through(&places, &values).unwrap();
            let at = |i: u32| (f64::from(i) + 0.5) / 200.0;
            let errors = (0..200).map(|i| (spline.value(at(i)) - (3.0 * at(i)).exp()).abs());
            errors.fold(0.0, f64::max)
        };
        let ratio = error(10) / error(20);
        assert!(ratio > 30.0, "{ratio}");
    }

    #[test]
    fn too_few_or_coincident_points_have_no_spline() {
        assert_eq!(Spline::through(&[0.0; 5], &[0.0; 5]), None);
        assert_eq!(
            Spline::through(&[0.0, 1.0, 2.0, 2.0, 3.0, 4.0], &[0.0; 6]),
            None
        );
    }
}
