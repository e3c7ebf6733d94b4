//! The noise of the measured points: its size, and which parts of it are to be estimated.

use crate::{IdentifyError, autoregressive::dependence, predictor::Evaluation};

mod point_errors;
pub(crate) mod restricted_likelihood;
pub(crate) mod simplex;
pub(crate) mod whitener;

pub use point_errors::PointErrors;

/// The size of one part of the noise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Amount {
    /// Known from elsewhere.
    Given(f64),
    /// Estimated from the residuals.
    Estimated,
}

/// Correlation between the points of a curve, in their order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Correlation {
    /// None: white noise.
    None,
    /// A first-order autoregression plus white noise, both estimated from the residuals.
    Estimated,
    /// A known correlation: `R_ij = w δ_ij + (1 − w) φ^|i − j|`.
    Given {
        /// `φ`, from 0 to below 1.
        persistence: f64,
        /// `w`, from 0 to 1.
        white_fraction: f64,
    },
}

/// The noise of all curves. Only that of the observable may be correlated. With errors in both axes, the variance of a
/// point is the effective variance `σ_i² = σ_D² + (ρ y_i)² + (∂y/∂Q)_i² σ_Q²` (J. Orear, Am. J. Phys. 50, 912 (1982)).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Standard deviation `σ_D` of the observable, in its unit.
    pub observed: Amount,
    /// Standard deviation `σ_Q` of the abscissa, in its unit.
    pub abscissa: Amount,
    /// Standard deviation `ρ` of the observable as a fraction of its value.
    pub relative: Amount,
    /// Correlation between points.
    pub correlation: Correlation,
}

impl Default for Noise {
    /// White noise of the observable alone, of unknown size.
    fn default() -> Self {
        Self {
            observed: Amount::Estimated,
            abscissa: Amount::Given(0.0),
            relative: Amount::Given(0.0),
            correlation: Correlation::None,
        }
    }
}

/// The noise, with a number for each part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoiseLevels {
    /// Standard deviation `σ_D` of the observable.
    pub observed: f64,
    /// Standard deviation `σ_Q` of the abscissa.
    pub abscissa: f64,
    /// Standard deviation `ρ` of the observable as a fraction of its value.
    pub relative: f64,
    /// Correlation `φ` of the persistent part from one point to the next.
    pub persistence: f64,
    /// White fraction `w` of the variance.
    pub white_fraction: f64,
}

impl NoiseLevels {
    /// Checks the numbers.
    pub(crate) fn check(&self) -> Result<(), IdentifyError> {
        let noise = Noise {
            observed: Amount::Given(self.observed),
            abscissa: Amount::Given(self.abscissa),
            relative: Amount::Given(self.relative),
            correlation: Correlation::Given {
                persistence: self.persistence,
                white_fraction: self.white_fraction,
            },
        };
        noise.check()
    }

    /// How many neighbouring points count as one in a long mean.
    pub(crate) fn dependence(&self) -> f64 {
        dependence(self.persistence, self.white_fraction)
    }

    /// The effective variance `σ_D² + (ρ y)² + (∂y/∂Q)² σ_Q²` of a point with this value and slope.
    #[must_use]
    pub fn variance(&self, value: f64, slope: f64) -> f64 {
        self.observed.powi(2) + (self.relative * value).powi(2) + (slope * self.abscissa).powi(2)
    }

    /// The variance of each of some points, with its known errors; no errors are zeros.
    pub(crate) fn variances(
        &self,
        value: &[f64],
        slope: &[f64],
        errors: &[PointErrors],
    ) -> Vec<f64> {
        let pairs = value.iter().zip(slope).enumerate();
        let variance = |(point, (value, slope)): (usize, (&f64, &f64))| {
            let known = errors.get(point).map_or(0.0, |of| of.variance(*slope));
            self.variance(*value, *slope) + known
        };
        pairs.map(variance).collect()
    }

