//! Plans of fast Fourier transforms, compiled once for all crates.
//!
#![doc = include_str!("../README.md")]

use std::sync::Arc;

pub use realfft::{ComplexToReal, RealToComplex};
pub use rustfft::num_complex::{Complex, Complex64};
pub use rustfft::{Fft, FftNum};

use realfft::RealFftPlanner;
use rustfft::FftPlanner;

/// A number whose transforms are compiled here.
///
/// Transforms are not normalised: a transform there and back multiplies by the length. Errors are a few times the
/// rounding of the type.
pub trait Transformed: FftNum {
    /// The transform with the sign `exp(−2πi jk/n)` of this length n.
    fn forward(length: usize) -> Arc<dyn Fft<Self>>;

    /// The transform with the sign `exp(2πi jk/n)` of this length n.
    fn inverse(length: usize) -> Arc<dyn Fft<Self>>;

    /// That of this many real numbers, to the first half of the frequencies and the middle one.
    fn real_forward(length: usize) -> Arc<dyn RealToComplex<Self>>;

    /// Its inverse.
    fn real_inverse(length: usize) -> Arc<dyn ComplexToReal<Self>>;
}

macro_rules! transformed {
    ($number:ty) => {
        // Not inlined: that would compile the transforms again where they are planned.
        impl Transformed for $number {
            #[inline(never)]
            fn forward(length: usize) -> Arc<dyn Fft<Self>> {
                FftPlanner::new().plan_fft_forward(length)
            }

            #[inline(never)]
            fn inverse(length: usize) -> Arc<dyn Fft<Self>> {
                FftPlanner::new().plan_fft_inverse(length)
            }

            #[inline(never)]
            fn real_forward(length: usize) -> Arc<dyn RealToComplex<Self>> {
                RealFftPlanner::new().plan_fft_forward(length)
            }

            #[inline(never)]
            fn real_inverse(length: usize) -> Arc<dyn ComplexToReal<Self>> {
                RealFftPlanner::new().plan_fft_inverse(length)
            }
        }
    };
}

transformed!(f32);
transformed!(f64);
