//! The paraboloid of revolution, Hertz's indenter.

use super::Profile;
use super::error::{IndenterError, IndenterQuantity, positive};

/// A paraboloid of revolution, `f = ρ²/(2R)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paraboloid {
    radius: f64,
}

impl Paraboloid {
    /// A paraboloid with the radius of curvature R (m) at its lowest point.
    ///
    /// # Errors
    ///
    /// [`IndenterError::NotPositive`] if the radius is not positive and finite.
    pub fn new(radius: f64) -> Result<Self, IndenterError> {
        let radius = positive(IndenterQuantity::Radius, radius)?;
        Ok(Self { radius })
    }

    /// Radius of curvature R at the lowest point, m.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }
}

impl Profile for Paraboloid {
    fn height(&self, x: f64, y: f64) -> f64 {
        // f = ρ²/(2R)
        (x * x + y * y) / (2.0 * self.radius)
    }

    fn mean_profile(&self, radius: f64) -> f64 {
        self.height(radius, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_paraboloid_rises_with_the_square_of_the_distance() {
        assert_eq!(Paraboloid::new(2.0).unwrap().height(3.0, 4.0), 6.25);
    }

    #[test]
    fn a_paraboloid_needs_a_radius() {
        for found in [0.0, -1.0, f64::INFINITY] {
            let quantity = IndenterQuantity::Radius;
            assert_eq!(
                Paraboloid::new(found),
                Err(IndenterError::NotPositive { quantity, found })
            );
        }
        assert!(Paraboloid::new(f64::NAN).is_err());
    }
}
