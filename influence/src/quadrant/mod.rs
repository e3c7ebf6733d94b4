//! A quadrant that stands for the whole surface, where pressure and displacement are their own mirror images in both axes.
//!
//! Every transform is half as long along each axis, and real where it was complex: a product takes a quarter of the time.

mod convolution;
mod operator;
mod plane;
mod symbol_filter;

pub(crate) use convolution::QuadrantConvolution;
pub use operator::QuadrantOperator;
pub use symbol_filter::QuadrantFilter;
