//! The cone, its tip sharp or rounded.

use super::Profile;
use super::error::{IndenterError, IndenterQuantity, acute, not_negative};
use super::sphere::cap_height;

/// A cone whose tip is sharp or a sphere tangent to its side.
///
/// Let α be the half-angle between axis and side, `m = cot α` the slope and R the tip radius. The tip is the sphere of
/// radius R that touches the side from inside. Both have the slope m at `ρ = R cos α`, so height and slope are
/// continuous there:
///
/// ```text
/// f = R − √(R² − ρ²)               ρ < R cos α
/// f = m ρ − R (1/sin α − 1)        beyond
/// ```
///
/// The second line is the sharp cone of the same half-angle with its apex at the depth `R (1/sin α − 1)` below the tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    half_angle: f64,
    tip_radius: f64,
}

impl Cone {
    /// A cone with the angle α (rad) between its axis and its side and the given tip radius (m), 0 for a sharp tip.
    ///
    /// # Errors
    ///
    /// [`IndenterError::Angle`] if the half-angle does not lie in (0, π/2), [`IndenterError::Negative`] if the tip
    /// radius is negative or not finite.
    pub fn new(half_angle: f64, tip_radius: f64) -> Result<Self, IndenterError> {
        let half_angle = acute(IndenterQuantity::HalfAngle, half_angle)?;
        let tip_radius = not_negative(IndenterQuantity::TipRadius, tip_radius)?;
        Ok(Self {
            half_angle,
            tip_radius,
        })
    }

    /// Angle α between the axis and the side, rad.
    #[must_use]
    pub fn half_angle(&self) -> f64 {
        self.half_angle
    }

    /// Radius R of the tip, m; 0 for a sharp one.
    #[must_use]
    pub fn tip_radius(&self) -> f64 {
        self.tip_radius
    }
}

impl Profile for Cone {
    fn height(&self, x: f64, y: f64) -> f64 {
        let Self {
            half_angle: alpha,
            tip_radius,
        } = *self;
        let distance = x.hypot(y);
        if distance < tip_radius * alpha.cos() {
            return cap_height(tip_radius, distance);
        }
        // f = m ρ − R (√(1 + m²) − 1),  m = cot α
        let slope = alpha.tan().recip();
        slope * distance - tip_radius * root_minus_one(slope)
    }

    fn mean_profile(&self, radius: f64) -> f64 {
        self.height(radius, 0.0)
    }

    fn distance_to_edge(&self, x: f64, y: f64, scale: f64) -> f64 {
        if self.tip_radius * self.half_angle.cos() < 2.0 * scale {
            x.hypot(y)
        } else {
            f64::INFINITY
        }
    }
}

/// `√(1 + m²) − 1`, the conjugate of a unit sphere's cap at the slope m, without cancellation.
pub(super) fn root_minus_one(slope: f64) -> f64 {
    slope * slope / (1.0 + 1.0_f64.hypot(slope))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cone_returns_its_parameters() {
        let cone = Cone::new(0.8, 0.25).unwrap();
        assert_eq!([cone.half_angle(), cone.tip_radius()], [0.8, 0.25]);
    }

    #[test]
    fn a_sharp_cone_rises_by_the_cotangent() {
        let cone = Cone::new(60.0_f64.to_radians(), 0.0).unwrap();
        assert_eq!(cone.height(0.0, 0.0), 0.0);
        // cot 60° = 1/√3; the angle and a height of 3 take a few roundings.
        assert!((cone.height(3.0, 4.0) - 5.0 / 3.0_f64.sqrt()).abs() < 16.0 * f64::EPSILON);
    }

    #[test]
    fn height_and_slope_are_continuous_where_the_tip_meets_the_side() {
        for half_angle in [0.2, 0.8, 1.2, 1.5] {
            let cone = Cone::new(half_angle, 2.0).unwrap();
            let seam = 2.0 * half_angle.cos();
            // κ of the profile at the seam: f'' = (1 + m²)^(3/2)/R = 1/(R sin³ α).
            let curvature = 0.5 / half_angle.sin().powi(3);
            for step in [1e-2, 1e-3, 1e-4].map(|fraction| fraction * seam) {
                let [before, at, after] = [-step, 0.0, step].map(|d| cone.height(seam + d, 0.0));
                let jump = (after - at) / step - (at - before) / step;
                // A kink would leave the jump at a fixed value; here it is half the cap's curvature times the step.
                assert!(
                    (jump / (0.5 * curvature * step) - 1.0).abs() < 0.2,
                    "{half_angle}: {jump:e}"
                );
            }
        }
    }

    #[test]
    fn far_from_its_tip_a_blunt_cone_is_the_sharp_one_shifted() {
        let (blunt, sharp) = (Cone::new(1.1, 0.5).unwrap(), Cone::new(1.1, 0.0).unwrap());
        let shift = 0.5 * (1.1_f64.sin().recip() - 1.0);
        // Heights of about 5: a few roundings.
        assert!((sharp.height(10.0, 0.0) - blunt.height(10.0, 0.0) - shift).abs() < 1e-14);
        let nearly_sharp = Cone::new(1.1, 1e-9).unwrap();
        // The same shift, scaled by 1e-9, is below 0.13e-9.
        assert!((sharp.height(1.0, 0.0) - nearly_sharp.height(1.0, 0.0)).abs() < 0.2e-9);
    }

    #[test]
    fn angles_outside_the_first_quadrant_are_refused() {
        for found in [0.0, -0.3, std::f64::consts::FRAC_PI_2, 65.03] {
            let quantity = IndenterQuantity::HalfAngle;
            assert_eq!(
                Cone::new(found, 0.0),
                Err(IndenterError::Angle { quantity, found })
            );
        }
        let quantity = IndenterQuantity::TipRadius;
        assert_eq!(
            Cone::new(1.0, -1.0),
            Err(IndenterError::Negative {
                quantity,
                found: -1.0
            })
        );
    }

    #[test]
    fn an_invalid_angle_is_shown_in_radians_and_degrees() {
        let message = Cone::new(2.0, 0.0).unwrap_err().to_string();
        assert_eq!(
            message,
            "found 2 rad (114.5916°) for the half-angle of the cone, wanted an angle between 0 and π/2 (90°)"
        );
    }
}
