//! `Φ` and `C` for waves much longer and much shorter than the layers are thick.
//!
//! **Long waves.** The pressure passes unchanged through layers much thinner than the wavelength. The base gives `A/k`,
//! and each layer adds its shortening, which depends on its in-plane strain `ε` per pressure (`n = ν/(1−ν)`,
//! `E' = E/(1−ν²)`, `M = (1−2ν)(1+ν)/((1−ν)E)`):
//!
//! ```text
//! C(k) = A/k + B + O(k)      A = 2 (1 − ν₀²)/E₀      B = Σ H (M + 2 n ε − E' ε²)
//! ```
//!
//! Layers bonded to the base take its strain, `ε = −(1 − 2ν₀)(1 + ν₀)/E₀` on a half-space, 0 on a rigid base. Layers
//! above a frictionless interface stretch freely together, `ε = Σ H n / Σ H E'` over those bonded to each other. (The
//! second term in `2 n ε` is the work of the in-plane force on the base, by reciprocity.) A spring interface adds its
//! normal compliance `c_n`; its shear compliance, if finite, does not affect sufficiently long waves.
//!
//! **A uniform pressure** on a surface that repeats is not the limit of long waves: under a wave layers above a
//! frictionless interface slide from the crests to the troughs, however long it is. A cell that repeats has no room to
//! slide into, so `ε = 0` everywhere and `B = Σ (H M + c_n)`.
//!
//! **Short waves.** The wave reflected from the first interface has decayed like `e^{−2s}`, `s = k H₁`:
//! `Φ − 1 → e^{−2s} (α + β s + γ s²)`, with coefficients from the contrast of the two materials there. Above a spring
//! the coefficients depend on `k`: they go from those of a bond for `c 2Gk ≪ 1` to those of a free surface.

use crate::response::OneLayer;
use crate::{Base, Foundation, Layer, Material};

/// `C(k) = A/k + B + O(k)` for `k → 0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LongWaves {
    inverse: f64,
    constant: f64,
}

/// `Φ(k) − 1 = e^{−2s} (α + β s + γ s²)`, `s = k H₁`, for `k → ∞`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShortWaves {
    first: Layer,
    below: Base,
}

impl Foundation {
    /// Returns the limit of the compliance for waves much longer than the layers are thick.
    ///
    /// The remainder is `O(k)`, with a factor that grows with the contrast of the moduli: a coating `χ` times as stiff
    /// as its base needs `k H χ ≪ 1` (`the_remainder_is_of_first_order`). A coating held by a spring of shear
    /// compliance `c_s` also needs `k² H E' c_s ≪ 1`.
    ///
    /// ```
    /// use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
    ///
    /// let film = Layer::new(1e-6, Material::new(1e9, 0.25)?, Interface::Bonded)?;
    /// let foundation = Foundation::new(vec![film], Base::Rigid)?;
    /// // A confined film is a bed of springs: B = H (1 − 2ν)(1 + ν)/((1 − ν) E), a few roundings.
    /// let springs = foundation.long_waves().constant();
    /// assert!((springs / (1e-15 * 0.5 * 1.25 / 0.75) - 1.0).abs() < 1e-14);
    /// # Ok::<(), pellicle_kernel::KernelError>(())
    /// ```
    #[must_use]
    pub fn long_waves(&self) -> LongWaves {
        let (inverse, base_strain) = match self.base() {
            Base::HalfSpace(base) => (2.0 / base.plane_strain_modulus(), surface_strain(base)),
            Base::Rigid => (0.0, 0.0),
        };
        let mut groups = self
            .layers()
            .split_inclusive(|layer| layer.interface().is_frictionless())
            .peekable();
        let mut constant = 0.0;
        while let Some(group) = groups.next() {
            let is_bonded = groups.peek().is_none() && is_bonded_below(group);
            let strain = if is_bonded {
                base_strain
            } else {
                free_strain(group)
            };
            constant += group
                .iter()
                .map(|layer| shortening(layer, strain) + layer.interface().normal_compliance())
                .sum::<f64>();
        }
        LongWaves { inverse, constant }
    }

    /// Shortening of the layers and interfaces per uniform pressure, m/Pa, if they cannot widen, as in a cell that
    /// repeats: `Σ H (1 + ν)(1 − 2ν)/((1 − ν) E) + Σ c_n`, 0 for an incompressible layer.
    ///
    /// The base is not included. On a rigid base this is [`compliance`](Self::compliance) at `k = 0` if no interface is
    /// frictionless; above a frictionless interface long waves also squeeze a layer sideways.
    ///
    /// ```
    /// use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
    ///
    /// let rubber = Layer::new(5e-6, Material::new(10e6, 0.49)?, Interface::Frictionless)?;
    /// let foundation = Foundation::new(vec![rubber], Base::Rigid)?;
    /// // H (1 + ν)(1 − 2ν)/((1 − ν) E), a few roundings; free to widen it is 13 times as soft, H (1 − ν²)/E.
    /// let wanted = 5e-6 * 1.49 * 0.02 / (0.51 * 10e6);
    /// assert!((foundation.confined_compliance() / wanted - 1.0).abs() < 1e-14);
    /// # Ok::<(), pellicle_kernel::KernelError>(())
    /// ```
    #[must_use]
    pub fn confined_compliance(&self) -> f64 {
        let of_layer =
            |layer: &Layer| shortening(layer, 0.0) + layer.interface().normal_compliance();
        self.layers().iter().map(of_layer).sum()
    }

