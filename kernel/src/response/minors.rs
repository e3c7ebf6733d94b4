//! Everything that lies below a horizontal plane, as five numbers.
//!
//! At wavenumber `k` the state on a plane is `(U, V, τ, σ)`: horizontal and vertical displacement, shear and normal
//! traction, the tractions in units of `2 G k`. The bodies below restrict it to a plane spanned by two such columns,
//! which is described by their 2 × 2 minors (rows named by index):
//!
//! ```text
//! p = (UV)   q = −(Uτ) = (Vσ)   f = −(Uσ)   g = (Vτ)   d = (τσ)
//! ```
//!
//! With `τ = 0` on the plane, `V = −(g/d) σ`: `g/d` is the compliance and `Φ = g / (w d)`, `w = 2 (1 − ν)`. A common
//! factor has no meaning. `p d = f g − q²`, and `p, f, g, d ≥ 0`.
//!
//! The minors on the top of a homogeneous layer are *linear* in those on its bottom. Carrying the minors instead of the
//! columns keeps the recursion stable: the growing exponential `e^{2s}` is a common factor and is dropped, and no
//! difference of large numbers is left. (This is the compound, or delta, matrix of seismology.) The map follows from
//! `dv/dζ = A v`, `ζ = k z`,
//!
//! ```text
//! A = ⎡  0      1     2      0   ⎤      n = ν / (1 − ν)
//!     ⎢ −n      0     0      2m  ⎥      m = (1 − 2ν) / (2 (1 − ν))
//!     ⎢ 1/(1−ν) 0     0      n   ⎥
//!     ⎣  0      0    −1      0   ⎦      (A² − 1)² = 0
//! ```

use super::decay::Decay;
use crate::material::Poisson;

/// The five independent minors; tractions in units of `2 G k` of the body that the plane bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Minors {
    pub(crate) p: f64,
    pub(crate) q: f64,
    pub(crate) f: f64,
    pub(crate) g: f64,
    pub(crate) d: f64,
}

impl Minors {
    /// Below the plane there is a half-space of the same material.
    pub(crate) fn half_space(poisson: &Poisson) -> Self {
        let &Poisson { a, b, w, .. } = poisson;
        Self {
            p: a,
            q: b,
            f: w,
            g: w,
            d: 1.0,
        }
    }

    /// The plane is bonded to a rigid body: `U = V = 0`.
    pub(crate) const CLAMPED: Self = Self {
        p: 0.0,
        q: 0.0,
        f: 0.0,
        g: 0.0,
        d: 1.0,
    };

    /// The plane slides on a rigid body: `V = τ = 0`.
    pub(crate) const SLIDING: Self = Self {
        p: 0.0,
        q: 0.0,
        f: 1.0,
        g: 0.0,
        d: 0.0,
    };

    /// `S₁ = p + 2bq + ad`
    pub(crate) fn s1(&self, poisson: &Poisson) -> f64 {
        self.p + 2.0 * poisson.b * self.q + poisson.a * self.d
    }

    /// Carries the minors from the bottom of a layer to its top.
    ///
    /// With `k' = 4θ sinh s cosh s`, `h = 4θ sinh² s`, `S₂ = p − 2q − d` and `x = 1/w`,
    ///
    /// ```text
    /// A = x² h S₁ + x k'(f + g)      B = 4θ [x² s² S₂ + x s (g − f)]
    /// p' = 4θ p + a A + B            f' = 4θ f + h (f + g) + x k' S₁ − 4θ x s S₂
    /// q' = 4θ q + b A + B            g' = 4θ g + h (f + g) + x k' S₁ + 4θ x s S₂
    /// d' = 4θ d +   A − B
    /// ```
    ///
    /// The code inserts `h = q₂ + 4θ s²` and `k' = q₁ + 4θ s` and omits the terms that cancel.
    pub(crate) fn through(&self, poisson: &Poisson, decay: &Decay) -> Self {
        let &Self { p, q, f, g, d } = self;
        let &Poisson { nu, a, b, w, x } = poisson;
        let &Decay {
            s,
            theta4,
            e,
            q1,
            q2,
        } = decay;
        let sum = f + g;
        let s1 = self.s1(poisson);
        let grown = x * (x * q2 * s1 + q1 * sum);
        let normal = e * e * sum + x * q1 * s1;
        let one_minus_4nu = 1.0 - 4.0 * nu;
        Self {
            p: theta4
                * (p + x
                    * s
                    * (2.0 * s * (p + one_minus_4nu * q + 2.0 * b * d) + 2.0 * (b * f + w * g)))
                + a * grown,
            q: theta4
                * (q + x
                    * s
                    * (s * (p - 4.0 * nu * q + one_minus_4nu * d) + (w * g - 2.0 * nu * f)))
                + b * grown,
            f: theta4 * (f + 2.0 * s * (q + d)) + normal,
            g: theta4 * (g + 2.0 * x * s * (p - 2.0 * nu * q + b * d)) + normal,
            d: theta4 * (d + 2.0 * x * s * (s * (q + d) + f)) + grown,
        }
    }

    /// The order of magnitude of the largest minor.
    pub(crate) fn magnitude(&self) -> f64 {
        self.p + self.f + self.g + self.d
    }

    pub(crate) fn scaled(&self, factor: f64) -> Self {
        Self {
            p: self.p * factor,
            q: self.q * factor,
            f: self.f * factor,
            g: self.g * factor,
            d: self.d * factor,
        }
    }
}
