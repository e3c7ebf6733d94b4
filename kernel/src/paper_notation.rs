//! `Δ(γ, φ, λ, χ)` and `q̄` in the notation of the paper.
//!
//! F. I. Stepanov and E. V. Torskaya, Mech. Solids 57 (2022), DOI 10.3103/S0025654422010034, (3.1) and (3.2). Lengths
//! are in units of `a`, half the side of a square element: `γ = k a`, `λ = H/a`; `χ = E₁/E₂`; `φ` is the direction of
//! the wave vector. The paper's depth axis points out of the body, so its `Δ` has the opposite sign; here `Δ ≥ 0` gives
//! displacements into the body.

use crate::{Foundation, KernelError, Material};

/// Transform `q̄(γ, φ)` (3.2) of a unit pressure on the square `|x|, |y| ≤ 1` (in units of `a`).
///
/// `q̄ = ∫∫ cos(γ x cos φ) cos(γ y sin φ) dx dy = 4 sin(γ cos φ) sin(γ sin φ) / (γ² sin φ cos φ)`,
/// dimensionless, 4 at `γ = 0`; every direction and `γ` is allowed. Accuracy: rounding, plus that of
/// the phases `γ cos φ` and `γ sin φ`.
///
/// ```
/// // The load itself, four units of area, is what infinitely long waves see.
/// assert_eq!(pellicle_kernel::load_transform(0.0, 0.3), 4.0);
/// ```
#[must_use]
pub fn load_transform(gamma: f64, phi: f64) -> f64 {
    let (sin, cos) = phi.sin_cos();
    4.0 * sinc(gamma * cos) * sinc(gamma * sin)
}

/// `sin x / x`, 1 at 0.
fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x.sin() / x }
}

/// A bonded layer on a half-space in the paper's dimensionless form: only `χ`, `ν₁`, `ν₂`.
#[derive(Debug, Clone, PartialEq)]
pub struct TwoLayer {
    foundation: Foundation,
}

impl TwoLayer {
    /// A layer and a half-space with moduli in the ratio `χ = E₁/E₂` and these Poisson's ratios, the layer's first.
    ///
    /// # Errors
    ///
    /// [`KernelError::YoungModulus`] if the ratio is not positive and finite,
    /// [`KernelError::PoissonRatio`] outside [0, 0.5], [`KernelError::ModulusRatio`] beyond 1e30.
    pub fn new(modulus_ratio: f64, poisson_ratios: [f64; 2]) -> Result<Self, KernelError> {
        let layer = Material::new(modulus_ratio, poisson_ratios[0])?;
        let half_space = Material::new(1.0, poisson_ratios[1])?;
        let foundation = Foundation::coated(1.0, layer, half_space)?;
        Ok(Self { foundation })
    }

    /// `Δ(γ, φ, λ, χ) = 2 (1 − ν₁) q̄(γ, φ) Φ(γ λ)` (3.1), dimensionless, without the paper's sign.
    ///
    /// A unit pressure on the element displaces the surface at `(x, y)`, in units of `a`, by
    ///
    /// ```text
    /// u / a = (1 + ν₁) / (π² E₁) ∫₀^∞ ∫₀^{π/2} Δ cos(γ x cos φ) cos(γ y sin φ) dφ dγ
    /// ```
    ///
    /// Accuracy: that of [`load_transform`] and of [`Foundation::response`].
    ///
    /// ```
    /// use pellicle_kernel::TwoLayer;
    ///
    /// let same = TwoLayer::new(1.0, [0.3, 0.3])?;
    /// // Φ = 1: Δ = 2 · 0.7 · 4 for the longest waves, a few roundings.
    /// assert!((same.delta(0.0, 0.0, 1.0) - 5.6).abs() < 1e-14);
    /// # Ok::<(), pellicle_kernel::KernelError>(())
    /// ```
    #[must_use]
    pub fn delta(&self, gamma: f64, phi: f64, lambda: f64) -> f64 {
        let nu1 = self.foundation.surface_material().poisson_ratio();
        // Δ = 2 (1 − ν₁) q̄ Φ
        2.0 * (1.0 - nu1) * load_transform(gamma, phi) * self.foundation.response(gamma * lambda)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `∫ cos(c x) dx` over [−1, 1] by the midpoint rule, error `≤ c² h² / 12`.
    fn integral_of_cosine(c: f64) -> f64 {
        let n = 2000;
        let h = 2.0 / f64::from(n);
        (0..n)
            .map(|i| h * (c * (-1.0 + (f64::from(i) + 0.5) * h)).cos())
            .sum()
    }

    #[test]
    fn the_transformed_load_is_the_integral_over_the_square() {
        for (gamma, phi) in [(0.7_f64, 0.4_f64), (3.0, 1.2), (8.0, 0.0), (2.0, 4.0)] {
            let integral =
                integral_of_cosine(gamma * phi.cos()) * integral_of_cosine(gamma * phi.sin());
            // Two midpoint rules, each off by at most 2 · 64 · 1e-6 / 12.
            assert!(
                (load_transform(gamma, phi) - integral).abs() < 4.4e-5,
                "{gamma} {phi}"
            );
        }
    }

    #[test]
    fn delta_depends_on_the_direction_through_the_load_alone() {
        let layer = TwoLayer::new(10.0, [0.3, 0.4]).unwrap();
        let ratio = |phi| layer.delta(0.8, phi, 2.5) / load_transform(0.8, phi);
        // One division each
        assert!((ratio(0.1) / ratio(1.0) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn invalid_ratios_are_refused() {
        assert!(TwoLayer::new(0.0, [0.3, 0.3]).is_err());
        assert!(TwoLayer::new(1.0, [0.3, 0.51]).is_err());
    }

    #[test]
    fn on_one_material_the_determinant_is_that_of_a_half_space() {
        for nu in [0.0, 0.3, 0.5] {
            let same = TwoLayer::new(1.0, [nu, nu]).unwrap();
            // Φ = 1 and q̄ = 4 for the longest waves: Δ = 8 (1 − ν), a few roundings
            assert!((same.delta(0.0, 0.0, 1.0) - 8.0 * (1.0 - nu)).abs() < 1e-14);
        }
    }

    #[test]
    fn the_thickness_enters_only_through_the_response() {
        let layered = TwoLayer::new(10.0, [0.3, 0.4]).unwrap();
        let material = |young, poisson| Material::new(young, poisson).unwrap();
        let coated = Foundation::coated(1.0, material(10.0, 0.3), material(1.0, 0.4)).unwrap();
        let ratio = layered.delta(0.5, 0.2, 4.0) / layered.delta(0.5, 0.2, 0.3);
        // Δ(λ)/Δ(λ') = Φ(γλ)/Φ(γλ'), a few roundings
        let wanted = coated.response(2.0) / coated.response(0.15);
        assert!((ratio / wanted - 1.0).abs() < 1e-14);
    }
}
