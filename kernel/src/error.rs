//! The one error type of this crate: what was wanted, what was found.

use thiserror::Error;

/// Why a material, a layer or a foundation cannot be built.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum KernelError {
    /// Young's modulus is zero, negative, infinite or not a number.
    #[error("Young's modulus must be positive and finite, got {found}")]
    YoungModulus {
        /// The modulus given, Pa.
        found: f64,
    },
    /// Poisson's ratio lies outside [0, 0.5] or is not a number.
    #[error("Poisson's ratio must lie in [0, 0.5], got {found}")]
    PoissonRatio {
        /// The ratio given.
        found: f64,
    },
    /// The thickness of a layer is zero, negative, infinite or not a number.
    #[error("a layer's thickness must be positive and finite, got {found}")]
    Thickness {
        /// The thickness given, m.
        found: f64,
    },
    /// The normal compliance of an interface is negative, infinite or not a number.
    #[error("an interface's normal compliance must be at least 0 and finite, got {found}")]
    NormalCompliance {
        /// The compliance given, m/Pa.
        found: f64,
    },
    /// The shear compliance of an interface is negative or not a number.
    #[error("an interface's shear compliance must be at least 0, got {found}")]
    ShearCompliance {
        /// The compliance given, m/Pa.
        found: f64,
    },
    /// The thicknesses of all layers together are too large for a number.
    #[error("the thickness of all {layers} layers together must be finite, got {found}")]
    TotalThickness {
        /// How many layers there are.
        layers: usize,
        /// The sum of their thicknesses, m.
        found: f64,
    },
    /// Two bodies that touch differ so much that their ratio cannot be computed with.
    #[error(
        "the moduli of layer {layer} and of what lies below it must have a ratio between \
         {smallest:e} and {largest:e}, got {found:e}"
    )]
    ModulusRatio {
        /// Number of the upper layer, 0 at the surface.
        layer: usize,
        /// Its shear modulus over that of what lies below.
        found: f64,
        /// The smallest ratio accepted.
        smallest: f64,
        /// The largest ratio accepted.
        largest: f64,
    },
    /// A wavenumber is zero, negative, infinite or not a number where a wave is needed.
    #[error("the wavenumber must be positive and finite, got {found}")]
    Wavenumber {
        /// The wavenumber given, 1/m.
        found: f64,
    },
    /// The transformed equations of one layer have no unique solution in floating point.
    #[error("the transformed equations at s = k H = {s:e} are singular")]
    Singular {
        /// Wavenumber times thickness.
        s: f64,
    },
    /// A graded layer was split as finely as allowed and its compliance had not converged.
    #[error(
        "{sublayers} sublayers leave a relative error of {reached:e} in the compliance, wanted {wanted:e}"
    )]
    Grading {
        /// How many sublayers there were.
        sublayers: usize,
        /// Estimated relative error of `C(k)` that halving all of them would leave.
        reached: f64,
        /// The tolerance asked for.
        wanted: f64,
    },
    /// A rigid base without any layer: nothing can deform.
    #[error("a foundation on a rigid base needs at least one elastic layer, got 0")]
    NothingElastic,
}
