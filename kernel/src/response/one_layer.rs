//! `Φ` of one layer in closed form, for any base.
//!
//! The [minors](super::minors) below the layer do not depend on `k`, so `Φ` is a ratio of two short sums of the
//! functions in [`Decay`], with constants prepared once. For a bonded half-space it is, term by term, the known
//! two-layer form (O'Sullivan and King 1988; Nogi and Kato 1997), rewritten so that nothing cancels at small `s`.

use super::contrast::Contrast;
use super::decay::Decay;
use super::junction::Junction;
use super::minors::Minors;
use super::spring::SpringWave;
use crate::material::Poisson;
use crate::{Base, Interface, Layer};

/// The coefficients of numerator, denominator and `N − D`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct OneLayer {
    thickness: f64,
    numerator: [f64; 4],
    denominator: [f64; 5],
    difference: [f64; 4],
}

impl OneLayer {
    /// A layer that is bonded or frictionless.
    pub(crate) fn new(layer: &Layer, base: Base) -> Self {
        let junction = Junction::with_base(layer, base);
        let below = junction.base_minors();
        let contrast = junction.contrast(&below, &Contrast::NONE);
        Self::supported(layer, &junction.minors(&below), &contrast)
    }

    /// A layer on any interface, for one wavenumber.
    pub(crate) fn at(layer: &Layer, base: Base, wavenumber: f64) -> Self {
        let Interface::Spring(_) = layer.interface() else {
            return Self::new(layer, base);
        };
        let junction = Junction::with_base(layer, base);
        let (below, contrast) = junction.bonded(&junction.base_minors(), &Contrast::NONE);
        let unit = 2.0 * layer.material().shear_modulus() * wavenumber;
        let spring = SpringWave::new(layer.interface(), unit);
        let poisson = Poisson::new(layer.material());
        let contrast = spring.contrast(&below, &contrast, &poisson);
        Self::supported(layer, &spring.minors(&below), &contrast)
    }

    /// A layer with these minors and this contrast on its bottom.
    fn supported(layer: &Layer, minors: &Minors, contrast: &Contrast) -> Self {
        let poisson = Poisson::new(layer.material());
        let &Contrast { c1, c2, c3, c4 } = contrast;
        let Poisson { nu, b, w, x, .. } = poisson;
        let s1 = minors.s1(&poisson);
        let (p, q, f, g, d) = (minors.p, minors.q, minors.f, minors.g, minors.d);
        Self {
            thickness: layer.thickness(),
            // g' and w d' of `Minors::through`, collected by the functions of s
            numerator: [x * s1, f + g, g, 2.0 * x * (p - 2.0 * nu * q + b * d)],
            denominator: [x * s1, f + g, w * d, 2.0 * f, 2.0 * (q + d)],
            // c₄' of `Contrast::through`
            difference: [c4, 0.5 * c3, c2, x * c1],
        }
    }

    /// `α`, `β`, `γ` of `Φ − 1 → e^{−2s} (α + β s + γ s²)` for large `s`.
    pub(crate) fn short_wave_coefficients(&self) -> [f64; 3] {
        let [m0, m1, m2, m3] = self.difference;
        let [d0, d1, ..] = self.denominator;
        // 4θ [c₄ + c₃/2 + c₂ s + x c₁ s²] / D with e, q₁, q₂ → 1 and θ → 0 in D
        [m0 + m1, m2, m3].map(|numerator| 4.0 * numerator / (d0 + d1))
    }

    /// `Φ = N / D`
    pub(crate) fn value(&self, wavenumber: f64) -> f64 {
        let decay = Decay::new(wavenumber * self.thickness);
        self.numerator(&decay) / self.denominator(&decay)
    }

    /// `Φ − 1 = (N − D) / D`
    pub(crate) fn minus_one(&self, wavenumber: f64) -> f64 {
        let decay = Decay::new(wavenumber * self.thickness);
        self.difference(&decay) / self.denominator(&decay)
    }

    fn numerator(&self, decay: &Decay) -> f64 {
        let &Decay {
            s, theta4, e, q1, ..
        } = decay;
        let [n0, n1, n2, n3] = self.numerator;
        n0 * q1 + n1 * e * e + theta4 * (n2 + n3 * s)
    }

    fn denominator(&self, decay: &Decay) -> f64 {
        let &Decay {
            s, theta4, q1, q2, ..
        } = decay;
        let [d0, d1, d2, d3, d4] = self.denominator;
        d0 * q2 + d1 * q1 + theta4 * (d2 + s * (d3 + s * d4))
    }

    fn difference(&self, decay: &Decay) -> f64 {
        let &Decay { s, theta4, e, .. } = decay;
        let [m0, m1, m2, m3] = self.difference;
        theta4 * (m0 + m1 * e + s * (m2 + m3 * s))
    }
}
