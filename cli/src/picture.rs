//! What turns results into the plain numbers of their pictures, which the crate `pellicle-plot` draws.

pub mod accuracy;
pub mod area_law;
pub mod convergence;
pub mod curve;
pub mod extremes;
pub mod found;
pub mod histograms;
pub mod spectrum;
pub mod study;
pub mod subject;
pub mod wear;
