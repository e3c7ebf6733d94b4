//! Hertz: a paraboloid on an elastic half-space.

use std::f64::consts::PI;

/// The contact of a paraboloid `f = ρ²/2R` with an elastic half-space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzContact {
    /// Force Q, N.
    pub force: f64,
    /// Penetration D, m.
    pub penetration: f64,
    /// Contact radius a, m.
    pub contact_radius: f64,
    /// Pressure on the axis, the largest, Pa.
    pub peak_pressure: f64,
}

/// The contact at a contact radius a (m), for the indenter's radius R (m) and the plane-strain modulus E* (Pa).
#[must_use]
pub fn from_contact_radius(
    radius: f64,
    plane_strain_modulus: f64,
    contact_radius: f64,
) -> HertzContact {
    let (modulus, a) = (plane_strain_modulus, contact_radius);
    HertzContact {
        // Q = 4 E* a³/3R
        force: 4.0 * modulus * a.powi(3) / (3.0 * radius),
        // D = a²/R
        penetration: a * a / radius,
        contact_radius,
        // p₀ = 2 E* a/πR
        peak_pressure: 2.0 * modulus * a / (PI * radius),
    }
}

/// The contact under a force Q (N), for the indenter's radius R (m) and the plane-strain modulus E* (Pa).
#[must_use]
pub fn from_force(radius: f64, plane_strain_modulus: f64, force: f64) -> HertzContact {
    // a = (3QR/4E*)^⅓
    let contact_radius = (0.75 * force * radius / plane_strain_modulus).cbrt();
    HertzContact {
        force,
        ..from_contact_radius(radius, plane_strain_modulus, contact_radius)
    }
}

/// The contact at a penetration D (m), for the indenter's radius R (m) and the plane-strain modulus E* (Pa).
#[must_use]
pub fn from_penetration(radius: f64, plane_strain_modulus: f64, penetration: f64) -> HertzContact {
    // a = √(RD)
    let contact_radius = (radius * penetration).sqrt();
    HertzContact {
        penetration,
        ..from_contact_radius(radius, plane_strain_modulus, contact_radius)
    }
}

impl HertzContact {
    /// Pressure at the distance ρ (m) from the axis, Pa: `p = p₀ √(1 − ρ²/a²)`, 0 outside the contact.
    #[must_use]
    pub fn pressure(&self, distance: f64) -> f64 {
        let share = distance / self.contact_radius;
        if share < 1.0 {
            self.peak_pressure * ((1.0 - share) * (1.0 + share)).sqrt()
        } else {
            0.0
        }
    }

    /// Mean pressure over the contact, Pa: two thirds of the peak.
    #[must_use]
    pub fn mean_pressure(&self) -> f64 {
        self.peak_pressure / 1.5
    }

    /// Energy stored in the half-space, J: `U = 2QD/5`.
    #[must_use]
    pub fn strain_energy(&self) -> f64 {
        0.4 * self.force * self.penetration
    }
}
