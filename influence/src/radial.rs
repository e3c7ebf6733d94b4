//! From the response to influence coefficients: two functions of the radius, and their integrals over an element.

mod derivative;
mod element_integrals;
mod far_field;
mod functions;
mod hankel;
mod precise;
mod sampler;
mod tables;
mod tabulate;

pub use derivative::CoefficientDerivative;
pub(crate) use functions::RadialFunctions;
pub use tables::RadialTables;
pub(crate) use tables::accurate_functions;
