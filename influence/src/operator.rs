//! The product `K p`: by convolution on the whole grid, on a half or a quadrant of it, on a periodic cell, among
//! scattered elements, or summed directly.

mod convolution;
mod dense;
mod elastic;
mod periodic;
mod scattered;
mod spectrum;

pub use convolution::{ConvolutionOperator, WindowOperator};
pub use dense::DenseOperator;
pub use elastic::ElasticOperator;
pub use periodic::PeriodicOperator;
pub use scattered::{ScatteredOperator, scattered_work};
pub(crate) use spectrum::{QuarterTransform, Spectrum};
