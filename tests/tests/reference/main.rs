//! Against high-precision data of others: compliance, influence coefficients, contacts on small grids. Each comparison is seen to fail
//! on what is wrong by little.

mod compliance;
mod discrete;
mod influence;
