//! Sneddon: a sharp cone on an elastic half-space.

use std::f64::consts::PI;

/// The contact of a cone `f = ρ cot α` with an elastic half-space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConeContact {
    /// Force Q, N.
    pub force: f64,
    /// Penetration D, m.
    pub penetration: f64,
    /// Contact radius a, m.
    pub contact_radius: f64,
    /// Mean pressure over the contact, Pa, the same at any load; the pressure itself is infinite on the axis.
    pub mean_pressure: f64,
}

/// The contact at a penetration D (m), for the angle α (rad) between axis and side and the plane-strain modulus E*
/// (Pa).
#[must_use]
pub fn from_penetration(
    half_angle: f64,
    plane_strain_modulus: f64,
    penetration: f64,
) -> ConeContact {
    let tangent = half_angle.tan();
    ConeContact {
        // Q = 2 E* tan α D²/π
        force: 2.0 * plane_strain_modulus * tangent * penetration.powi(2) / PI,
        penetration,
        // a = 2 D tan α/π
        contact_radius: 2.0 * penetration * tangent / PI,
        // Q/πa² = E* cot α/2
        mean_pressure: 0.5 * plane_strain_modulus / tangent,
    }
}

/// The contact under a force Q (N), for the angle α (rad) between axis and side and the plane-strain modulus E* (Pa).
#[must_use]
pub fn from_force(half_angle: f64, plane_strain_modulus: f64, force: f64) -> ConeContact {
    // D = √(πQ/(2 E* tan α))
    let penetration = (PI * force / (2.0 * plane_strain_modulus * half_angle.tan())).sqrt();
    ConeContact {
        force,
        ..from_penetration(half_angle, plane_strain_modulus, penetration)
    }
}

impl ConeContact {
    /// Pressure at the distance ρ (m) from the axis, Pa: `p = (Q/πa²) arcosh(a/ρ)`, 0 outside the contact, `+∞` on the
    /// axis.
    #[must_use]
    pub fn pressure(&self, distance: f64) -> f64 {
        if distance < self.contact_radius {
            self.mean_pressure * (self.contact_radius / distance).acosh()
        } else {
            0.0
        }
    }

    /// Energy stored in the half-space, J: `U = QD/3`.
    #[must_use]
    pub fn strain_energy(&self) -> f64 {
        self.force * self.penetration / 3.0
    }
}
