//! A depth in the body, on one side of an interface if it lies on one.

use pellicle_kernel::{Base, Foundation, Layer, Side};

use crate::error::InfluenceError;

/// A depth in the body. On an interface it belongs to the body on one side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth {
    /// Distance below the surface, m.
    pub z: f64,
    /// The body to which it belongs if it lies on an interface.
    pub side: Side,
}

impl Depth {
    /// The body at depth `z` (m), or above the interface there.
    #[must_use]
    pub fn above(z: f64) -> Self {
        Self {
            z,
            side: Side::Above,
        }
    }

    /// The body at depth `z` (m), or below the interface there.
    #[must_use]
    pub fn below(z: f64) -> Self {
        Self {
            z,
            side: Side::Below,
        }
    }

    /// Whether the depth lies above an interface at depth `bottom` (m), or on its upper side.
    #[must_use]
    pub fn is_above(&self, bottom: f64) -> bool {
        self.z < bottom || (self.z <= bottom && self.side == Side::Above)
    }

    /// Whether the fields are split into a half-space of the top layer's material and the layers' correction.
    ///
    /// In the lower half of a layer both parts would be large where a stiff coating leaves little stress, and the
    /// fields themselves are smooth over a distance of the depth.
    pub(super) fn is_split(&self, foundation: &Foundation) -> bool {
        let top = foundation.layers().first();
        top.is_none_or(|top| self.z < top.thickness() / 2.0)
    }

    /// Whether the body is held from below along the surface, with no frictionless interface in between.
    pub(super) fn is_held_laterally(&self, foundation: &Foundation) -> bool {
        let layers = foundation.layers().iter().enumerate();
        let mut slides = layers.filter(|(_, layer)| layer.interface().is_frictionless());
        !slides.any(|(i, _)| self.is_above(foundation.interface_depth(i + 1)))
    }

    /// Returns an error for a depth outside the body.
    pub(super) fn check(&self, foundation: &Foundation) -> Result<(), InfluenceError> {
        let largest = match foundation.base() {
            Base::HalfSpace(_) => f64::INFINITY,
            Base::Rigid => foundation.layers().iter().map(Layer::thickness).sum(),
        };
        if self.z >= 0.0 && self.z <= largest && self.z.is_finite() {
            return Ok(());
        }
        Err(InfluenceError::Depth {
            found: self.z,
            largest,
        })
    }
}
