//! Errors of single points that are known beside the noise that all have in common.

use crate::IdentifyError;

/// The known errors of a point: variances of its reading and of its abscissa, and their covariance.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PointErrors {
    /// Variance of the observable, in the square of its unit.
    pub observed: f64,
    /// Variance of the abscissa, in the square of its unit.
    pub abscissa: f64,
    /// Covariance of both.
    pub covariance: f64,
}

impl PointErrors {
    /// The variance `σ_y² − 2 y′ σ_yQ + y′² σ_Q²` of the observable less the model, whose slope is `y′`.
    #[must_use]
    pub fn variance(&self, slope: f64) -> f64 {
        let variance =
            self.observed - 2.0 * slope * self.covariance + slope * slope * self.abscissa;
        // Rounding of the difference of two numbers that move together.
        variance.max(0.0)
    }

    /// Checks that its numbers are those of a point of this index.
    pub(crate) fn check(&self, point: usize) -> Result<(), IdentifyError> {
        let numbers = [self.observed, self.abscissa, self.covariance];
        let wrong = numbers.into_iter().find(|number| !number.is_finite());
        let negative = numbers[..2].iter().copied().find(|number| *number < 0.0);
        wrong.or(negative).map_or(Ok(()), |found| {
            Err(IdentifyError::Point {
                list: "known errors",
                point,
                found,
                wanted: "a finite variance, not negative",
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_that_move_a_reading_along_the_model_do_not_count() {
        // δy = 3 δQ on a model of slope 3, and on one of slope 1.
        let along = PointErrors {
            observed: 9.0,
            abscissa: 1.0,
            covariance: 3.0,
        };
        assert_eq!(along.variance(3.0), 0.0);
        assert_eq!(along.variance(1.0), 4.0);
        assert!(along.check(0).is_ok());
        let negative = PointErrors {
            abscissa: -1.0,
            ..along
        };
        assert!(negative.check(0).is_err());
    }
}
