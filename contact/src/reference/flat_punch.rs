//! The flat end of a circular cylinder on an elastic half-space.

use std::f64::consts::PI;

/// The contact of a flat punch with an elastic half-space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatPunchContact {
    /// Force Q, N.
    pub force: f64,
    /// Penetration D, m.
    pub penetration: f64,
    /// Radius a of the punch and of the contact, m.
    pub contact_radius: f64,
    /// Pressure on the axis, the smallest, Pa; it is infinite on the rim.
    pub central_pressure: f64,
}

/// The contact at a penetration D (m), for the punch's radius a (m) and the plane-strain modulus E* (Pa).
#[must_use]
pub fn from_penetration(
    radius: f64,
    plane_strain_modulus: f64,
    penetration: f64,
) -> FlatPunchContact {
    FlatPunchContact {
        // Q = 2 E* a D
        force: 2.0 * plane_strain_modulus * radius * penetration,
        penetration,
        contact_radius: radius,
        // p(0) = E* D/πa
        central_pressure: plane_strain_modulus * penetration / (PI * radius),
    }
}

/// The contact under a force Q (N), for the punch's radius a (m) and the plane-strain modulus E* (Pa).
#[must_use]
pub fn from_force(radius: f64, plane_strain_modulus: f64, force: f64) -> FlatPunchContact {
    let penetration = force / (2.0 * plane_strain_modulus * radius);
    FlatPunchContact {
        force,
        ..from_penetration(radius, plane_strain_modulus, penetration)
    }
}

impl FlatPunchContact {
    /// Pressure at the distance ρ (m) from the axis, Pa: `p = p(0)/√(1 − ρ²/a²)`, 0 outside the contact, `+∞` on its
    /// rim.
    #[must_use]
    pub fn pressure(&self, distance: f64) -> f64 {
        let share = distance / self.contact_radius;
        if share <= 1.0 {
            self.central_pressure / ((1.0 - share) * (1.0 + share)).sqrt()
        } else {
            0.0
        }
    }

    /// Mean pressure over the contact, Pa: twice that on the axis.
    #[must_use]
    pub fn mean_pressure(&self) -> f64 {
        2.0 * self.central_pressure
    }

    /// Energy stored in the half-space, J: `U = QD/2`.
    #[must_use]
    pub fn strain_energy(&self) -> f64 {
        0.5 * self.force * self.penetration
    }
}

#[cfg(test)]
mod tests {
    use super::from_force;

    #[test]
    fn a_contact_under_a_force_has_exactly_that_force() {
        for k in 1..100 {
            let force = f64::from(k) / 7.0;
            let found = from_force(0.3, 7.1, force);
            assert_eq!(found.force, force);
            assert!((found.penetration / (force / (2.0 * 7.1 * 0.3)) - 1.0).abs() < 1e-15);
        }
    }
}
