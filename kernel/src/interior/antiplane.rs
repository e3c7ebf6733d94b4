//! The antiplane problem: displacement only across the wave vector.
//!
//! `W = u_y` and `S = σ_yz/(G k)` obey `dW/dζ = S`, `dS/dζ = W`. The bodies below a plane fix the ratio of `W` and
//! `T = −S`, both positive. It is carried upward together with `W − T`, which vanishes on a half-space. Across a layer,
//!
//! ```text
//! W' = W (1 + θ) + T (1 − θ)     T' = T (1 + θ) + W (1 − θ)     W' − T' = 2θ (W − T)     θ = e^{−2s}
//! ```
//!
//! All terms of a sum are positive, so each value has a small relative error.

use super::Antiplane;
use crate::response::ComplianceShare;
use crate::wave::PlaceInLayer;
use crate::{Base, Layer, Material};

/// The ratio `W : T` of the bodies below a plane, and `W − T`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Support {
    w: f64,
    t: f64,
    difference: f64,
}

/// The wave in one body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum AntiplaneWave {
    /// `s = k H`, the support of the bottom, and the factor that scales it.
    Layer {
        s: f64,
        support: Support,
        scale: f64,
    },
    /// `T` on the top.
    HalfSpace(f64),
    /// Nothing moves.
    Rigid,
}

impl Support {
    const HALF_SPACE: Self = Self {
        w: 1.0,
        t: 1.0,
        difference: 0.0,
    };

    const CLAMPED: Self = Self {
        w: 0.0,
        t: 1.0,
        difference: -1.0,
    };

    /// Carries the ratio across an interface, upward: `W' = W + ĉ T/μ`, `T' = T/μ`, all times `μ/(1 + ĉ)`.
    fn onto(self, mu: f64, mu_minus_one: f64, shear: ComplianceShare) -> Self {
        let Self { w, t, difference } = self;
        Self {
            w: shear.held * mu * w + shear.free * t,
            t: shear.held * t,
            // μ W − T + ĉ T
            difference: shear.held * (mu_minus_one * w + difference) + shear.free * t,
        }
        .normalised()
    }

    /// Carries the ratio from the bottom of a layer to its top.
    fn through(self, s: f64) -> Self {
        let theta = (-2.0 * s).exp();
        Self {
            w: carried(s, self.w, self.t),
            t: carried(s, self.t, self.w),
            difference: 2.0 * theta * self.difference,
        }
        .normalised()
    }

    fn normalised(self) -> Self {
        let factor = 1.0 / (self.w + self.t);
        Self {
            w: self.w * factor,
            t: self.t * factor,
            difference: self.difference * factor,
        }
    }
}

/// `2 e^{−r} (first cosh r + second sinh r)`
fn carried(r: f64, first: f64, second: f64) -> f64 {
    let lost = -(-2.0 * r).exp_m1();
    first * (2.0 - lost) + second * lost
}

impl AntiplaneWave {
    /// The waves of all bodies, surface first, the base last, under unit traction on the surface.
    pub(super) fn of(layers: &[Layer], base: Base, wavenumber: f64) -> Vec<Self> {
        let supports = bottom_supports(layers, base, wavenumber);
        let surface = match (layers.first(), base) {
            (Some(layer), _) => layer.material(),
            (None, Base::HalfSpace(material)) => material,
            (None, Base::Rigid) => return vec![Self::Rigid],
        };
        let mut traction = 1.0 / (surface.shear_modulus() * wavenumber);
        let mut waves = Vec::with_capacity(layers.len() + 1);
        for (layer, (support, mu)) in layers.iter().zip(supports) {
            let s = wavenumber * layer.thickness();
            let scale = traction / carried(s, support.t, support.w);
            waves.push(Self::Layer { s, support, scale });
            // T on the bottom, in the units of the body below
            traction = mu * (2.0 * support.t * scale * (-s).exp());
        }
        waves.push(match base {
            Base::HalfSpace(_) => Self::HalfSpace(traction),
            Base::Rigid => Self::Rigid,
        });
        waves
    }

    /// Amplitudes in a body of `stiffness = G k`.
    pub(super) fn at(&self, place: &PlaceInLayer, stiffness: f64) -> Antiplane {
        let decay = (-place.below_top).exp();
        let (w, t) = match *self {
            Self::Layer { support, scale, .. } => {
                let r = place.above_bottom;
                let factor = scale * decay;
                (
                    factor * carried(r, support.w, support.t),
                    factor * carried(r, support.t, support.w),
                )
            }
            Self::HalfSpace(t) => (t * decay, t * decay),
            Self::Rigid => (0.0, 0.0),
        };
        antiplane(w, t, stiffness)
    }

    /// The amplitudes in the top layer minus those in a half-space of its material.
    pub(super) fn correction(&self, place: &PlaceInLayer, stiffness: f64) -> Antiplane {
        let Self::Layer { s, support, scale } = *self else {
            return antiplane(0.0, 0.0, stiffness);
        };
        // (W − T) e^{−s} (e^{−r} ± e^{−r − 2ζ})
        let factor = scale * support.difference * (-s).exp() * (-place.above_bottom).exp();
        let lost = -(-2.0 * place.below_top).exp_m1();
        antiplane(factor * (2.0 - lost), -factor * lost, stiffness)
    }
}

fn antiplane(w: f64, t: f64, stiffness: f64) -> Antiplane {
    Antiplane {
        displacement: w,
        vertical_shear_stress: -stiffness * t,
        lateral_shear_stress: stiffness * w,
    }
}

/// The support of the bottom of every layer, surface first, with `μ`, the layer's shear modulus over that of the body
/// below (1 on a rigid base).
fn bottom_supports(layers: &[Layer], base: Base, wavenumber: f64) -> Vec<(Support, f64)> {
    let (mut support, mut below) = match base {
        Base::HalfSpace(material) => (Support::HALF_SPACE, Some(material)),
        Base::Rigid => (Support::CLAMPED, None),
    };
    let mut bottoms = Vec::with_capacity(layers.len());
    for layer in layers.iter().rev() {
        let (mu, excess) = below.map_or((1.0, 0.0), |below| ratio(layer.material(), below));
        let stiffness = layer.material().shear_modulus() * wavenumber;
        let compliance = layer.interface().shear_compliance();
        let shear = if compliance == 0.0 {
            ComplianceShare::new(0.0)
        } else {
            ComplianceShare::new(compliance * stiffness)
        };
        let bottom = support.onto(mu, excess, shear);
        bottoms.push((bottom, mu));
        support = bottom.through(wavenumber * layer.thickness());
        below = Some(layer.material());
    }
    bottoms.reverse();
    bottoms
}

/// `μ = G₁/G₂` and `μ − 1` without cancellation.
fn ratio(upper: Material, lower: Material) -> (f64, f64) {
    let (nu1, nu2) = (upper.poisson_ratio(), lower.poisson_ratio());
    let (e1, e2) = (upper.young_modulus(), lower.young_modulus());
    let mu = upper.shear_modulus() / lower.shear_modulus();
    (
        mu,
        ((e1 - e2) / e2 * (1.0 + nu2) + (nu2 - nu1)) / (1.0 + nu1),
    )
}
