//! From the top of one body to the bottom of the layer above it.
//!
//! The unit of tractions changes from `2 G₂ k` to `2 G₁ k`, `μ = G₁/G₂`. Across a frictionless interface the minors
//! start anew from the compliance `g/d` alone, with no shear on either side. Springs are added on top of a bond
//! ([`spring`](super::spring)).

use super::contrast::Contrast;
use super::minors::Minors;
use crate::material::Poisson;
use crate::{Base, Interface, Layer, Material};

/// The body that a layer stands on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Junction {
    /// Bonded to an elastic body.
    Bonded(MaterialStep),
    /// Sliding on an elastic body.
    Frictionless(MaterialStep),
    /// Bonded to a rigid body.
    Clamped(Poisson),
    /// Sliding on a rigid body.
    Sliding(Poisson),
}

/// The difference between two adjacent elastic bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MaterialStep {
    /// `μ = G₁/G₂`, upper over lower
    mu: f64,
    /// `1/μ`
    inverse_mu: f64,
    /// `μ − 1`, without cancellation
    mu_minus_one: f64,
    /// `ν₁ − ν₂`
    nu_difference: f64,
    upper: Poisson,
    lower: Poisson,
}

impl Junction {
    /// A spring interface is a bonded junction below a [`SpringWave`](super::spring::SpringWave).
    pub(crate) fn new(layer: &Layer, below: Option<Material>) -> Self {
        let upper = layer.material();
        match (layer.interface(), below) {
            (Interface::Bonded | Interface::Spring(_), Some(lower)) => {
                Self::Bonded(MaterialStep::new(upper, lower))
            }
            (Interface::Frictionless, Some(lower)) => {
                Self::Frictionless(MaterialStep::new(upper, lower))
            }
            (Interface::Bonded | Interface::Spring(_), None) => Self::Clamped(Poisson::new(upper)),
            (Interface::Frictionless, None) => Self::Sliding(Poisson::new(upper)),
        }
    }

    /// The junction of the lowest layer with the base.
    pub(crate) fn with_base(layer: &Layer, base: Base) -> Self {
        match base {
            Base::HalfSpace(material) => Self::new(layer, Some(material)),
            Base::Rigid => Self::new(layer, None),
        }
    }

    /// The minors of the base itself; those of a rigid base are not used.
    pub(crate) fn base_minors(&self) -> Minors {
        match self {
            Self::Bonded(step) | Self::Frictionless(step) => Minors::half_space(&step.lower),
            Self::Clamped(_) => Minors::CLAMPED,
            Self::Sliding(_) => Minors::SLIDING,
        }
    }

    /// The minors in the layer above, given those in the body below.
    pub(crate) fn minors(&self, below: &Minors) -> Minors {
        let &Minors { g, d, .. } = below;
        match self {
            Self::Bonded(step) => step.bonded_minors(below),
            // Columns (1, 0, 0, 0) and (0, g, 0, −d)
            Self::Frictionless(MaterialStep { mu, .. }) => Minors {
                p: mu * g,
                q: 0.0,
                f: d,
                g: 0.0,
                d: 0.0,
            },
            Self::Clamped(_) => Minors::CLAMPED,
            Self::Sliding(_) => Minors::SLIDING,
        }
    }

    /// The contrast with the layer above, given minors and contrast in the body below.
    pub(crate) fn contrast(&self, below: &Minors, contrast: &Contrast) -> Contrast {
        match self {
            Self::Bonded(step) => step.bonded_contrast(below, contrast),
            Self::Frictionless(step) => step.frictionless_contrast(below, contrast),
            Self::Clamped(poisson) => Contrast::of(&Minors::CLAMPED, poisson),
            Self::Sliding(poisson) => Contrast::of(&Minors::SLIDING, poisson),
        }
    }

    /// Minors and contrast in the layer above if it were bonded, whatever the interface.
    pub(crate) fn bonded(&self, below: &Minors, contrast: &Contrast) -> (Minors, Contrast) {
        match self {
            Self::Bonded(step) | Self::Frictionless(step) => (
                step.bonded_minors(below),
                step.bonded_contrast(below, contrast),
            ),
            Self::Clamped(poisson) | Self::Sliding(poisson) => {
                (Minors::CLAMPED, Contrast::of(&Minors::CLAMPED, poisson))
            }
        }
    }
}

impl MaterialStep {
    fn new(upper: Material, lower: Material) -> Self {
        let (e1, nu1) = (upper.young_modulus(), upper.poisson_ratio());
        let (e2, nu2) = (lower.young_modulus(), lower.poisson_ratio());
        // μ = E₁ (1 + ν₂) / (E₂ (1 + ν₁))
        let mu = (e1 / e2) * ((1.0 + nu2) / (1.0 + nu1));
        // μ − 1 = [(E₁ − E₂)(1 + ν₂)/E₂ + ν₂ − ν₁] / (1 + ν₁)
        let mu_minus_one = ((e1 - e2) / e2 * (1.0 + nu2) + (nu2 - nu1)) / (1.0 + nu1);
        Self {
            mu,
            inverse_mu: 1.0 / mu,
            mu_minus_one,
            nu_difference: nu1 - nu2,
            upper: Poisson::new(upper),
            lower: Poisson::new(lower),
        }
    }

    /// All are multiplied by μ: a common factor has no meaning.
    fn bonded_minors(&self, &Minors { p, q, f, g, d }: &Minors) -> Minors {
        Minors {
            p: self.mu * p,
            q,
            f,
            g,
            d: self.inverse_mu * d,
        }
    }

    /// The definitions of [`Contrast`] with the lower body's contrast split off.
    fn bonded_contrast(&self, below: &Minors, contrast: &Contrast) -> Contrast {
        let &Contrast { c1, c2, c3, c4 } = contrast;
        let &Minors { p, q, d, .. } = below;
        let (excess, nu12) = (self.mu_minus_one, self.nu_difference);
        let (x1, x2) = (self.upper.x, self.lower.x);
        let d_up = self.inverse_mu * d;
        // c₁' − c₁ = (μ − 1)(p + d/μ)
        let step1 = excess * (p + d_up);
        // x₁ − x₂ = 2 x₁ x₂ (ν₁ − ν₂)
        let x12 = 2.0 * x1 * x2 * nu12;
        // x₁ [(μ − 1)(p − a₂ d/μ) − 4 (ν₁ − ν₂)(q + d/μ)] + (x₁ − x₂) S₁
        let step3 = x1 * (excess * (p - self.lower.a * d_up) - 4.0 * nu12 * (q + d_up))
            + x12 * below.s1(&self.lower);
        Contrast {
            c1: c1 + step1,
            c2: c2 + x12 * c1 + x1 * step1,
            c3: c3 + step3,
            c4: c4 + self.softening() * d_up,
        }
    }

    /// The definitions for `p = μg`, `f = d`, `q = g = d = 0`, with `g = w₂ d + c₄`.
    fn frictionless_contrast(&self, below: &Minors, contrast: &Contrast) -> Contrast {
        // x₁ μ g − d = x₁ [(μ w₂ − w₁) d + μ c₄]
        let excess = self.upper.x * (self.softening() * below.d + self.mu * contrast.c4);
        Contrast {
            c1: self.mu * below.g,
            c2: excess,
            c3: excess,
            c4: 0.0,
        }
    }

    /// `μ w₂ − w₁ = w₂ (μ − 1) + 2 (ν₁ − ν₂)`
    fn softening(&self) -> f64 {
        self.lower.w * self.mu_minus_one + 2.0 * self.nu_difference
    }
}
