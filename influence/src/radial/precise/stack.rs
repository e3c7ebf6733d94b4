//! Φ in 32 digits at one wavenumber, by recursion over the layers.
//!
//! For one wavenumber, everything below a horizontal plane is described by the 2 × 2 minors of the two columns
//! (horizontal and vertical displacement, shear and normal traction) that it admits: `p = (UV)`, `q = (Vσ)`,
//! `f = −(Uσ)`, `g = (Vτ)`, `d = (τσ)`, with tractions in units of 2Gk. They are carried upward by linear maps with
//! decaying exponentials only, as in `pellicle_kernel`, whose `response` this must equal (test). Here the formulas may
//! cancel, since there are 32 digits.

use pellicle_kernel::{Base, Foundation, Layer, Material};

use super::twofold::Twofold;

/// The minors of the bodies below a plane.
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

/// The decay of waves across a layer, `s = k h`, `θ = e^(−2s)`.
struct Decay {
    s: Twofold,
    /// `4θ`
    theta4: Twofold,
    /// `4θ sinh² s = (1−θ)²`
    square: Twofold,
    /// `4θ sinh s cosh s = 1 − θ²`
    mixed: Twofold,
}

impl Decay {
    fn new(s: Twofold) -> Self {
        let theta = s.scaled(-2.0).exp();
        let e = Twofold::ONE - theta;
        Self {
            s,
            theta4: theta.scaled(4.0),
            square: e * e,
            mixed: e * (Twofold::ONE + theta),
        }
    }
}

/// One layer and its support.
struct LayerStep {
    /// Thickness over the total thickness.
    thickness: Twofold,
    poisson: Poisson,
    is_frictionless: bool,
    /// The interface's normal and shear compliance times 2G/H, H the total thickness; the latter is 0 if frictionless.
    compliances: [Twofold; 2],
    /// Ratio of shear moduli, layer over the body below; `None` on a rigid base.
    contrast: Option<Twofold>,
}

/// The layers from the lowest to the top.
pub(crate) struct Stack {
    steps: Vec<LayerStep>,
    base: Minors,
}

