//! Galin, Sneddon: a body of revolution whose height is a power of the distance from its axis.

use std::f64::consts::PI;

use crate::axisymmetric::quadrature::composite;

/// The contact of `f = ρⁿ/cⁿ⁻¹` with an elastic half-space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLawContact {
    /// Force Q, N.
    pub force: f64,
    /// Penetration D, m.
    pub penetration: f64,
    /// Contact radius a, m.
    pub contact_radius: f64,
    exponent: f64,
    plane_strain_modulus: f64,
}

/// The contact at a contact radius a (m), for the exponent n, the coefficient c (m) and the plane-strain modulus E*
/// (Pa).
#[must_use]
pub fn from_contact_radius(
    [exponent, coefficient]: [f64; 2],
    plane_strain_modulus: f64,
    contact_radius: f64,
) -> PowerLawContact {
    let (n, a) = (exponent, contact_radius);
    // D = √π Γ(n/2 + 1)/Γ(n/2 + ½) aⁿ/cⁿ⁻¹
    let penetration = penetration_over_height(n) * a * (a / coefficient).powf(n - 1.0);
    PowerLawContact {
        // Q = 2 E* n/(n + 1) D a
        force: 2.0 * plane_strain_modulus * n / (n + 1.0) * penetration * a,
        penetration,
        contact_radius,
        exponent,
        plane_strain_modulus,
    }
}

/// The contact at a penetration D (m), for the exponent n, the coefficient c (m) and the plane-strain modulus E* (Pa).
#[must_use]
pub fn from_penetration(
    [exponent, coefficient]: [f64; 2],
    plane_strain_modulus: f64,
    penetration: f64,
) -> PowerLawContact {
    let height = penetration / penetration_over_height(exponent);
    let radius = coefficient * (height / coefficient).powf(exponent.recip());
    PowerLawContact {
        penetration,
        ..from_contact_radius([exponent, coefficient], plane_strain_modulus, radius)
    }
}

/// The contact under a force Q (N), for the exponent n, the coefficient c (m) and the plane-strain modulus E* (Pa).
#[must_use]
pub fn from_force(
    [exponent, coefficient]: [f64; 2],
    plane_strain_modulus: f64,
    force: f64,
) -> PowerLawContact {
    let n = exponent;
    // aⁿ⁺¹/cⁿ⁻¹ = Q (n + 1)/(2 E* n D/f(a))
    let power = force * (n + 1.0) / (2.0 * plane_strain_modulus * n * penetration_over_height(n));
    let radius = coefficient * (power / coefficient.powi(2)).powf((n + 1.0).recip());
    PowerLawContact {
        force,
        ..from_contact_radius([exponent, coefficient], plane_strain_modulus, radius)
    }
}

/// Penetration over the indenter's height at the edge of the contact, `D/f(a) = √π Γ(n/2 + 1)/Γ(n/2 + ½)`: π/2 for a
/// cone, 2 for a paraboloid.
#[must_use]
pub fn penetration_over_height(exponent: f64) -> f64 {
    let half = 0.5 * exponent;
    PI.sqrt() * libm::tgamma(half + 1.0) / libm::tgamma(half + 0.5)
}

impl PowerLawContact {
    /// Pressure at the distance ρ (m) from the axis, Pa; 0 outside the contact.
    ///
    /// With `h(t) = D (t/a)ⁿ` it is `p = E*/π ∫ h′/√(t² − ρ²) dt` from ρ to a, here over `t = ρ cosh θ`. On the axis
    /// `p = E* n D/(π (n − 1) a)`, infinite for a cone.
    #[must_use]
    pub fn pressure(&self, distance: f64) -> f64 {
        let (n, a) = (self.exponent, self.contact_radius);
        let scale = self.plane_strain_modulus * n * self.penetration / (PI * a);
        if distance >= a {
            return 0.0;
        }
        if distance <= 0.0 {
            return scale / (n - 1.0);
        }
        let end = (a / distance).acosh();
        let pieces = end.ceil().max(1.0);
        let borders = (0..).map(f64::from).take_while(|k| *k <= pieces);
        let borders: Vec<f64> = borders.map(|k| end * k / pieces).collect();
        // ∫ (ρ cosh θ/a)ⁿ⁻¹ dθ; pieces of 1 are narrow beside the integrand's distance π/2 from the real axis
        let value = |theta: f64| (distance * theta.cosh() / a).powf(n - 1.0);
        let terms = composite(&borders).into_iter();
        scale
            * terms
                .map(|(theta, weight)| weight * value(theta))
                .sum::<f64>()
    }

    /// Mean pressure over the contact, Pa.
    #[must_use]
    pub fn mean_pressure(&self) -> f64 {
        self.force / (PI * self.contact_radius.powi(2))
    }

    /// Energy stored in the half-space, J: `U = n/(2n + 1) QD`.
    #[must_use]
    pub fn strain_energy(&self) -> f64 {
        // Q ∝ D^(1 + 1/n)
        self.exponent / (2.0 * self.exponent + 1.0) * self.force * self.penetration
    }
}

#[cfg(test)]
mod tests {
    use super::super::{cone, hertz};
    use super::*;

    #[test]
    fn exponents_of_two_and_one_give_hertz_and_the_cone() {
        let found = from_contact_radius([2.0, 4.0], 3.0, 0.3);
        let wanted = hertz::from_contact_radius(2.0, 3.0, 0.3);
        // Two gamma functions and some roundings.
        let close = |found: f64, wanted: f64| (found / wanted - 1.0).abs() < 5e-15;
        assert!(close(found.force, wanted.force) && close(found.penetration, wanted.penetration));
        for distance in [0.0, 1e-9, 1e-3, 0.1, 0.29] {
            let [found, wanted] = [found.pressure(distance), wanted.pressure(distance)];
            assert!(close(found, wanted), "{distance}: {found} {wanted}");
        }
        let found = from_contact_radius([1.0, 9.0], 3.0, 0.3);
        let wanted = cone::from_penetration(std::f64::consts::FRAC_PI_4, 3.0, found.penetration);
        assert!(close(found.force, wanted.force) && close(0.3, wanted.contact_radius));
        assert_eq!(found.pressure(0.0), f64::INFINITY);
        for distance in [1e-12, 1e-3, 0.1] {
            let [found, wanted] = [found.pressure(distance), wanted.pressure(distance)];
            assert!(close(found, wanted), "{distance}: {found} {wanted}");
        }
    }

    #[test]
    fn the_pressure_of_an_even_exponent_is_a_polynomial_times_a_root() {
        // n = 4: ∫ t³/√(t² − ρ²) dt = √(a² − ρ²) (a² + 2ρ²)/3; the largest pressure is not on the axis.
        let contact = from_contact_radius([4.0, 1.0], 1.0, 0.5);
        let scale = 4.0 * contact.penetration / (PI * 0.5_f64.powi(4));
        for distance in [0.0_f64, 1e-4, 0.2, 0.35, 0.49] {
            let square = distance.powi(2);
            let wanted = scale * (0.25 - square).sqrt() * (0.25 + 2.0 * square) / 3.0;
            let error = contact.pressure(distance) / wanted - 1.0;
            assert!(error.abs() < 1e-14, "{distance}: {error:e}");
        }
        assert!(contact.pressure(0.35) > 1.2 * contact.pressure(0.0));
    }
}
