//! A paraboloid on a Winkler foundation: independent springs of one compliance on a rigid base.

use std::f64::consts::PI;

/// The contact of a paraboloid `f = ρ²/2R` with springs of compliance η, `p = (D − f)/η`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WinklerContact {
    /// Force Q, N.
    pub force: f64,
    /// Penetration D, m.
    pub penetration: f64,
    /// Contact radius a, m.
    pub contact_radius: f64,
    /// Contact area, m².
    pub contact_area: f64,
    /// Pressure on the axis, the largest, Pa.
    pub peak_pressure: f64,
}

/// The contact at a penetration D (m), for the indenter's radius R (m) and the springs' compliance η (m/Pa).
#[must_use]
pub fn from_penetration(radius: f64, compliance: f64, penetration: f64) -> WinklerContact {
    // πa² = 2πRD
    let contact_area = 2.0 * PI * radius * penetration;
    WinklerContact {
        // Q = πRD²/η
        force: PI * radius * penetration * penetration / compliance,
        penetration,
        contact_radius: (2.0 * radius * penetration).sqrt(),
        contact_area,
        peak_pressure: penetration / compliance,
    }
}

/// The contact under a force Q (N), for the indenter's radius R (m) and the springs' compliance η (m/Pa).
#[must_use]
pub fn from_force(radius: f64, compliance: f64, force: f64) -> WinklerContact {
    // D = √(ηQ/πR)
    let penetration = (compliance * force / (PI * radius)).sqrt();
    WinklerContact {
        force,
        ..from_penetration(radius, compliance, penetration)
    }
}

/// Force (N) of the paraboloid `f = ρ²/2R` on springs with the logarithmic law, height h (m) and Young's modulus E
/// (Pa), at a penetration `D ≤ h` (m): the integral of `p = −E ln(1 − (D − f)/h)` over the contact of radius `√(2RD)`,
///
/// ```text
/// Q = 2π R h E (1 − u + u ln u),    u = 1 − D/h
/// ```
#[must_use]
pub fn force_on_stiffening(radius: f64, height: f64, young_modulus: f64, penetration: f64) -> f64 {
    let left = 1.0 - penetration / height;
    let integral = if left > 0.0 {
        (1.0 - left) + left * left.ln()
    } else {
        1.0
    };
    2.0 * PI * radius * height * young_modulus * integral
}

impl WinklerContact {
    /// Pressure at the distance ρ (m) from the axis, Pa: `p = (D − ρ²/2R)/η`, 0 outside the contact.
    #[must_use]
    pub fn pressure(&self, distance: f64) -> f64 {
        let share = distance / self.contact_radius;
        if share < 1.0 {
            self.peak_pressure * (1.0 - share) * (1.0 + share)
        } else {
            0.0
        }
    }

    /// Mean pressure over the contact, Pa: half the peak.
    #[must_use]
    pub fn mean_pressure(&self) -> f64 {
        0.5 * self.peak_pressure
    }

    /// Energy stored in the springs, J: `U = QD/3`.
    #[must_use]
    pub fn strain_energy(&self) -> f64 {
        self.force * self.penetration / 3.0
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::force_on_stiffening;

    #[test]
    fn the_force_on_stiffening_springs_is_the_integral_of_their_pressure() {
        let [radius, height, modulus] = [2.0, 0.3, 5.0];
        for penetration in [0.03, 0.2, 0.29] {
            // Q = 2π R ∫₀^D p df with p = −E ln(1 − (D − f)/h), by the midpoint rule
            let parts = 1000;
            let step = penetration / f64::from(parts);
            let pressure = |i: i32| -modulus * (1.0 - (f64::from(i) + 0.5) * step / height).ln();
            let sum: f64 = (0..parts).map(pressure).sum();
            let wanted = 2.0 * PI * radius * sum * step;
            let found = force_on_stiffening(radius, height, modulus, penetration);
            assert!(
                (found / wanted - 1.0).abs() < 1e-4,
                "{penetration}: {found} {wanted}"
            );
        }
        // A fully compressed spring bears any pressure, but the integral stays finite.
        let found = force_on_stiffening(radius, height, modulus, height);
        assert!((found - 2.0 * PI * radius * height * modulus).abs() < 1e-14);
    }
}