impl Stack {
    pub(crate) fn new(foundation: &Foundation) -> Self {
        let total = Twofold::from(foundation.thickness());
        let layers = foundation.layers();
        let below = |index: usize| match (layers.get(index + 1), foundation.base()) {
            (Some(layer), _) => Some(layer.material()),
            (None, Base::HalfSpace(material)) => Some(material),
            (None, Base::Rigid) => None,
        };
        let step = |(index, layer): (usize, &Layer)| LayerStep {
            thickness: Twofold::from(layer.thickness()) / total,
            poisson: Poisson::new(layer.material()),
            is_frictionless: layer.interface().is_frictionless(),
            compliances: compliances(layer).map(|compliance| compliance / total),
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

    /// `Φ = g/(w d)` on the surface at `s = k H`, H the total thickness.
    pub(crate) fn value(&self, s: Twofold) -> Twofold {
        let (mut minors, mut w) = (self.base, Twofold::ONE);
        let mut decay = Decay::new(Twofold::ZERO);
        for step in &self.steps {
            let local = s * step.thickness;
            // Graded coatings have many layers of one thickness.
            if local != decay.s {
                decay = Decay::new(local);
            }
            minors = minors.onto(step, s).through(&step.poisson, &decay);
            w = step.poisson.w;
        }
        minors.g / (w * minors.d)
    }
}

/// The normal and the shear compliance of the interface below a layer, the latter 0 if frictionless, times
/// `2G = E/(1+ν)`.
fn compliances(layer: &Layer) -> [Twofold; 2] {
    let interface = layer.interface();
    let shear = if interface.is_frictionless() {
        0.0
    } else {
        interface.shear_compliance()
    };
    let material = layer.material();
    let stiffness = Twofold::from(material.young_modulus())
        / (Twofold::ONE + Twofold::from(material.poisson_ratio()));
    [interface.normal_compliance(), shear].map(|compliance| stiffness * Twofold::from(compliance))
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

    /// The minors in the layer above the interface, in its units and scaled to size 1: a common factor has no meaning.
    fn onto(&self, step: &LayerStep, s: Twofold) -> Self {
        let &Self { p, q, f, g, d } = self;
        let bottom = match (step.is_frictionless, step.contrast) {
            (false, None) => Self::CLAMPED,
            (true, None) => Self::SLIDING,
            (false, Some(mu)) => Self {
                p: mu * p,
                q,
                f,
                g,
                d: d / mu,
            },
            (true, Some(mu)) => Self {
                p: mu * g,
                f: d,
                d: Twofold::ZERO,
                ..Self::CLAMPED
            },
        };
        bottom
            .on_springs(step.compliances.map(|compliance| compliance * s))
            .normalised()
    }

    /// The minors above springs with these normal and shear compliances times 2Gk.
    fn on_springs(self, [normal, shear]: [Twofold; 2]) -> Self {
        let Self { p, q, f, g, d } = self;
        Self {
            p: p + normal * f + shear * (g + normal * d),
            q,
            f: f + shear * d,
            g: g + normal * d,
            d,
        }
    }

    fn normalised(self) -> Self {
        let size = (self.p + self.f + self.g + self.d).rounded();
        // An exact power of two, so that there is no rounding.
        let factor = Twofold::power_of_two(-size.log2());
        Self {
            p: self.p.scaled(factor),
            q: self.q.scaled(factor),
            f: self.f.scaled(factor),
            g: self.g.scaled(factor),
            d: self.d.scaled(factor),
        }
    }

    /// Carries the minors from the bottom of a layer to its top.
    fn through(self, poisson: &Poisson, decay: &Decay) -> Self {
        let Self { p, q, f, g, d } = self;
        let &Poisson { a, b, x, .. } = poisson;
        let &Decay {
            s,
            theta4,
            square,
            mixed,
        } = decay;
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

#[cfg(test)]
mod tests {
    use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};

    use super::super::twofold::Twofold;
    use super::Stack;

    fn layer(thickness: f64, modulus: f64, ratio: f64, interface: Interface) -> Layer {
        let material = Material::new(modulus, ratio).expect("a material");
        Layer::new(thickness, material, interface).expect("a layer")
    }

    #[test]
    fn the_recursion_in_32_digits_agrees_with_the_kernel() {
        for (interface, base) in [
            (Interface::Bonded, Base::Rigid),
            (Interface::Frictionless, Base::Rigid),
            (
                Interface::Bonded,
                Base::HalfSpace(Material::new(1e4, 0.3).unwrap()),
            ),
            (
                Interface::Frictionless,
                Base::HalfSpace(Material::new(30.0, 0.1).unwrap()),
            ),
            (
                Interface::spring(0.3, 20.0).unwrap(),
                Base::HalfSpace(Material::new(30.0, 0.1).unwrap()),
            ),
            (
                Interface::spring(0.1, f64::INFINITY).unwrap(),
                Base::HalfSpace(Material::new(1e4, 0.3).unwrap()),
            ),
            (Interface::spring(0.0, 0.2).unwrap(), Base::Rigid),
            (Interface::spring(5.0, f64::INFINITY).unwrap(), Base::Rigid),
        ] {
            let layers = vec![
                layer(0.3, 0.01, 0.5, Interface::Bonded),
                layer(1.0, 2.0, 0.2, Interface::Frictionless),
                layer(0.05, 1.0, 0.4, interface),
            ];
            let foundation = Foundation::new(layers, base).unwrap();
            let stack = Stack::new(&foundation);
            for s in [1e-3, 0.1, 1.0, 7.0, 60.0] {
                let expected = foundation.response(s / foundation.thickness());
                let found = stack.value(Twofold::from(s)).rounded();
                // The kernel's own accuracy.
                assert!(
                    (found / expected - 1.0).abs() < 1e-13,
                    "{s}: {found} {expected}"
                );
            }
        }
    }
}
