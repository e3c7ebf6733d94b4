//! One extreme of a stress.

use pellicle_texture::nan_from_null;
use serde::{Deserialize, Serialize};

use crate::result::point;

/// An extreme of a stress: at a point (x, y, z) of a body, or (x, y) of an interface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Extreme<const AXES: usize> {
    /// Value, in Pa.
    #[serde(deserialize_with = "nan_from_null")]
    pub value: f64,
    /// Place, in m.
    #[serde(with = "point")]
    pub at: [f64; AXES],
    /// Whether the value settles as the grid is refined.
    pub resolved: bool,
    /// Half-width of the interval around the value that contains the truth, in Pa; none with a single grid.
    pub estimate: Option<f64>,
}

impl Extreme<2> {
    /// Places the extreme of an interface at a depth (m) in space.
    pub(super) fn at_depth(self, depth: f64) -> Extreme<3> {
        let Self {
            value,
            at: [x, y],
            resolved,
            estimate,
        } = self;
        Extreme {
            value,
            at: [x, y, depth],
            resolved,
            estimate,
        }
    }
}
