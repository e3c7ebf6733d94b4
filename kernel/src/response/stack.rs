//! `Φ` of any number of layers: the minors carried upward, layer by layer.

use super::contrast::Contrast;
use super::decay::Decay;
use super::junction::Junction;
use super::minors::Minors;
use super::spring::SpringWave;
use crate::material::Poisson;
use crate::{Base, Interface, Layer};

/// Layers prepared for the recursion, the lowest first.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Stack {
    steps: Vec<LayerStep>,
    base: Minors,
    surface: Poisson,
}

/// One layer and its support.
#[derive(Debug, Clone, Copy, PartialEq)]
struct LayerStep {
    thickness: f64,
    /// `2 G`
    stiffness: f64,
    poisson: Poisson,
    interface: Interface,
    junction: Junction,
}

/// The support of the bottom of one layer, in the units of the layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BottomSupport {
    /// The minors of the bodies below the interface.
    pub(crate) below: Minors,
    /// The interface.
    pub(crate) spring: SpringWave,
    /// The minors of both together.
    pub(crate) minors: Minors,
    /// The difference between both together and a half-space of the layer's material.
    pub(crate) contrast: Contrast,
}

/// Minors are scaled back to 1 when they leave the range from 1e-100 to 1e100. Starting inside it, two more layers with
/// the largest ratio of moduli, 1e30, cannot overflow.
const LARGE: f64 = 1e100;

impl Stack {
    /// Prepares `layers` (surface first, at least one) on a `base`.
    pub(crate) fn new(layers: &[Layer], base: Base) -> Self {
        let below = |i: usize| layers.get(i + 1).map(Layer::material);
        let junction = |i: usize, layer| match below(i) {
            Some(material) => Junction::new(layer, Some(material)),
            None => Junction::with_base(layer, base),
        };
        let steps: Vec<_> = (layers.iter().enumerate().rev())
            .map(|(i, layer)| LayerStep {
                thickness: layer.thickness(),
                stiffness: 2.0 * layer.material().shear_modulus(),
                poisson: Poisson::new(layer.material()),
                interface: layer.interface(),
                junction: junction(i, layer),
            })
            .collect();
        Self {
            base: steps[0].junction.base_minors(),
            surface: steps[steps.len() - 1].poisson,
            steps,
        }
    }

    /// `Φ = g / (w d)` on the surface.
    pub(crate) fn value(&self, wavenumber: f64) -> f64 {
        let mut minors = self.base;
        for step in &self.steps {
            let decay = Decay::new(wavenumber * step.thickness);
            minors = step.minors(&minors, &decay, wavenumber);
            let factor = rescaling(&minors);
            minors = minors.scaled(factor);
        }
        minors.g / (self.surface.w * minors.d)
    }

    /// The support of the bottom of every layer, surface first, and the minors on the top of every layer but the first
    /// and of the base, each in the units of its body.
    pub(crate) fn bottom_supports(&self, wavenumber: f64) -> Vec<(BottomSupport, Minors)> {
        let (mut top, mut contrast) = (self.base, Contrast::NONE);
        let mut bottoms = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            let bottom = step.bottom_support(&top, &contrast, wavenumber);
            bottoms.push((bottom, top));
            let decay = Decay::new(wavenumber * step.thickness);
            top = bottom.minors.through(&step.poisson, &decay);
            contrast = bottom.contrast.through(&step.poisson, &decay);
            let factor = rescaling(&top);
            (top, contrast) = (top.scaled(factor), contrast.scaled(factor));
        }
        bottoms.reverse();
        bottoms
    }

    /// `Φ − 1 = c₄ / (w d)` on the surface, or `(g − w d) / (w d)` where that is more accurate.
    pub(crate) fn minus_one(&self, wavenumber: f64) -> f64 {
        let (mut minors, mut contrast) = (self.base, Contrast::NONE);
        for step in &self.steps {
            let decay = Decay::new(wavenumber * step.thickness);
            contrast = step.contrast(&minors, &contrast, &decay, wavenumber);
            minors = step.minors(&minors, &decay, wavenumber);
            let factor = rescaling(&minors);
            (minors, contrast) = (minors.scaled(factor), contrast.scaled(factor));
        }
        let homogeneous = self.surface.w * minors.d;
        let (plain, size) = (minors.g - homogeneous, minors.g + homogeneous);
        Contrast::judged(contrast.c4, plain, size, self.steps.len()) / homogeneous
    }
}

impl LayerStep {
    /// Carries the minors from the top of the body below to the top of the layer.
    fn minors(&self, below: &Minors, decay: &Decay, wavenumber: f64) -> Minors {
        let bonded = self.junction.minors(below);
        let bottom = match self.interface {
            Interface::Spring(_) => self.spring(wavenumber).minors(&bonded),
            Interface::Bonded | Interface::Frictionless => bonded,
        };
        bottom.through(&self.poisson, decay)
    }

    fn contrast(
        &self,
        below: &Minors,
        contrast: &Contrast,
        decay: &Decay,
        wavenumber: f64,
    ) -> Contrast {
        let bottom = match self.interface {
            Interface::Spring(_) => self.bottom_support(below, contrast, wavenumber).contrast,
            Interface::Bonded | Interface::Frictionless => self.junction.contrast(below, contrast),
        };
        bottom.through(&self.poisson, decay)
    }

