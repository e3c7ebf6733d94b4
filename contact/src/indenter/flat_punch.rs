//! The flat end of a circular cylinder.

use super::Profile;
use super::error::{IndenterError, IndenterQuantity, positive};

/// The flat end of a circular cylinder: `f = 0` for `ρ ≤ a`, `+∞` beyond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatPunch {
    radius: f64,
}

/// Relative slack on the radius: a point on the rim to rounding belongs to the punch.
const RIM_SLACK: f64 = 1e-12;

impl FlatPunch {
    /// A punch of radius a (m).
    ///
    /// # Errors
    ///
    /// [`IndenterError::NotPositive`] if the radius is not positive and finite.
    pub fn new(radius: f64) -> Result<Self, IndenterError> {
        let radius = positive(IndenterQuantity::Radius, radius)?;
        Ok(Self { radius })
    }

    /// Radius a, m.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }
}

impl Profile for FlatPunch {
    fn height(&self, x: f64, y: f64) -> f64 {
        if x.hypot(y) <= self.radius * (1.0 + RIM_SLACK) {
            0.0
        } else {
            f64::INFINITY
        }
    }

    fn mean_profile(&self, radius: f64) -> f64 {
        self.height(radius, 0.0)
    }

    fn distance_to_rim(&self, x: f64, y: f64) -> f64 {
        self.radius - x.hypot(y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_punch_is_flat_up_to_its_rim() {
        let punch = FlatPunch::new(5.0).unwrap();
        assert_eq!(
            [punch.height(3.0, -4.0), punch.height(3.1, 4.0)],
            [0.0, f64::INFINITY]
        );
    }
}
