//! Φ in 32 digits: the recursion over the layers, and a table of it.
//!
//! Everything below a horizontal plane is described, for one wavenumber, by the 2 × 2 minors of the two columns
//! (horizontal and vertical displacement, shear and normal traction) it admits:
//! `p = (UV)`, `q = (Vσ)`, `f = −(Uσ)`, `g = (Vτ)`, `d = (τσ)`, tractions in units of 2Gk. They are carried upward by linear
//! maps with only decaying exponentials, as in `pellicle_kernel`, whose `response` this must equal (test); here the formulas may
//! cancel, 32 digits bear it.

use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};

use super::expansion::{Cosines, Expansion};
use crate::chebyshev::taylor_weight;
use crate::twofold::Twofold;
use crate::whole;

/// Width of a panel over ln s: half an octave, so that 26 terms give 24 digits where the nearest pole of Φ is at 45°.
const WIDTH: f64 = std::f64::consts::LN_2 / 2.0;

/// Φ(s), `s = k H`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PreciseResponse {
    /// Over 0 ≤ s ≤ `reach`.
    low: Expansion,
    reach: f64,
    /// Lower end of the panels as ln s, half the reach.
    start: f64,
    panels: Vec<Expansion>,
}

impl PreciseResponse {
    /// Tabulates Φ, which is to be a low polynomial up to `reach` and 1 beyond `end`.
    pub(crate) fn new(foundation: &Foundation, [reach, end]: [f64; 2]) -> Self {
        let start = (reach / 2.0).ln();
        let count = whole::ceil((end.ln() - start) / WIDTH);
        let cosines = Cosines::new();
        let stack = Stack::new(foundation);
        let low =
            |node: Twofold| stack.value((Twofold::ONE + node) * Twofold::from(reach).scaled(0.5));
        let panels = (0..count).map(|panel| {
            let centre = Twofold::from(centre(start, panel));
            cosines.expansion(|node| stack.value((centre + HALF_WIDTH * node).exp()))
        });
        Self {
            low: cosines.expansion(low),
            reach,
            start,
            panels: panels.collect(),
        }
    }

    /// Up to this s, Φ is one polynomial.
    pub(crate) fn reach(&self) -> f64 {
        self.reach
    }

    /// Φ at s.
    #[inline]
    pub(crate) fn value(&self, s: Twofold, ln_s: Twofold) -> Twofold {
        let panel = (ln_s.rounded() - self.start) / WIDTH;
        if panel < 0.0 {
            return self
                .low
                .value(s.scaled(2.0) / Twofold::from(self.reach) - Twofold::ONE);
        }
        let panel = whole::floor(panel);
        let Some(expansion) = self.panels.get(panel) else {
            return Twofold::ONE;
        };
        let position = (ln_s - Twofold::from(centre(self.start, panel))) / HALF_WIDTH;
        expansion.value(position)
    }

    /// The Taylor coefficients of s², s⁴, s⁶ and s⁸ at 0.
    pub(crate) fn even_taylor(&self) -> [f64; 4] {
        [2_i32, 4, 6, 8].map(|power| {
            let terms = self.low.coefficients().enumerate();
            let sum = terms.fold(Twofold::ZERO, |sum, (j, c)| {
                // Weights are ratios of integers far below 2^106; 1e-16 of them is 1e-16 of a term that hardly cancels.
                sum + c * Twofold::from(taylor_weight(j, power))
            });
            sum.rounded() / self.reach.powi(power)
        })
    }
}

/// Half of [`WIDTH`].
const HALF_WIDTH: Twofold = Twofold::from_head(WIDTH / 2.0);

/// Centre of a panel as ln s; computed in one way only, for fit and value must mean the same point.
#[inline]
fn centre(start: f64, panel: usize) -> f64 {
    start + WIDTH * (panel as f64 + 0.5)
}

/// The minors of what lies below a plane.
#[derive(Clone, Copy, Debug)]
struct Minors {
    p: Twofold,
    q: Twofold,
    f: Twofold,
    g: Twofold,
    d: Twofold,
}

/// Combinations of one Poisson ratio.
#[derive(Clone, Copy, Debug)]
struct Poisson {
    /// `3 − 4ν`
    a: Twofold,
    /// `1 − 2ν`
    b: Twofold,
    /// `2(1 − ν)`
    w: Twofold,
    /// `1/w`
    x: Twofold,
}

impl Poisson {
    fn new(material: Material) -> Self {
        let nu = Twofold::from(material.poisson_ratio());
        let b = Twofold::ONE - nu.scaled(2.0);
        let w = (Twofold::ONE - nu).scaled(2.0);
        Self {
            a: Twofold::ONE + b.scaled(2.0),
            b,
            w,
            x: Twofold::ONE / w,
        }
    }
}