    /// The support of the bottom as a bond below a spring, whatever the kind of the interface.
    fn bottom_support(
        &self,
        below: &Minors,
        contrast: &Contrast,
        wavenumber: f64,
    ) -> BottomSupport {
        let (below, contrast) = self.junction.bonded(below, contrast);
        let spring = self.spring(wavenumber);
        BottomSupport {
            below,
            spring,
            minors: spring.minors(&below),
            contrast: spring.contrast(&below, &contrast, &self.poisson),
        }
    }

    fn spring(&self, wavenumber: f64) -> SpringWave {
        SpringWave::new(self.interface, self.stiffness * wavenumber)
    }
}

/// The factor that brings the minors back to 1 if they have left the range.
fn rescaling(minors: &Minors) -> f64 {
    let magnitude = minors.magnitude();
    if (1.0 / LARGE..=LARGE).contains(&magnitude) {
        1.0
    } else {
        1.0 / magnitude
    }
}

#[cfg(test)]
mod tests {
    use super::super::one_layer::OneLayer;
    use super::*;
    use crate::{Interface, Material};

    fn layer(thickness: f64, young: f64, poisson: f64) -> Layer {
        let material = Material::new(young, poisson).unwrap();
        Layer::new(thickness, material, Interface::Bonded).unwrap()
    }

    fn half_space(young: f64, poisson: f64) -> Base {
        Base::HalfSpace(Material::new(young, poisson).unwrap())
    }

    const WAVENUMBERS: [f64; 8] = [1e-8, 1e-4, 0.03, 0.5, 1.0, 4.0, 20.0, 1e3];

    #[test]
    fn one_layer_as_a_stack_is_the_closed_form() {
        for (young, poisson) in [(1e-6, 0.5), (0.1, 0.0), (7.0, 0.3), (1e6, 0.5)] {
            for base in [half_space(1.0, 0.25), half_space(1.0, 0.5), Base::Rigid] {
                let layer = layer(1.0, young, poisson);
                let (stack, closed) = (Stack::new(&[layer], base), OneLayer::new(&layer, base));
                for k in WAVENUMBERS {
                    let (found, wanted) = (stack.value(k), closed.value(k));
                    // The same sums in another order: a few roundings of 1.1e-16 each.
                    assert!(
                        (found - wanted).abs() <= 2e-15 * wanted,
                        "{k} {found} {wanted}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_layer_split_into_sublayers_has_the_same_response() {
        for pieces in [2_u8, 50] {
            let thickness = 1.0 / f64::from(pieces);
            let sublayers = vec![layer(thickness, 30.0, 0.4); usize::from(pieces)];
            let base = half_space(1.0, 0.2);
            let whole = OneLayer::new(&layer(1.0, 30.0, 0.4), base);
            let cut = Stack::new(&sublayers, base);
            for k in WAVENUMBERS {
                let (found, wanted) = (cut.value(k), whole.value(k));
                // 50 layers, a few roundings each that do not add up in one direction.
                assert!(
                    (found - wanted).abs() <= 5e-15 * wanted,
                    "{k} {found} {wanted}"
                );
                let (found, wanted) = (cut.minus_one(k), whole.minus_one(k));
                // e^{−2s} magnifies the rounding of s by 2s.
                let bound = 1e-14 * (1.0 + 2.0 * k) * wanted.abs();
                assert!((found - wanted).abs() <= bound, "{k} {found:e} {wanted:e}");
            }
        }
    }

    #[test]
    fn a_layer_on_a_rigid_base_split_in_two_keeps_the_digits_of_short_waves() {
        for interface in [Interface::Bonded, Interface::Frictionless] {
            let lower = |thickness| {
                let material = Material::new(3.0, 0.4).unwrap();
                Layer::new(thickness, material, interface).unwrap()
            };
            let whole = OneLayer::new(&lower(1.0), Base::Rigid);
            let cut = Stack::new(&[layer(0.3, 3.0, 0.4), lower(0.7)], Base::Rigid);
            for k in [0.5, 2.0, 5.0, 15.0, 40.0] {
                let (found, wanted) = (cut.minus_one(k), whole.minus_one(k));
                // e^{−2s} magnifies the rounding of s by 2s.
                let bound = 1e-14 * (1.0 + 2.0 * k) * wanted.abs();
                assert!((found - wanted).abs() <= bound, "{k} {found:e} {wanted:e}");
            }
        }
    }

    #[test]
    fn identical_layers_on_the_same_half_space_are_that_half_space() {
        let stack = Stack::new(&vec![layer(0.1, 2.0, 0.3); 200], half_space(2.0, 0.3));
        for k in WAVENUMBERS {
            assert!(stack.minus_one(k).abs() <= 0.0);
            // 200 layers, roundings only
            assert!((stack.value(k) - 1.0).abs() <= 1e-14);
        }
    }

    #[test]
    fn a_thousand_extreme_layers_neither_overflow_nor_vanish() {
        let pair = [layer(0.3, 1e-6, 0.5), layer(0.2, 1e6, 0.0)];
        let stack = Stack::new(&pair.repeat(500), half_space(1.0, 0.3));
        for k in WAVENUMBERS {
            let found = stack.value(k);
            assert!(found.is_finite() && found > 0.0, "{k} {found}");
        }
    }
}
