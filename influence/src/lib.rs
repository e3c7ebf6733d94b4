//! Influence coefficients.
mod coefficient_table;
mod column_block;
mod convolution;
mod dense;
mod edges;
mod error;
mod gauss;
pub mod love;
mod operator;
mod padding;
mod product_rule;
mod spectrum;

pub use coefficient_table::CoefficientTable;
pub use convolution::ConvolutionOperator;
pub use dense::DenseOperator;
pub use error::InfluenceError;
pub use operator::ElasticOperator;
