//! A plane, pressed on what rises highest.

use super::Profile;

/// A plane without end: `f = 0` everywhere. On a smooth body its contact has no edge; it is for rough and textured
/// ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Plane;

impl Profile for Plane {
    fn height(&self, _x: f64, _y: f64) -> f64 {
        0.0
    }

    fn heights(&self, points: &[[f64; 2]]) -> Vec<f64> {
        vec![0.0; points.len()]
    }

    fn mean_profile(&self, _radius: f64) -> f64 {
        0.0
    }

    fn mean_slope(&self, _radius: f64) -> f64 {
        0.0
    }

    fn is_mirrored(&self) -> bool {
        true
    }
}
