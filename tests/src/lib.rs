//! Cross-crate evidence that Pellicle is right: scenes and judgements that the test binaries share. The example of the
//! workspace's README is compiled and run here as a documentation test.

pub mod convergence;
pub mod coverage;
pub mod figure_2;
pub mod scene;

#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
mod readme {}
