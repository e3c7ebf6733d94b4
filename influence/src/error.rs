//! The errors of this crate, with their numbers.

use pellicle_kernel::KernelError;
use thiserror::Error;

/// The reason why coefficients, tables or integrals are not available.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum InfluenceError {
    /// The side of an element is not a finite positive length.
    #[error("found {found} for the side of an element, wanted a positive finite number")]
    ElementSide {
        /// The side given, m.
        found: f64,
    },
    /// A depth above the surface, inside a rigid base, or not a number.
    #[error("found {found} for a depth in the body, wanted 0 to {largest}")]
    Depth {
        /// The depth given, m.
        found: f64,
        /// The largest depth, m; infinite if the base is a half-space.
        largest: f64,
    },
    /// The kernel refuses a body or a wave.
    #[error(transparent)]
    Kernel(#[from] KernelError),
    /// A table of coefficients needs at least one element per side, and no more than fit in memory.
    #[error("found {found} elements per side for a table of coefficients, wanted 1 to {largest}")]
    TableSize {
        /// The requested number of elements per side.
        found: usize,
        /// The largest number of elements per side.
        largest: usize,
    },
    /// A coefficient is NaN or infinite.
    #[error("found {found} for the influence coefficient at offset ({}, {}), wanted a finite number", offset[0], offset[1])]
    CoefficientNotFinite {
        /// The offset in elements.
        offset: [usize; 2],
        /// Its value.
        found: f64,
    },
    /// The integrand was NaN or infinite somewhere.
    #[error(
        "found {value} for the integrand at {at} between {lower} and {upper}, wanted a finite number"
    )]
    IntegrandNotFinite {
        /// The position.
        at: f64,
        /// Its value there.
        value: f64,
        /// Lower end of the interval.
        lower: f64,
        /// Upper end of the interval.
        upper: f64,
    },
    /// An interval that is empty, reversed, or not finite.
    #[error(
        "found {lower} and {upper} for the limits of an integral, wanted finite numbers in ascending order"
    )]
    IntegrationLimits {
        /// Lower end of the interval.
        lower: f64,
        /// Upper end of the interval.
        upper: f64,
    },
    /// The adaptive quadrature used up its intervals before it reached the tolerance.
    #[error(
        "found an estimated error of {found:e} in the integral from {lower} to {upper}, wanted {wanted:e}"
    )]
    QuadratureTolerance {
        /// Lower end of the interval.
        lower: f64,
        /// Upper end of the interval.
        upper: f64,
        /// The requested absolute error.
        wanted: f64,
        /// The estimate of the absolute error reached.
        found: f64,
    },
    /// The direct quadrature of a coefficient oscillates too often to be affordable.
    #[error(
        "found {found} oscillations in the direct quadrature of this coefficient, wanted at most {largest}: use radial tables instead"
    )]
    TooManyOscillations {
        /// Oscillations of the integrand in each of two directions.
        found: f64,
        /// The largest number allowed.
        largest: f64,
    },
    /// The total thickness of the layers is too large for that of the top one.
    #[error(
        "found a total thickness of {found:e} times that of the top layer, wanted at most {largest:e} for radial tables"
    )]
    LayerThicknesses {
        /// Thickness of all layers over that of the top one.
        found: f64,
        /// The largest ratio allowed.
        largest: f64,
    },
    /// The radial tables of this foundation cannot be made accurate enough to be useful.
    #[error(
        "found a relative accuracy of {found:.1e} for the influence coefficients at a radius of {radius:.1e}, wanted {wanted:e}"
    )]
    TableAccuracy {
        /// The largest relative error allowed.
        wanted: f64,
        /// The estimated relative error.
        found: f64,
        /// The radius at which it occurs, m.
        radius: f64,
    },
}
