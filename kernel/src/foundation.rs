//! A layered elastic foundation and its compliance `C(k)`.
//!
//! `u̅(k) = C(k) p̅(k)` with `C(k) = 2 (1 − ν₁²) / (E₁ k) · Φ(k)`, where `E₁`, `ν₁` belong to the
//! body at the surface, `p` is compressive positive and `u` points into the body.

use crate::response::Response;
use crate::{Base, Interface, KernelError, Layer, Material};

/// Elastic layers, from the surface down, on a [`Base`].
///
/// ```
/// use pellicle_kernel::{Foundation, Material};
///
/// let coating = Material::new(300e9, 0.25)?;
/// let steel = Material::new(210e9, 0.3)?;
/// let foundation = Foundation::coated(2e-6, coating, steel)?;
/// // Waves much shorter than the coating is thick see only the coating: Φ → 1, to rounding.
/// assert!((foundation.response(1e8) - 1.0).abs() < 1e-15);
/// # Ok::<(), pellicle_kernel::KernelError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Foundation {
    layers: Vec<Layer>,
    base: Base,
    surface_material: Material,
    thickness: f64,
    response: Response,
}

impl Foundation {
    /// A foundation of any number of `layers` (surface first) on a `base`.
    ///
    /// # Errors
    ///
    /// [`KernelError::NothingElastic`] for a rigid base without layers,
    /// [`KernelError::TotalThickness`] if the thicknesses add up to infinity,
    /// [`KernelError::ModulusRatio`] if two neighbours differ by more than a factor of 1e30.
    pub fn new(layers: Vec<Layer>, base: Base) -> Result<Self, KernelError> {
        let surface_material = match (layers.first(), base) {
            (Some(layer), _) => layer.material(),
            (None, Base::HalfSpace(material)) => material,
            (None, Base::Rigid) => return Err(KernelError::NothingElastic),
        };
        let thickness: f64 = layers.iter().map(Layer::thickness).sum();
        if !thickness.is_finite() {
            return Err(KernelError::TotalThickness {
                layers: layers.len(),
                found: thickness,
            });
        }
        check_ratios(&layers, base)?;
        let response = Response::new(&layers, base);
        Ok(Self {
            layers,
            base,
            surface_material,
            thickness,
            response,
        })
    }

    /// A homogeneous elastic half-space: `Φ = 1`.
    #[must_use]
    pub fn half_space(material: Material) -> Self {
        Self {
            layers: Vec::new(),
            base: Base::HalfSpace(material),
            surface_material: material,
            thickness: 0.0,
            response: Response::HalfSpace,
        }
    }

    /// One bonded layer, a `coating` of `thickness` (m), on a half-space, the `substrate`.
    ///
    /// # Errors
    ///
    /// [`KernelError::Thickness`] if the thickness is not positive and finite,
    /// [`KernelError::ModulusRatio`] if the two differ by more than a factor of 1e30.
    pub fn coated(
        thickness: f64,
        coating: Material,
        substrate: Material,
    ) -> Result<Self, KernelError> {
        let layer = Layer::new(thickness, coating, Interface::Bonded)?;
        Self::new(vec![layer], Base::HalfSpace(substrate))
    }

    /// The layers, surface first; empty for a half-space.
    #[must_use]
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// What the layers rest on.
    #[must_use]
    pub fn base(&self) -> Base {
        self.base
    }

    /// The material at the surface: of the first layer, or of the half-space.
    #[must_use]
    pub fn surface_material(&self) -> Material {
        self.surface_material
    }

    /// Thickness of all layers together, m; 0 for a half-space.
    #[must_use]
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Compliance `C(k) = 2 (1 − ν₁²) / (E₁ k) · Φ(k)`, m/Pa, at the wavenumber `k` (1/m).
    ///
    /// As accurate as [`response`](Self::response). At `k = 0` it is infinite on a half-space; on
    /// a rigid base `C` stays finite as `k → 0` and should be asked for at a small `k`.
    #[must_use]
    pub fn compliance(&self, wavenumber: f64) -> f64 {
        let modulus = self.surface_material().plane_strain_modulus();
        // C = 2 (1 − ν₁²) / (E₁ k) · Φ
        2.0 / (modulus * wavenumber.abs()) * self.response(wavenumber)
    }

    /// Response `Φ(k)`: the compliance over that of a half-space of the surface's material.
    ///
    /// `Φ → 1` for large `k` and [`response_at_zero`](Self::response_at_zero) for `k → 0`. `k` is
    /// the length of the wave vector, 1/m; its sign does not matter.
    #[must_use]
    pub fn response(&self, wavenumber: f64) -> f64 {
        if wavenumber == 0.0 {
            return self.response_at_zero();
        }
        self.response.value(wavenumber.abs())
    }

    /// `Φ(k) − 1` without cancellation: relatively accurate also where `Φ` is almost 1.
    #[must_use]
    pub fn response_minus_one(&self, wavenumber: f64) -> f64 {
        if wavenumber == 0.0 {
            return self.response_at_zero() - 1.0;
        }
        self.response.minus_one(wavenumber.abs())
    }

    /// `lim Φ` for `k → 0`: `χ (1 − ν₂²) / (1 − ν₁²)`, `χ = E₁/E₂`, with `E₂`, `ν₂` of the base;
    /// 0 for a rigid base.
    ///
    /// Layers in between and the kind of their interfaces do not matter: a wave much longer than
    /// they are thick sees the base alone.
    #[must_use]
    pub fn response_at_zero(&self) -> f64 {
        match self.base {
            // Φ(0) = E₁ (1 − ν₂²) / (E₂ (1 − ν₁²))
            Base::HalfSpace(base) => {
                self.surface_material().plane_strain_modulus() / base.plane_strain_modulus()
            }
            Base::Rigid => 0.0,
        }
    }
}

/// The shear moduli of neighbours may differ by this factor, far beyond any pair of materials;
/// their squares and the products of a few layers then neither overflow nor vanish.
const LARGEST_RATIO: f64 = 1e30;

fn check_ratios(layers: &[Layer], base: Base) -> Result<(), KernelError> {
    let base = match base {
        Base::HalfSpace(material) => Some(material),
        Base::Rigid => None,
    };
    let below = layers.iter().skip(1).map(Layer::material).chain(base);
    for (layer, (upper, lower)) in layers.iter().zip(below).enumerate() {
        let found = upper.material().shear_modulus() / lower.shear_modulus();
        if !(1.0 / LARGEST_RATIO..=LARGEST_RATIO).contains(&found) {
            return Err(KernelError::ModulusRatio {
                layer,
                found,
                smallest: 1.0 / LARGEST_RATIO,
                largest: LARGEST_RATIO,
            });
        }
    }
    Ok(())
}
