//! The transformed problem of one layer on a half-space as four linear equations.
//!
//! This is the defining method: Hooke's law, equilibrium and the boundary conditions in their original form, solved by
//! elimination. The fast methods ([`Foundation::response`](crate::Foundation::response)) are checked against it.
//!
//! The paper has six unknowns, four in the layer and two in the half-space. The latter are eliminated by the stiffness
//! of the half-space, `p τ = −(g U + q V)`, `p σ = −(q U + f V)` with `p = 3 − 4ν₂`, `q = 1 − 2ν₂`,
//! `f = g = 2 (1 − ν₂)` and tractions in units of `2 G₂ k`. For `s < 2`, where decaying and growing waves look alike,
//! the layer's four unknowns are the state at its mid-depth. For larger `s` they are the amplitudes of two waves that
//! decay from the top and two that decay from the bottom: no exponential is large and no two columns become alike.

use crate::material::Poisson;
use crate::wave::{DepthFactors, LayerEquations, PlaceInLayer, TopPair, U, V};
use crate::{Interface, KernelError, Material};
use nalgebra::{Matrix4, RowVector4, Vector4};

/// The four equations of a layer on a half-space at one `s = k H`.
///
/// Accuracy of [`response`](Self::response): 1e-14 for every `s` and all materials (`tests/agreement.rs`).
///
/// ```
/// use pellicle_kernel::{Foundation, Material, TransformedSystem};
///
/// let (coating, steel) = (Material::new(300e9, 0.25)?, Material::new(210e9, 0.3)?);
/// let system = TransformedSystem::new(1.5, coating, steel);
/// let closed = Foundation::coated(1.0, coating, steel)?.response(1.5);
/// // Two stiff materials of the same order: elimination loses next to nothing.
/// assert!((system.response()? / closed - 1.0).abs() < 1e-14);
/// # Ok::<(), pellicle_kernel::KernelError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TransformedSystem {
    s: f64,
    surface: Poisson,
    equations: LayerEquations,
}

impl TransformedSystem {
    /// The equations at `s = k H > 0` of a `coating` bonded to a `substrate`.
    #[must_use]
    pub fn new(s: f64, coating: Material, substrate: Material) -> Self {
        Self::on(s, coating, Interface::Bonded, substrate)
    }

    /// The equations at `s = k H > 0` of a `coating` on any `interface`, with compliances in units of `H` per unit of
    /// pressure.
    #[must_use]
    pub fn on(s: f64, coating: Material, interface: Interface, substrate: Material) -> Self {
        let (upper, lower) = (Poisson::new(coating), Poisson::new(substrate));
        let mu = coating.shear_modulus() / substrate.shear_modulus();
        let unit = 2.0 * coating.shear_modulus() * s;
        let normal = interface.normal_compliance() * unit;
        let bottom = if interface.is_frictionless() {
            sliding_rows(mu, normal, &lower)
        } else {
            let shear = interface.shear_compliance() * unit;
            rows(mu, [normal, shear], &lower)
        };
        Self {
            s,
            surface: upper,
            equations: LayerEquations::new(&upper, s, TopPair::TRACTIONS, bottom),
        }
    }

    /// The matrix. Its rows are shear on top, pressure on top, shear and normal traction at the interface; its columns
    /// are the state `(U, V, τ, σ)` at mid-depth (`s < 2`) or the four waves.
    #[must_use]
    pub fn matrix(&self) -> Matrix4<f64> {
        self.equations.matrix
    }

    /// The right-hand side: no shear, pressure `2 G₁ k`, an interface in equilibrium.
    #[must_use]
    pub fn load(&self) -> Vector4<f64> {
        Vector4::new(0.0, -1.0, 0.0, 0.0)
    }

    /// The right-hand side under a traction `2 G₁ k` along the wave vector and no pressure.
    #[must_use]
    pub fn shear_load(&self) -> Vector4<f64> {
        Vector4::new(-1.0, 0.0, 0.0, 0.0)
    }

    /// `Φ = V(0) / (2 (1 − ν₁))` by elimination with partial pivoting, refined once.
    ///
    /// # Errors
    ///
    /// [`KernelError::Singular`] if a pivot vanishes.
    pub fn response(&self) -> Result<f64, KernelError> {
        self.displacement(self.load(), V)
    }

    /// `U(0) / (2 (1 − ν₁))` under the shear load: the tangential response, 1 on a half-space.
    ///
    /// # Errors
    ///
    /// [`KernelError::Singular`] if a pivot vanishes.
    pub fn shear_response(&self) -> Result<f64, KernelError> {
        self.displacement(self.shear_load(), U)
    }

    fn displacement(&self, load: Vector4<f64>, component: usize) -> Result<f64, KernelError> {
        let waves = self.equations.solve([load]);
        let [wave] = waves.ok_or(KernelError::Singular { s: self.s })?;
        let top = DepthFactors::new(self.s, &PlaceInLayer::top(self.s));
        Ok(self.surface.x * wave.at(&top)[component])
    }
}

/// `μ p τ + g U' + q V' = 0` and `μ p σ + q U' + f V' = 0`, `U' = U + ĉ_s τ`, `V' = V + ĉ_n σ`, scaled to size 1 for
/// the pivoting.
fn rows(mu: f64, [normal, shear]: [f64; 2], lower: &Poisson) -> [RowVector4<f64>; 2] {
    let &Poisson { a, b, w, .. } = lower;
    let rows = [
        RowVector4::new(w, b, mu * a + w * shear, b * normal),
        RowVector4::new(b, w, b * shear, mu * a + w * normal),
    ];
    rows.map(|row| row / row.amax())
}

/// `τ = 0` and, with it, `V' + μ w σ = 0`.
fn sliding_rows(mu: f64, normal: f64, lower: &Poisson) -> [RowVector4<f64>; 2] {
    let compliance = normal + mu * lower.w;
    [
        RowVector4::new(0.0, 0.0, 1.0, 0.0),
        RowVector4::new(0.0, 1.0, 0.0, compliance) / compliance.max(1.0),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_homogeneous_system_responds_like_a_half_space() {
        let material = Material::new(3.0, 0.5).unwrap();
        for s in [1e-8, 1e-3, 1.0, 10.0] {
            let response = TransformedSystem::new(s, material, material).response();
            // Elimination of a well-conditioned 4 × 4 system: tens of roundings.
            assert!((response.unwrap() - 1.0).abs() < 1e-14, "{s}");
        }
    }

    #[test]
    fn the_load_is_a_unit_pressure_without_shear() {
        let material = Material::new(3.0, 0.2).unwrap();
        let system = TransformedSystem::new(1.0, material, material);
        assert_eq!(system.load(), Vector4::new(0.0, -1.0, 0.0, 0.0));
        assert!(system.matrix().determinant().abs() > 0.0);
    }
}
