//! The prior of a parameter.

use crate::IdentifyError;

/// Prior knowledge of a parameter, treated as one more observation of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Prior {
    /// `ln θ` is normal about `ln(median)` with standard deviation `ln(factor)`.
    Lognormal {
        /// Median of θ, positive.
        median: f64,
        /// Factor that corresponds to one standard deviation, above 1.
        factor: f64,
    },
    /// θ is normal.
    Normal {
        /// Mean of θ.
        mean: f64,
        /// Standard deviation of θ, positive.
        sd: f64,
    },
}

impl Prior {
    /// Checks the numbers of the prior of the parameter `name`.
    pub(crate) fn check(&self, name: &str) -> Result<(), IdentifyError> {
        let wrong = |quantity, found, wanted| {
            Err(IdentifyError::NumberOf {
                name: name.to_owned(),
                quantity,
                found,
                wanted,
            })
        };
        match *self {
            Self::Lognormal { median, .. } if !(median > 0.0 && median.is_finite()) => {
                wrong("median", median, "a positive finite number")
            }
            Self::Lognormal { factor, .. } if !(factor > 1.0 && factor.is_finite()) => {
                wrong("factor", factor, "a finite number above 1")
            }
            Self::Normal { mean, .. } if !mean.is_finite() => {
                wrong("mean", mean, "a finite number")
            }
            Self::Normal { sd, .. } if !(sd > 0.0 && sd.is_finite()) => {
                wrong("standard deviation", sd, "a positive finite number")
            }
            _ => Ok(()),
        }
    }

    /// How far the parameter lies above the prior's centre, in standard deviations:
    /// `(ln θ − ln median)/ln factor` or `(θ − mean)/sd`.
    pub(crate) fn deviation(&self, value: f64) -> f64 {
        match *self {
            Self::Lognormal { median, factor } => (value / median).ln() / factor.ln(),
            Self::Normal { mean, sd } => (value - mean) / sd,
        }
    }

    /// The derivative of [`Self::deviation`] with respect to θ.
    pub(crate) fn deviation_slope(&self, value: f64) -> f64 {
        match *self {
            Self::Lognormal { factor, .. } => 1.0 / (value * factor.ln()),
            Self::Normal { sd, .. } => 1.0 / sd,
        }
    }

    /// The median.
    pub(crate) fn centre(&self) -> f64 {
        match *self {
            Self::Lognormal { median, .. } => median,
            Self::Normal { mean, .. } => mean,
        }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn the_slope_of_a_deviation_is_its_difference_quotient() {
        for prior in [
            Prior::Lognormal {
                median: 2.0,
                factor: 1.3,
            },
            Prior::Normal { mean: 2.0, sd: 0.4 },
        ] {
            let (value, step) = (1.7, 1e-6);
            let quotient =
                (prior.deviation(value + step) - prior.deviation(value - step)) / (2.0 * step);
            // The central difference has errors of step² and of rounding over step, both about 1e-10.
            assert_relative_eq!(prior.deviation_slope(value), quotient, max_relative = 1e-8);
            assert_eq!(prior.deviation(prior.centre()), 0.0);
        }
    }

    #[test]
    fn a_prior_of_zero_width_is_refused() {
        assert!(Prior::Normal { mean: 1.0, sd: 0.0 }.check("x").is_err());
        assert!(
            Prior::Lognormal {
                median: 1.0,
                factor: 1.0
            }
            .check("x")
            .is_err()
        );
        assert!(
            Prior::Lognormal {
                median: 1.0,
                factor: 1.1
            }
            .check("x")
            .is_ok()
        );
    }
}
