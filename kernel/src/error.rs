//! The error type of this crate, with the values found and wanted.

use thiserror::Error;

/// Reasons why a material, a layer or a foundation cannot be built.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum KernelError {
    /// Young's modulus is zero, negative, infinite or not a number.
    #[error("found {found} for Young's modulus, wanted a positive finite number")]
    YoungModulus {
        /// The modulus given, Pa.
        found: f64,
    },
    /// Poisson's ratio lies outside [0, 0.5] or is not a number.
    #[error("found {found} for Poisson's ratio, wanted a number in [0, 0.5]")]
    PoissonRatio {
        /// The ratio given.
        found: f64,
    },
    /// The thickness of a layer is zero, negative, infinite or not a number.
    #[error("found {found} for a layer's thickness, wanted a positive finite number")]
    Thickness {
        /// The thickness given, m.
        found: f64,
    },
    /// The normal compliance of an interface is negative, infinite or not a number.
    #[error(
        "found {found} for an interface's normal compliance, wanted a finite number of zero or more"
    )]
    NormalCompliance {
        /// The compliance given, m/Pa.
        found: f64,
    },
    /// The shear compliance of an interface is negative or not a number.
    #[error("found {found} for an interface's shear compliance, wanted zero or more")]
    ShearCompliance {
        /// The compliance given, m/Pa.
        found: f64,
    },
    /// The total thickness of all layers overflows.
    #[error("found {found} for the total thickness of {layers} layers, wanted a finite number")]
    TotalThickness {
        /// Number of layers.
        layers: usize,
        /// The sum of their thicknesses, m.
        found: f64,
    },
    /// The moduli of two adjacent bodies differ too much to compute with their ratio.
    #[error(
        "found {found:e} for the ratio of the shear modulus of layer {layer} to that of the body below it, \
         wanted {smallest:e} to {largest:e}"
    )]
    ModulusRatio {
        /// Number of the upper layer, 0 at the surface.
        layer: usize,
        /// Its shear modulus over that of the body below.
        found: f64,
        /// The smallest ratio accepted.
        smallest: f64,
        /// The largest ratio accepted.
        largest: f64,
    },
    /// A wavenumber is zero, negative, infinite or not a number where a wave is required.
    #[error("found {found} for the wavenumber, wanted a positive finite number")]
    Wavenumber {
        /// The wavenumber given, 1/m.
        found: f64,
    },
    /// The transformed equations of one layer have no unique solution in floating point.
    #[error("found singular transformed equations at s = k H = {s:e}, wanted a unique solution")]
    Singular {
        /// Wavenumber times thickness.
        s: f64,
    },
    /// A graded layer was split as finely as allowed, but its compliance had not converged.
    #[error(
        "found a relative error of {reached:e} in the compliance with {sublayers} sublayers, wanted {wanted:e}"
    )]
    Grading {
        /// Number of sublayers.
        sublayers: usize,
        /// Estimated relative error of `C(k)` that would remain after halving all of them.
        reached: f64,
        /// The requested tolerance.
        wanted: f64,
    },
    /// A parameter of a body that does not exist or does not have this parameter.
    #[error(
        "found body {found}, which does not have this parameter, wanted a layer (0 to {layers}, exclusive) or the elastic half-space below"
    )]
    NoBody {
        /// The requested body, from 0 at the surface.
        found: usize,
        /// Number of layers.
        layers: usize,
    },
    /// A rigid base without any layer: nothing can deform.
    #[error("found no elastic layer on a rigid base, wanted at least one")]
    NothingElastic,
}