    /// Returns the limit of the response for waves much shorter than the first layer is thick; `None` for a half-space,
    /// where `Φ − 1 = 0`.
    ///
    /// Only the first layer and the body directly below it matter. The relative error is `O(s⁴ e^{−2s})` plus, if there
    /// is a second layer, `O(e^{−2 k H₂})` with powers of `k H₂`.
    #[must_use]
    pub fn short_waves(&self) -> Option<ShortWaves> {
        let (first, rest) = self.layers().split_first()?;
        let below = rest
            .first()
            .map_or(self.base(), |layer| Base::HalfSpace(layer.material()));
        Some(ShortWaves {
            first: *first,
            below,
        })
    }
}

impl LongWaves {
    /// `A`, 1/Pa: the base's `2 (1 − ν₀²) / E₀`, 0 for a rigid base.
    #[must_use]
    pub fn inverse(&self) -> f64 {
        self.inverse
    }

    /// `B`, m/Pa: the shortening of the layers per pressure.
    #[must_use]
    pub fn constant(&self) -> f64 {
        self.constant
    }

    /// `A/k + B`, the compliance of a long wave, m/Pa; `B` at `k = 0` on a rigid base.
    #[must_use]
    pub fn compliance(&self, wavenumber: f64) -> f64 {
        if self.inverse == 0.0 {
            return self.constant;
        }
        self.inverse / wavenumber.abs() + self.constant
    }
}

impl ShortWaves {
    /// The coefficients `α`, `β`, `γ`; the same for every wavenumber unless the first layer is on a spring.
    #[must_use]
    pub fn coefficients(&self, wavenumber: f64) -> [f64; 3] {
        OneLayer::at(&self.first, self.below, wavenumber.abs()).short_wave_coefficients()
    }

    /// `e^{−2s} (α + β s + γ s²)`, `s = k H₁`.
    #[must_use]
    pub fn response_minus_one(&self, wavenumber: f64) -> f64 {
        let s = wavenumber.abs() * self.first.thickness();
        let [alpha, beta, gamma] = self.coefficients(wavenumber);
        let decay = (-2.0 * s).exp();
        if decay == 0.0 {
            return 0.0;
        }
        decay * (alpha + s * (beta + s * gamma))
    }
}

fn is_bonded_below(group: &[Layer]) -> bool {
    group
        .last()
        .is_none_or(|layer| !layer.interface().is_frictionless())
}

/// In-plane strain per pressure of a half-space's surface: `−(1 − 2ν)(1 + ν)/E`.
fn surface_strain(material: Material) -> f64 {
    let nu = material.poisson_ratio();
    -(1.0 - 2.0 * nu) * (1.0 + nu) / material.young_modulus()
}

/// `n = ν / (1 − ν)`
fn widening(layer: &Layer) -> f64 {
    let nu = layer.material().poisson_ratio();
    nu / (1.0 - nu)
}

/// In-plane strain per pressure of layers that are free to stretch: `Σ H n / Σ H E'`.
fn free_strain(group: &[Layer]) -> f64 {
    let force: f64 = group.iter().map(|l| l.thickness() * widening(l)).sum();
    let stiffness: f64 = group
        .iter()
        .map(|l| l.thickness() * l.material().plane_strain_modulus())
        .sum();
    force / stiffness
}

