//! Cross-crate evidence that Pellicle is right: the scenes that the test binaries share. The example of the workspace's
//! README is compiled and run here as a documentation test.

pub mod convergence;
pub mod coverage;
pub mod paper;
#[cfg(doctest)]
mod readme;
pub mod scene;
