//! Quantiles and probabilities of the distributions that intervals and tests need.

use statrs::distribution::{ChiSquared, ContinuousCDF as _, FisherSnedecor, Normal, StudentsT};

/// Degrees of freedom from which Student's distribution is the normal one to five digits.
const MANY: f64 = 1e6;

/// The two-sided quantile of Student's distribution, such as 1.96 for level 0.95 and many degrees of freedom.
pub(crate) fn student_quantile(level: f64, degrees: f64) -> f64 {
    let p = f64::midpoint(1.0, level);
    if degrees >= MANY {
        return Normal::standard().inverse_cdf(p);
    }
    StudentsT::new(0.0, 1.0, degrees).map_or(f64::NAN, |t| t.inverse_cdf(p))
}

/// The probability of χ² above a value.
pub(crate) fn chi_squared_above(value: f64, degrees: f64) -> f64 {
    ChiSquared::new(degrees).map_or(f64::NAN, |chi| chi.sf(value))
}

/// The probability of Fisher's F above a value.
pub(crate) fn fisher_above(value: f64, numerator: f64, denominator: f64) -> f64 {
    if denominator >= MANY {
        return chi_squared_above(value * numerator, numerator);
    }
    FisherSnedecor::new(numerator, denominator).map_or(f64::NAN, |f| f.sf(value))
}

/// The probability of a standard normal number below a value.
pub(crate) fn normal_below(value: f64) -> f64 {
    Normal::standard().cdf(value)
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn quantiles_are_those_of_the_tables() {
        // Abramowitz and Stegun, Handbook of Mathematical Functions, table 26.10 and its limit, to their digits.
        assert_relative_eq!(student_quantile(0.95, 1.0), 12.706, max_relative = 1e-4);
        assert_relative_eq!(student_quantile(0.95, 10.0), 2.228, max_relative = 3e-4);
        assert_relative_eq!(student_quantile(0.95, 1e9), 1.959_964, max_relative = 1e-6);
        // Table 26.8: χ² = 3.84146 with one degree of freedom at 5 %.
        assert_relative_eq!(chi_squared_above(3.84146, 1.0), 0.05, max_relative = 1e-5);
    }

    #[test]
    fn fisher_with_one_numerator_is_the_square_of_student() {
        let t = student_quantile(0.95, 7.0);
        // The accuracy of an inverse distribution in statrs.
        assert_relative_eq!(fisher_above(t * t, 1.0, 7.0), 0.05, max_relative = 1e-6);
    }
}