/// One layer and what it stands on.
struct Step {
    /// Thickness over the total thickness.
    thickness: Twofold,
    poisson: Poisson,
    interface: Interface,
    /// Ratio of shear moduli, layer over what is below; none on a rigid base.
    contrast: Option<Twofold>,
}

/// The layers from the lowest to the top.
struct Stack {
    steps: Vec<Step>,
    base: Minors,
}

impl Stack {
    fn new(foundation: &Foundation) -> Self {
        let total = Twofold::from(foundation.thickness());
        let layers = foundation.layers();
        let below = |index: usize| match (layers.get(index + 1), foundation.base()) {
            (Some(layer), _) => Some(layer.material()),
            (None, Base::HalfSpace(material)) => Some(material),
            (None, Base::Rigid) => None,
        };
        let step = |(index, layer): (usize, &Layer)| Step {
            thickness: Twofold::from(layer.thickness()) / total,
            poisson: Poisson::new(layer.material()),
            interface: layer.interface(),
            contrast: below(index).map(|below| shear_ratio(layer.material(), below)),
        };
        let base = match foundation.base() {
            Base::HalfSpace(material) => Minors::half_space(&Poisson::new(material)),
            Base::Rigid => Minors::CLAMPED,
        };
        Self {
            steps: layers.iter().enumerate().rev().map(step).collect(),
            base,
        }
    }

    /// `Φ = g/(w d)` on the surface.
    fn value(&self, s: Twofold) -> Twofold {
        let mut minors = self.base;
        let mut w = Twofold::ONE;
        for step in &self.steps {
            minors = minors.onto(step).through(&step.poisson, s * step.thickness);
            w = step.poisson.w;
        }
        minors.g / (w * minors.d)
    }
}

/// `G1/G2 = E1 (1+ν2)/(E2 (1+ν1))`.
fn shear_ratio(upper: Material, lower: Material) -> Twofold {
    let softness = |material: Material| {
        (Twofold::ONE + Twofold::from(material.poisson_ratio()))
            / Twofold::from(material.young_modulus())
    };
    softness(lower) / softness(upper)
}

impl Minors {
    const CLAMPED: Self = Self {
        p: Twofold::ZERO,
        q: Twofold::ZERO,
        f: Twofold::ZERO,
        g: Twofold::ZERO,
        d: Twofold::ONE,
    };
    const SLIDING: Self = Self {
        f: Twofold::ONE,
        d: Twofold::ZERO,
        ..Self::CLAMPED
    };

    fn half_space(poisson: &Poisson) -> Self {
        let &Poisson { a, b, w, .. } = poisson;
        Self {
            p: a,
            q: b,
            f: w,
            g: w,
            d: Twofold::ONE,
        }
    }

    /// In the layer above the interface, in its units, and scaled to the size of 1: a common factor means nothing.
    fn onto(&self, step: &Step) -> Self {
        let &Self { p, q, f, g, d } = self;
        match (step.interface, step.contrast) {
            (Interface::Bonded, None) => Self::CLAMPED,
            (Interface::Frictionless, None) => Self::SLIDING,
            (Interface::Bonded, Some(mu)) => Self {
                p: mu * p,
                q,
                f,
                g,
                d: d / mu,
            },
            (Interface::Frictionless, Some(mu)) => Self {
                p: mu * g,
                f: d,
                d: Twofold::ZERO,
                ..Self::CLAMPED
            },
        }
        .normalised()
    }

    fn normalised(self) -> Self {
        let size = (self.p + self.f + self.g + self.d).rounded();
        // An exact power of two, so that nothing is rounded.
        let factor = Twofold::power_of_two(-size.log2());
        Self {
            p: self.p.scaled(factor),
            q: self.q.scaled(factor),
            f: self.f.scaled(factor),
            g: self.g.scaled(factor),
            d: self.d.scaled(factor),
        }
    }

    /// From the bottom of a layer to its top.
    fn through(self, poisson: &Poisson, s: Twofold) -> Self {
        let Self { p, q, f, g, d } = self;
        let &Poisson { a, b, x, .. } = poisson;
        let theta = s.scaled(-2.0).exp();
        let theta4 = theta.scaled(4.0);
        let e = Twofold::ONE - theta;
        // 4θ sinh² s and 4θ sinh s cosh s
        let (square, mixed) = (e * e, e * (Twofold::ONE + theta));
        let s1 = p + (b * q).scaled(2.0) + a * d;
        let s2 = p - q.scaled(2.0) - d;
        let sum = f + g;
        let grown = x * (x * square * s1 + mixed * sum);
        let sheared = theta4 * x * s * (x * s * s2 + (g - f));
        let normal = square * sum + x * mixed * s1;
        let tilted = theta4 * x * s * s2;
        Self {
            p: theta4 * p + a * grown + sheared,
            q: theta4 * q + b * grown + sheared,
            f: theta4 * f + normal - tilted,
            g: theta4 * g + normal + tilted,
            d: theta4 * d + grown - sheared,
        }
    }
}