/// `H (M + 2 n ε − E' ε²)`, m/Pa
fn shortening(layer: &Layer, strain: f64) -> f64 {
    let material = layer.material();
    let nu = material.poisson_ratio();
    // M = (1 − 2ν)(1 + ν) / ((1 − ν) E)
    let confined = (1.0 - 2.0 * nu) * (1.0 + nu) / ((1.0 - nu) * material.young_modulus());
    let stretched = strain * (2.0 * widening(layer) - material.plane_strain_modulus() * strain);
    layer.thickness() * (confined + stretched)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Interface;

    fn layer(thickness: f64, young: f64, poisson: f64, interface: Interface) -> Layer {
        let material = Material::new(young, poisson).unwrap();
        Layer::new(thickness, material, interface).unwrap()
    }

    fn foundations() -> Vec<Foundation> {
        use Interface::{Bonded, Frictionless};
        let spring = |normal, shear| Interface::spring(normal, shear).unwrap();
        let half_space = Base::HalfSpace(Material::new(1.0, 0.2).unwrap());
        let stacks = [
            vec![layer(1.0, 3.0, 0.3, Bonded)],
            vec![layer(1.0, 0.2, 0.5, Frictionless)],
            vec![layer(0.3, 2.0, 0.0, Bonded), layer(0.7, 0.5, 0.45, Bonded)],
            vec![
                layer(0.3, 2.0, 0.1, Bonded),
                layer(0.2, 0.7, 0.4, Frictionless),
                layer(0.5, 3.0, 0.3, Bonded),
            ],
            vec![layer(1.0, 3.0, 0.3, spring(0.7, 0.2))],
            vec![
                layer(0.3, 2.0, 0.1, spring(0.0, 0.3)),
                layer(0.7, 0.7, 0.4, spring(2.0, f64::INFINITY)),
            ],
        ];
        let on = |base: Base| {
            stacks
                .clone()
                .map(|layers| Foundation::new(layers, base).unwrap())
        };
        [on(half_space), on(Base::Rigid)].concat()
    }

    #[test]
    fn the_remainder_is_of_first_order() {
        for foundation in foundations() {
            let long = foundation.long_waves();
            let remainder = |k: f64| (foundation.compliance(k) - long.compliance(k)).abs();
            let (coarse, fine) = (remainder(2e-3), remainder(1e-3));
            // O(k) or better: halving k at least halves it, up to the next order, 1 %.
            assert!(fine <= 0.505 * coarse, "{coarse:e} {fine:e} {foundation:?}");
            // and it is small: a wrong B would leave a remainder of order 1
            assert!(fine < 3e-2, "{fine:e} {foundation:?}");
        }
    }

    #[test]
    fn the_confined_and_the_free_film_on_a_rigid_base_are_springs() {
        let springs = |interface| {
            let film = layer(2.0, 1.0, 0.25, interface);
            let long = Foundation::new(vec![film], Base::Rigid)
                .unwrap()
                .long_waves();
            assert_eq!(long.constant().to_bits(), long.compliance(0.0).to_bits());
            long.constant()
        };
        // H (1 − 2ν)(1 + ν)/((1 − ν) E) and H (1 − ν²)/E; a few roundings
        assert!((springs(Interface::Bonded) - 2.0 * 0.5 * 1.25 / 0.75).abs() < 1e-14);
        assert!((springs(Interface::Frictionless) - 2.0 * 0.9375).abs() < 1e-14);
    }

    #[test]
    fn short_waves_leave_an_exponentially_small_remainder() {
        for foundation in foundations() {
            let short = foundation.short_waves().unwrap();
            let thinnest = foundation
                .layers()
                .iter()
                .map(Layer::thickness)
                .fold(f64::MAX, f64::min);
            let remainder = |s: f64| {
                let (k, s1) = (
                    s / thinnest,
                    s / thinnest * foundation.layers()[0].thickness(),
                );
                let scale = (1.0 + s1 * s1) * (-2.0 * s1).exp();
                (foundation.response_minus_one(k) - short.response_minus_one(k)).abs() / scale
            };
            let (s, t) = (8.0_f64, 12.0_f64);
            // The next reflection is e^{−2s} smaller, with powers of s up to the fourth.
            let bound = |s: f64| 100.0 * s.powi(4) * (-2.0 * s).exp() + 1e-13;
            assert!(
                remainder(s) <= bound(s),
                "{:e} {foundation:?}",
                remainder(s)
            );
            assert!(
                remainder(t) <= bound(t),
                "{:e} {foundation:?}",
                remainder(t)
            );
        }
    }

    #[test]
    fn a_homogeneous_half_space_has_no_limit_of_short_waves() {
        let half_space = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
        assert_eq!(half_space.short_waves(), None);
        // C = A/k exactly
        assert!(half_space.long_waves().constant().abs() <= 0.0);
    }

    #[test]
    fn a_layer_of_the_base_material_adds_nothing_to_the_limit_of_long_waves() {
        let material = Material::new(3.0, 0.2).unwrap();
        let layer = Layer::new(2.0, material, Interface::Bonded).unwrap();
        let long = Foundation::new(vec![layer], Base::HalfSpace(material))
            .unwrap()
            .long_waves();
        // A = 2 (1 − ν²)/E, B = 0 up to the roundings of three terms of H/E
        assert!((long.inverse() - 2.0 * 0.96 / 3.0).abs() < 1e-15);
        assert!(long.constant().abs() < 1e-15, "{:e}", long.constant());
    }

    #[test]
    fn a_film_sliding_on_a_rigid_base_has_a_closed_form_for_short_waves() {
        let film = layer(0.5, 3.0, 0.3, Interface::Frictionless);
        let foundation = Foundation::new(vec![film], Base::Rigid).unwrap();
        // Φ = (1 − θ)²/(1 − θ² + 4 s θ), θ = e^{−2s}: Φ − 1 → −θ (2 + 4 s)
        let [alpha, beta, gamma] = foundation.short_waves().unwrap().coefficients(1.0);
        assert!((alpha + 2.0).abs() < 1e-14 && (beta + 4.0).abs() < 1e-14 && gamma.abs() < 1e-14);
    }
}
