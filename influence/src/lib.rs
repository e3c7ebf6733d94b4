//! Influence coefficients.
mod chebyshev;
mod coefficient_table;
mod column_block;
mod convolution;
mod dense;
mod edges;
mod error;
mod gauss;
pub mod love;
mod near;
mod operator;
mod padding;
mod panels;
mod product_rule;
mod radial;
mod radial_tables;
mod response;
mod spectrum;
mod window;

pub use coefficient_table::CoefficientTable;
pub use convolution::ConvolutionOperator;
pub use dense::DenseOperator;
pub use error::InfluenceError;
pub use operator::ElasticOperator;
pub use radial_tables::RadialTables;
