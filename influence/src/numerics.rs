//! Expansions, quadrature and sums, independent of elasticity.

pub(crate) mod chebyshev;
pub(crate) mod chebyshev_panels;
pub(crate) mod quadrature;
pub(crate) mod rounding;