    /// The standard deviation of each point of an evaluation, with its known errors.
    pub(crate) fn deviations(&self, at: &Evaluation, errors: &[PointErrors]) -> Vec<f64> {
        let variances = self.variances(&at.value, &at.slope, errors).into_iter();
        variances.map(f64::sqrt).collect()
    }
}

/// An amount to be estimated starts at this fraction of the typical observable or abscissa.
const FIRST_GUESS: f64 = 0.01;

impl Noise {
    /// White noise of the observable of a known size.
    #[must_use]
    pub fn white(sigma: f64) -> Self {
        Self {
            observed: Amount::Given(sigma),
            ..Self::default()
        }
    }

    /// Checks the given numbers.
    pub(crate) fn check(&self) -> Result<(), IdentifyError> {
        let mut any = false;
        for (quantity, amount) in [
            ("noise of the observable", self.observed),
            ("noise of the abscissa", self.abscissa),
            ("relative noise", self.relative),
        ] {
            let Amount::Given(found) = amount else {
                any = true;
                continue;
            };
            check_number(
                quantity,
                found,
                found >= 0.0,
                "a finite number, not negative",
            )?;
            any |= found > 0.0;
        }
        check_number(
            "whole noise",
            0.0,
            any,
            "one part that is positive or estimated",
        )?;
        if let Correlation::Given {
            persistence,
            white_fraction,
        } = self.correlation
        {
            let phi = (0.0..1.0).contains(&persistence);
            check_number(
                "persistence of the noise",
                persistence,
                phi,
                "a number in [0, 1)",
            )?;
            let white = (0.0..=1.0).contains(&white_fraction);
            check_number(
                "white part of the noise",
                white_fraction,
                white,
                "a number in [0, 1]",
            )?;
        }
        Ok(())
    }

    /// Whether every size is given, so that χ² has a known scale.
    pub(crate) fn is_given(&self) -> bool {
        [self.observed, self.abscissa, self.relative]
            .iter()
            .all(|amount| matches!(amount, Amount::Given(_)))
    }

    /// Whether no part of it is estimated.
    pub(crate) fn is_known(&self) -> bool {
        self.is_given() && self.correlation != Correlation::Estimated
    }

    /// Whether the ratios of the points' variances are known and independent of the model.
    pub(crate) fn is_uniform(&self) -> bool {
        self.abscissa == Amount::Given(0.0) && self.relative == Amount::Given(0.0)
    }

    /// Initial levels, from the root mean squares of the observable and the abscissa.
    pub(crate) fn first_guess(&self, observable: f64, abscissa: f64) -> NoiseLevels {
        let level = |amount, guess| match amount {
            Amount::Given(value) => value,
            Amount::Estimated => guess,
        };
        let (persistence, white_fraction) = match self.correlation {
            Correlation::Given {
                persistence,
                white_fraction,
            } => (persistence, white_fraction),
            Correlation::None | Correlation::Estimated => (0.0, 1.0),
        };
        NoiseLevels {
            observed: level(self.observed, FIRST_GUESS * observable),
            abscissa: level(self.abscissa, FIRST_GUESS * abscissa),
            relative: level(self.relative, FIRST_GUESS),
            persistence,
            white_fraction,
        }
    }
}

fn check_number(
    quantity: &'static str,
    found: f64,
    allowed: bool,
    wanted: &'static str,
) -> Result<(), IdentifyError> {
    if allowed && found.is_finite() {
        return Ok(());
    }
    Err(IdentifyError::Number {
        quantity,
        found,
        wanted,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_of_zero_size_is_refused() {
        assert!(Noise::white(0.0).check().is_err());
        assert!(Noise::white(-1.0).check().is_err());
        assert!(Noise::white(1.0).check().is_ok());
        assert!(Noise::default().check().is_ok());
        let unit_root = Correlation::Given {
            persistence: 1.0,
            white_fraction: 0.0,
        };
        assert!(
            Noise {
                correlation: unit_root,
                ..Noise::white(1.0)
            }
            .check()
            .is_err()
        );
    }
}
