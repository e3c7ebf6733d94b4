//! Cross-crate evidence of correctness: scenes and criteria shared by the test binaries. The example in the workspace's
//! README is compiled and run here as a documentation test.

pub mod bytes;
pub mod convergence;
pub mod coverage;
pub mod scene;

#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
mod readme {}
