//! The paraboloid with two radii of curvature, the indenter of Hertz's ellipses.

use super::Profile;
use super::error::{IndenterError, IndenterQuantity, positive};

/// A paraboloid with a radius of curvature along x and another along y, `f = x²/(2Rx) + y²/(2Ry)`.
///
/// Two curved bodies touch like this one and a plane, with the relative curvature `1/R = 1/R1 + 1/R2` in each
/// direction, negative where a body is hollow: crossed cylinders, a ball in a groove, a crowned roller.
///
/// ```
/// use pellicle_contact::{EllipticParaboloid, Profile};
///
/// let roller = EllipticParaboloid::new([1.0, 4.0])?;
/// assert_eq!(roller.height(2.0, 4.0), 4.0); // 2²/2 + 4²/8
/// # Ok::<(), pellicle_contact::IndenterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipticParaboloid {
    radii: [f64; 2],
}

impl EllipticParaboloid {
    /// A paraboloid with the radii of curvature Rx and Ry (m) at its lowest point.
    ///
    /// # Errors
    ///
    /// [`IndenterError::NotPositive`] if a radius is not positive and finite.
    pub fn new([x, y]: [f64; 2]) -> Result<Self, IndenterError> {
        let radii = [
            positive(IndenterQuantity::RadiusAlongX, x)?,
            positive(IndenterQuantity::RadiusAlongY, y)?,
        ];
        Ok(Self { radii })
    }

    /// Radii of curvature Rx and Ry at the lowest point, m.
    #[must_use]
    pub fn radii(&self) -> [f64; 2] {
        self.radii
    }

    /// The radius of the paraboloid of revolution that this is, m; none if the two radii differ.
    #[must_use]
    pub fn common_radius(&self) -> Option<f64> {
        let [x, y] = self.radii;
        x.total_cmp(&y).is_eq().then_some(x)
    }

    /// `1/R = (1/Rx + 1/Ry)/2`, 1/m.
    fn mean_curvature(&self) -> f64 {
        let [x, y] = self.radii;
        0.5 * (1.0 / x + 1.0 / y)
    }
}

impl Profile for EllipticParaboloid {
    fn height(&self, x: f64, y: f64) -> f64 {
        // f = x²/(2Rx) + y²/(2Ry)
        let [of_x, of_y] = self.radii;
        x * x / (2.0 * of_x) + y * y / (2.0 * of_y)
    }

    fn mean_profile(&self, radius: f64) -> f64 {
        // The means of cos² and sin² are ½.
        0.5 * radius * radius * self.mean_curvature()
    }

    fn mean_slope(&self, radius: f64) -> f64 {
        radius * self.mean_curvature()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_radius_is_that_of_its_direction() {
        let shape = EllipticParaboloid::new([2.0, 8.0]).unwrap();
        assert_eq!([shape.height(2.0, 0.0), shape.height(0.0, 4.0)], [1.0; 2]);
        assert_eq!(shape.common_radius(), None);
        let round = EllipticParaboloid::new([2.0, 2.0]).unwrap();
        assert_eq!(round.common_radius(), Some(2.0));
    }

    #[test]
    fn both_radii_are_positive() {
        for found in [0.0, -1.0, f64::INFINITY] {
            let refused = |quantity| Err(IndenterError::NotPositive { quantity, found });
            let [x, y] = [[found, 1.0], [1.0, found]].map(EllipticParaboloid::new);
            assert_eq!(x, refused(IndenterQuantity::RadiusAlongX));
            assert_eq!(y, refused(IndenterQuantity::RadiusAlongY));
        }
        assert!(EllipticParaboloid::new([1.0, f64::NAN]).is_err());
    }
}
