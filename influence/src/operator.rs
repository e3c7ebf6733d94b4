//! The product `K p`: by convolution on the whole grid or a quadrant of it, or summed directly.

mod convolution;
mod dense;
mod elastic;
mod spectrum;

pub use convolution::{ConvolutionOperator, QuadrantOperator, WindowOperator};
pub use dense::DenseOperator;
pub use elastic::ElasticOperator;
pub(crate) use spectrum::{QuarterTransform, Spectrum};
