//! The sphere, and the spherical cap that forms the tip of other indenters.

use super::Profile;
use super::error::{IndenterError, IndenterQuantity, positive};

/// The lower half of a sphere, `f = R − √(R² − ρ²)` for `ρ ≤ R`, `+∞` beyond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    radius: f64,
}

impl Sphere {
    /// A sphere of radius R (m).
    ///
    /// # Errors
    ///
    /// [`IndenterError::NotPositive`] if the radius is not positive and finite.
    pub fn new(radius: f64) -> Result<Self, IndenterError> {
        let radius = positive(IndenterQuantity::Radius, radius)?;
        Ok(Self { radius })
    }

    /// Radius R, m.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }
}

impl Profile for Sphere {
    fn height(&self, x: f64, y: f64) -> f64 {
        let distance = x.hypot(y);
        if distance <= self.radius {
            cap_height(self.radius, distance)
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

/// Half the chord of a sphere at a distance from its axis, `√(R² − ρ²)`, for `ρ ≤ R`.
pub(super) fn half_chord(radius: f64, distance: f64) -> f64 {
    ((radius - distance) * (radius + distance)).sqrt()
}

/// Height of a spherical cap of positive radius above its lowest point, without cancellation; `ρ ≤ R`.
pub(super) fn cap_height(radius: f64, distance: f64) -> f64 {
    // R − √(R² − ρ²) = ρ²/(R + √(R² − ρ²))
    distance * (distance / (radius + half_chord(radius, distance)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sphere_passes_through_a_pythagorean_point_and_ends_at_its_equator() {
        let sphere = Sphere::new(5.0).unwrap();
        assert_eq!(
            [
                sphere.height(3.0, 0.0),
                sphere.height(0.0, -4.0),
                sphere.height(5.0, 0.0)
            ],
            [1.0, 2.0, 5.0]
        );
        assert_eq!(sphere.height(4.0, 3.1), f64::INFINITY);
    }

    #[test]
    fn near_its_lowest_point_a_sphere_is_a_paraboloid_to_rounding() {
        let sphere = Sphere::new(1.0).unwrap();
        for distance in [1e-4, 1e-8, 1e-12] {
            // f = ρ²/2 (1 + ρ²/4 + ρ⁴/8 + …)
            let series = 0.5 * distance * distance * (1.0 + 0.25 * distance * distance);
            let error = (sphere.height(0.0, distance) / series - 1.0).abs();
            assert!(
                error < 4.0 * f64::EPSILON,
                "a handful of roundings at {distance}: {error:e}"
            );
        }
    }

    #[test]
    fn the_rim_lies_at_the_radius() {
        let sphere = Sphere::new(2.0).unwrap();
        // Inside, and beyond.
        assert_eq!(
            [
                sphere.distance_to_rim(0.3, 0.4),
                sphere.distance_to_rim(3.0, 4.0)
            ],
            [1.5, -3.0]
        );
    }
}
