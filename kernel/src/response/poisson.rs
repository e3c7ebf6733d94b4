//! The combinations of Poisson's ratio in the transformed equations.

use crate::Material;

/// Combinations of `ν`, each computed without cancellation for `ν` in [0, 0.5].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Poisson {
    /// `ν`
    pub(crate) nu: f64,
    /// `a = 3 − 4ν`
    pub(crate) a: f64,
    /// `b = 1 − 2ν`; `a = 1 + 2b`
    pub(crate) b: f64,
    /// `w = 2 (1 − ν)`; `a + 1 = 2w`
    pub(crate) w: f64,
    /// `x = 1 / w`
    pub(crate) x: f64,
}

impl Poisson {
    pub(crate) fn new(material: Material) -> Self {
        let nu = material.poisson_ratio();
        let w = 2.0 * (1.0 - nu);
        Self {
            nu,
            a: 3.0 - 4.0 * nu,
            b: 1.0 - 2.0 * nu,
            w,
            x: 1.0 / w,
        }
    }
}
