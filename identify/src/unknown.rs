//! A parameter to be found, and the coordinate in which it is sought.

use crate::{IdentifyError, Prior};

/// The coordinate in which a parameter is sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coordinate {
    /// `x = ln θ`, for positive parameters: moduli, thicknesses, radii, compliances.
    Logarithmic,
    /// `x = 4θ/(high − low)`, for parameters of either sign.
    Linear,
}

/// The role of a parameter in a fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// It is one of the answers.
    Sought,
    /// It is not known exactly; the intervals of the others allow for that.
    Nuisance,
}

/// A parameter to be found, in its own unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Unknown {
    name: String,
    start: f64,
    range: [f64; 2],
    prior: Option<Prior>,
    coordinate: Coordinate,
    role: Role,
}

/// Length of a range in a linear coordinate, which makes the longest step, 0.7, a sixth of the range.
const LINEAR_RANGE: f64 = 4.0;

impl Unknown {
    /// A positive parameter between two bounds, sought in its logarithm, starting from the middle.
    ///
    /// # Errors
    ///
    /// [`IdentifyError::NumberOf`] where the bounds are not positive, finite and in order.
    pub fn positive(name: impl Into<String>, range: [f64; 2]) -> Result<Self, IdentifyError> {
        let name = name.into();
        check_bound(
            &name,
            "lower bound",
            range[0],
            range[0] > 0.0,
            "a positive finite number",
        )?;
        Self::between(name, range, Coordinate::Logarithmic)
    }

    /// A parameter of either sign between two bounds, sought from the middle.
    ///
    /// # Errors
    ///
    /// [`IdentifyError::NumberOf`] where the bounds are not finite and in order.
    pub fn signed(name: impl Into<String>, range: [f64; 2]) -> Result<Self, IdentifyError> {
        Self::between(name.into(), range, Coordinate::Linear)
    }

    fn between(
        name: String,
        range: [f64; 2],
        coordinate: Coordinate,
    ) -> Result<Self, IdentifyError> {
        let [low, high] = range;
        check_bound(&name, "lower bound", low, true, "a finite number")?;
        check_bound(
            &name,
            "upper bound",
            high,
            high > low,
            "a finite number above the lower bound",
        )?;
        let start = match coordinate {
            Coordinate::Logarithmic => (low * high).sqrt(),
            Coordinate::Linear => f64::midpoint(low, high),
        };
        Ok(Self {
            name,
            start,
            range,
            prior: None,
            coordinate,
            role: Role::Sought,
        })
    }

    /// The same unknown, with its search starting at `start`.
    ///
    /// # Errors
    ///
    /// [`IdentifyError::NumberOf`] where the start lies outside the range.
    pub fn starting_at(mut self, start: f64) -> Result<Self, IdentifyError> {
        let [low, high] = self.range;
        let inside = (low..=high).contains(&start);
        check_bound(&self.name, "start", start, inside, "a number in the range")?;
        self.start = start;
        Ok(self)
    }

    /// The same unknown with a prior.
    ///
    /// # Errors
    ///
    /// [`IdentifyError::NumberOf`] if the prior has no width or its centre lies outside the range.
    pub fn with_prior(mut self, prior: Prior) -> Result<Self, IdentifyError> {
        prior.check(&self.name)?;
        let inside = (self.range[0]..=self.range[1]).contains(&prior.centre());
        check_bound(
            &self.name,
            "prior's centre",
            prior.centre(),
            inside,
            "a number in the range",
        )?;
        self.prior = Some(prior);
        Ok(self)
    }

    /// The same unknown as a nuisance.
    #[must_use]
    pub fn as_nuisance(mut self) -> Self {
        self.role = Role::Nuisance;
        self
    }

    /// The same unknown without its prior.
    pub(crate) fn without_prior(&self) -> Self {
        Self {
            prior: None,
            ..self.clone()
        }
    }

    /// Its name, such as the key of a case file.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Starting value of the search.
    #[must_use]
    pub fn start(&self) -> f64 {
        self.start
    }

    /// Lower and upper bound.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        self.range
    }

    /// Its prior, if any.
    #[must_use]
    pub fn prior(&self) -> Option<Prior> {
        self.prior
    }

    /// The coordinate in which it is sought.
    #[must_use]
    pub fn coordinate(&self) -> Coordinate {
        self.coordinate
    }

    /// Whether it is an answer or a nuisance.
    #[must_use]
    pub fn role(&self) -> Role {
        self.role
    }

    /// `x` of a value θ.
    pub(crate) fn position(&self, value: f64) -> f64 {
        match self.coordinate {
            Coordinate::Logarithmic => value.ln(),
            Coordinate::Linear => value / self.unit(),
        }
    }

    /// θ at `x`, clamped to the range.
    pub(crate) fn value(&self, position: f64) -> f64 {
        let value = match self.coordinate {
            Coordinate::Logarithmic => position.exp(),
            Coordinate::Linear => position * self.unit(),
        };
        value.clamp(self.range[0], self.range[1])
    }

    /// θ at `x`, not clamped to the range.
    pub(crate) fn value_beyond(&self, position: f64) -> f64 {
        match self.coordinate {
            Coordinate::Logarithmic => position.exp(),
            Coordinate::Linear => position * self.unit(),
        }
    }

    /// `dθ/dx` at a value θ.
    pub(crate) fn value_slope(&self, value: f64) -> f64 {
        match self.coordinate {
            Coordinate::Logarithmic => value,
            Coordinate::Linear => self.unit(),
        }
    }

    /// The range in the coordinate `x`.
    pub(crate) fn bounds(&self) -> [f64; 2] {
        self.range.map(|bound| self.position(bound))
    }

    fn unit(&self) -> f64 {
        (self.range[1] - self.range[0]) / LINEAR_RANGE
    }
}

fn check_bound(
    name: &str,
    quantity: &'static str,
    found: f64,
    allowed: bool,
    wanted: &'static str,
) -> Result<(), IdentifyError> {
    if allowed && found.is_finite() {
        return Ok(());
    }
    Err(IdentifyError::NumberOf {
        name: name.to_owned(),
        quantity,
        found,
        wanted,
    })
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn coordinates_convert_back_to_the_value() {
        for unknown in [
            Unknown::positive("modulus", [2e9, 5e11]).unwrap(),
            Unknown::signed("offset", [-3.0, 5.0e11]).unwrap(),
        ] {
            let value = 7.5e10;
            // Rounding of exp(ln θ), whose argument is about 25.
            assert_relative_eq!(
                unknown.value(unknown.position(value)),
                value,
                max_relative = 1e-14
            );
            let step = 1e-4;
            let quotient = (unknown.value(unknown.position(value) + step)
                - unknown.value(unknown.position(value) - step))
                / (2.0 * step);
            // The relative error of a central difference is step²/6.
            assert_relative_eq!(unknown.value_slope(value), quotient, max_relative = 1e-8);
        }
    }

    #[test]
    fn wrong_ranges_and_starts_are_refused() {
        assert!(Unknown::positive("x", [0.0, 1.0]).is_err());
        assert!(Unknown::positive("x", [2.0, 1.0]).is_err());
        assert!(Unknown::signed("x", [-1.0, f64::INFINITY]).is_err());
        assert!(
            Unknown::positive("x", [1.0, 2.0])
                .unwrap()
                .starting_at(3.0)
                .is_err()
        );
        let prior = Prior::Normal { mean: 5.0, sd: 1.0 };
        assert!(
            Unknown::positive("x", [1.0, 2.0])
                .unwrap()
                .with_prior(prior)
                .is_err()
        );
    }
}
