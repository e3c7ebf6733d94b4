//! Pictures of a run as a whole.

pub mod area_law;
pub mod convergence;
pub mod curve;
pub mod spectrum;
pub mod wear;
