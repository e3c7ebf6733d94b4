//! The response `Φ(k)` of a foundation, by the method that suits it.

pub(crate) mod contrast;
mod decay;
mod junction;
pub(crate) mod minors;
mod one_layer;
mod spring;
mod stack;

use crate::{Base, Interface, Layer};
pub(crate) use minors::Minors;
pub(crate) use one_layer::OneLayer;
pub(crate) use spring::ComplianceShare;
pub(crate) use stack::{BottomSupport, Stack};

/// The constants from which `Φ` is evaluated, prepared once per foundation.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Response {
    /// A half-space alone: `Φ = 1`.
    HalfSpace,
    /// One layer, bonded or frictionless, on any base: the closed form.
    OneLayer(OneLayer),
    /// Two layers or more, or one on a spring: the recursion.
    Stack(Stack),
}

impl Response {
    pub(crate) fn new(layers: &[Layer], base: Base) -> Self {
        match layers {
            [] => Self::HalfSpace,
            [layer] if !matches!(layer.interface(), Interface::Spring(_)) => {
                Self::OneLayer(OneLayer::new(layer, base))
            }
            layers => Self::Stack(Stack::new(layers, base)),
        }
    }

    /// `Φ(k)`, `k > 0` in 1/m.
    pub(crate) fn value(&self, wavenumber: f64) -> f64 {
        match self {
            Self::HalfSpace => 1.0,
            Self::OneLayer(layer) => layer.value(wavenumber),
            Self::Stack(stack) => stack.value(wavenumber),
        }
    }

    /// `Φ(k) − 1`, `k > 0` in 1/m.
    pub(crate) fn minus_one(&self, wavenumber: f64) -> f64 {
        match self {
            Self::HalfSpace => 0.0,
            Self::OneLayer(layer) => layer.minus_one(wavenumber),
            Self::Stack(stack) => stack.minus_one(wavenumber),
        }
    }
}
