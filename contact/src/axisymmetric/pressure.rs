//! An axisymmetric pressure.

use super::equation::Density;

/// A pressure on a circle, as its transform.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisymmetricPressure {
    radius: f64,
    /// Half of `E*`, Pa.
    half_modulus: f64,
    density: Density,
}

impl AxisymmetricPressure {
    pub(super) fn new(radius: f64, modulus: f64, density: Density) -> Self {
        Self {
            radius,
            half_modulus: modulus / 2.0,
            density,
        }
    }

    pub(super) fn density(&self) -> &Density {
        &self.density
    }

    /// Radius of the circle, m.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// `p̅(k) = ∫ p J₀(kr) r dr = E*/2 ∫ g cos kt dt`, N, at a wavenumber k (1/m).
    ///
    /// Accurate to 1e-13 of the force up to `k a = 50`, and to 1e-6 up to 150.
    #[must_use]
    pub fn transform(&self, wavenumber: f64) -> f64 {
        self.half_modulus * self.density.integral(|t| (wavenumber * t).cos())
    }
}
