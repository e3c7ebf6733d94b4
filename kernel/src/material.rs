//! A linear elastic isotropic material, and the combinations of its Poisson's ratio in the transformed equations.

use crate::KernelError;

/// A linear elastic isotropic material: Young's modulus `E` (Pa) and Poisson's ratio `ν`.
///
/// ```
/// use pellicle_kernel::Material;
///
/// let steel = Material::new(210e9, 0.3)?;
/// assert_eq!(steel.young_modulus(), 210e9);
/// assert!(Material::new(210e9, 0.6).is_err());
/// # Ok::<(), pellicle_kernel::KernelError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    young_modulus: f64,
    poisson_ratio: f64,
}

impl Material {
    /// The limit of an infinite modulus: the surface of a body that does not deform.
    pub(crate) const RIGID: Self = Self {
        young_modulus: f64::INFINITY,
        poisson_ratio: 0.0,
    };

    /// A material of Young's modulus `E` (Pa, positive) and Poisson's ratio `ν` in [0, 0.5].
    ///
    /// Both ends are allowed: `ν = 0.5` is incompressible and needs no special care anywhere in
    /// this crate.
    ///
    /// # Errors
    ///
    /// [`KernelError::YoungModulus`] or [`KernelError::PoissonRatio`] outside those ranges, NaN
    /// included.
    pub fn new(young_modulus: f64, poisson_ratio: f64) -> Result<Self, KernelError> {
        if !(young_modulus.is_finite() && young_modulus > 0.0) {
            return Err(KernelError::YoungModulus {
                found: young_modulus,
            });
        }
        if !(0.0..=0.5).contains(&poisson_ratio) {
            return Err(KernelError::PoissonRatio {
                found: poisson_ratio,
            });
        }
        Ok(Self {
            young_modulus,
            poisson_ratio,
        })
    }

    /// Young's modulus `E`, Pa.
    #[must_use]
    pub fn young_modulus(&self) -> f64 {
        self.young_modulus
    }

    /// Poisson's ratio `ν`.
    #[must_use]
    pub fn poisson_ratio(&self) -> f64 {
        self.poisson_ratio
    }

    /// Shear modulus `G = E / (2 (1 + ν))`, Pa.
    #[must_use]
    pub fn shear_modulus(&self) -> f64 {
        self.young_modulus / (2.0 * (1.0 + self.poisson_ratio))
    }

    /// Plane strain modulus `E / (1 − ν²)`, Pa.
    #[must_use]
    pub fn plane_strain_modulus(&self) -> f64 {
        let nu = self.poisson_ratio;
        // 1 − ν² = (1 − ν)(1 + ν)
        self.young_modulus / ((1.0 - nu) * (1.0 + nu))
    }
}

/// The combinations of `ν` in the transformed equations, each computed without cancellation for `ν` in [0, 0.5].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Poisson {
    /// `ν`
    pub(crate) nu: f64,
    /// `a = 3 − 4ν`
    pub(crate) a: f64,
    /// `b = 1 − 2ν`; `a = 1 + 2b`
    pub(crate) b: f64,
    /// `w = 2 (1 − ν)`; `a + 1 = 2w`
    pub(crate) w: f64,
    /// `x = 1 / w`
    pub(crate) x: f64,
}

impl Poisson {
    pub(crate) fn new(material: Material) -> Self {
        let nu = material.poisson_ratio();
        let w = 2.0 * (1.0 - nu);
        Self {
            nu,
            a: 3.0 - 4.0 * nu,
            b: 1.0 - 2.0 * nu,
            w,
            x: 1.0 / w,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moduli_follow_from_young_and_poisson() {
        let material = Material::new(2.5, 0.25).unwrap();
        // 2.5 / (2 · 5/4) and 2.5 / (15/16), a rounding or two
        assert!((material.shear_modulus() - 1.0).abs() < 1e-15);
        assert!((material.plane_strain_modulus() - 8.0 / 3.0).abs() < 1e-15);
    }

    #[test]
    fn both_ends_of_poissons_ratio_are_accepted() {
        assert!(Material::new(1.0, 0.0).is_ok());
        assert!(Material::new(1.0, 0.5).is_ok());
    }

    #[test]
    fn invalid_moduli_and_ratios_are_refused_with_their_value() {
        for found in [0.0, -1.0, f64::INFINITY] {
            assert_eq!(
                Material::new(found, 0.3),
                Err(KernelError::YoungModulus { found })
            );
        }
        for found in [-0.1, 0.500_001, 0.6, f64::INFINITY] {
            assert_eq!(
                Material::new(1.0, found),
                Err(KernelError::PoissonRatio { found })
            );
        }
        assert!(Material::new(f64::NAN, 0.3).is_err());
        assert!(Material::new(1.0, f64::NAN).is_err());
        let message = Material::new(1.0, 0.6).unwrap_err().to_string();
        assert_eq!(
            message,
            "found 0.6 for Poisson's ratio, wanted a number in [0, 0.5]"
        );
    }
}
