//! How a fit is done.

use crate::IdentifyError;

/// How the interval of an unknown is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Intervals {
    /// From the profile of the likelihood, at one to three predictions a point.
    Profile,
    /// From the covariance alone, at none. It promises too much where the data are weak.
    Wald,
}

/// How a fit is done.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitOptions {
    /// Level of the intervals, 0.95 by default.
    pub level: f64,
    /// How they are found, from the profile by default.
    pub intervals: Intervals,
    /// Most starts of the search, 4 by default. It ends when a second one leads to the same place.
    pub starts: usize,
    /// `χ²` that a linear problem could still gain where the search ends, 10⁻⁴ by default: a hundredth of a standard
    /// error. One more step takes most of that.
    pub tolerance: f64,
}

impl Default for FitOptions {
    fn default() -> Self {
        Self {
            level: 0.95,
            intervals: Intervals::Profile,
            starts: 4,
            tolerance: 1e-4,
        }
    }
}

impl FitOptions {
    pub(crate) fn check(&self) -> Result<(), IdentifyError> {
        let number = |quantity, found, allowed: bool, wanted| {
            if allowed {
                return Ok(());
            }
            Err(IdentifyError::Number {
                quantity,
                found,
                wanted,
            })
        };
        let level = self.level > 0.0 && self.level < 1.0;
        number("level", self.level, level, "a number between 0 and 1")?;
        let tolerance = self.tolerance > 0.0 && self.tolerance <= 0.1;
        number(
            "tolerance of the search",
            self.tolerance,
            tolerance,
            "a number in (0, 0.1]",
        )?;
        number(
            "number of starts",
            self.starts as f64,
            self.starts > 0,
            "at least one",
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_of_one_is_refused() {
        assert!(FitOptions::default().check().is_ok());
        assert!(
            FitOptions {
                level: 1.0,
                ..FitOptions::default()
            }
            .check()
            .is_err()
        );
        assert!(
            FitOptions {
                starts: 0,
                ..FitOptions::default()
            }
            .check()
            .is_err()
        );
    }
}
