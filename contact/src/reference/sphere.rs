//! Sneddon: a sphere on an elastic half-space, with its exact shape instead of Hertz's paraboloid.

/// Below this a/R the series replaces the closed form, which loses one digit to cancellation there and more below.
const SERIES_BELOW: f64 = 0.3;

/// The contact of a sphere `f = R − √(R² − ρ²)` with an elastic half-space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereContact {
    /// Force Q, N.
    pub force: f64,
    /// Penetration D, m.
    pub penetration: f64,
    /// Contact radius a, m.
    pub contact_radius: f64,
}

/// The contact at a contact radius a < R (m), for the sphere's radius R (m) and the plane-strain modulus E* (Pa).
#[must_use]
pub fn from_contact_radius(
    radius: f64,
    plane_strain_modulus: f64,
    contact_radius: f64,
) -> SphereContact {
    let share = contact_radius / radius;
    SphereContact {
        force: plane_strain_modulus * radius * radius * reduced_force(share),
        // D = a artanh(a/R)
        penetration: contact_radius * share.atanh(),
        contact_radius,
    }
}

/// `Q/(E*R²) = (1 + t²) artanh t − t` with `t = a/R`.
fn reduced_force(t: f64) -> f64 {
    if t >= SERIES_BELOW {
        return (1.0 + t * t) * t.atanh() - t;
    }
    // Σ_k 4k/(4k² − 1) t^(2k+1), k = 1 … 16: the next term is below 0.06 · 0.3³² of the first.
    let term = |k: f64| 4.0 * k / (4.0 * k * k - 1.0);
    let series = (1..=16)
        .rev()
        .map(f64::from)
        .fold(0.0, |sum, k| sum * t * t + term(k));
    series * t.powi(3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_and_closed_form_agree_where_they_meet() {
        let t = SERIES_BELOW;
        let closed = (1.0 + t * t) * t.atanh() - t;
        // The closed form subtracts 0.3 from 0.3 and leaves 0.037: about ten roundings.
        assert!((reduced_force(t * (1.0 - 1e-16)) / closed - 1.0).abs() < 1e-14);
        assert!((reduced_force(0.299_999_999) / closed - 1.0).abs() < 2e-8);
    }

    #[test]
    fn a_small_contact_tends_to_that_of_hertz_with_second_order() {
        let error = |a: f64| {
            let hertz = crate::reference::hertz::from_contact_radius(2.0, 3.0, a);
            from_contact_radius(2.0, 3.0, a).force / hertz.force - 1.0
        };
        // Q/Q_Hertz = 1 + (2/5)(a/R)² + …
        assert!((error(1e-3) / (0.4 * 0.25e-6) - 1.0).abs() < 1e-5);
        assert!(((error(0.1) / error(0.01)).log10() - 2.0).abs() < 1e-2);
    }
}
