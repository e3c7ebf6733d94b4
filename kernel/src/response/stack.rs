//! `Φ` of any number of layers: the minors carried upward, layer by layer.

use super::contrast::Contrast;
use super::decay::Decay;
use super::junction::Junction;
use super::minors::Minors;
use super::poisson::Poisson;
use crate::{Base, Layer};

/// Layers prepared for the recursion, the lowest first.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Stack {
    steps: Vec<LayerStep>,
    base: Minors,
    surface: Poisson,
}

/// One layer and what it stands on.
#[derive(Debug, Clone, Copy, PartialEq)]
struct LayerStep {
    thickness: f64,
    poisson: Poisson,
    junction: Junction,
}

/// Minors are scaled back to 1 when they leave this range or its inverse: products of a few
/// layers of the largest ratio, 1e30, cannot overflow from inside it.
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
                poisson: Poisson::new(layer.material()),
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
            minors = step.junction.minors(&minors).through(&step.poisson, &decay);
            let magnitude = minors.magnitude();
            if !(1.0 / LARGE..=LARGE).contains(&magnitude) {
                minors = minors.scaled(1.0 / magnitude);
            }
        }
        minors.g / (self.surface.w * minors.d)
    }

    /// `Φ − 1 = c₄ / (w d)` on the surface.
    pub(crate) fn minus_one(&self, wavenumber: f64) -> f64 {
        let (mut minors, mut contrast) = (self.base, Contrast::NONE);
        for step in &self.steps {
            let decay = Decay::new(wavenumber * step.thickness);
            contrast = step
                .junction
                .contrast(&minors, &contrast)
                .through(&step.poisson, &decay);
            minors = step.junction.minors(&minors).through(&step.poisson, &decay);
            let magnitude = minors.magnitude();
            if !(1.0 / LARGE..=LARGE).contains(&magnitude) {
                minors = minors.scaled(1.0 / magnitude);
                contrast = contrast.scaled(1.0 / magnitude);
            }
        }
        let half = self.surface.w * minors.d;
        if (minors.g - half).abs() > 0.25 * (minors.g + half) { return minors.g / half - 1.0; }
        contrast.c4 / half
    }
}
