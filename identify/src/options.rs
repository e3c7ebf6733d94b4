//! Options of a fit.

use crate::IdentifyError;

/// How the interval of an unknown is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Intervals {
    /// From the profile of the likelihood, at one to three predictions per point.
    Profile,
    /// From the covariance alone, without predictions. It is too narrow where the data are weak.
    Wald,
}

/// Options of a fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitOptions {
    /// Level of the intervals, 0.95 by default.
    pub level: f64,
    /// Method of the intervals, the profile by default.
    pub intervals: Intervals,
    /// Maximum number of starts of the search, 4 by default. It ends when two lead to the same place.
    pub starts: usize,
    /// Gain in `χ²` that the linear problem may still predict when the search ends, 10⁻⁴ by default: a hundredth of a
    /// standard error. One more step realises most of it.
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
