//! Pictures of a run as a whole.

pub mod convergence;
pub mod curve;
pub mod spectrum;
