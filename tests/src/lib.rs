//! Cross-crate evidence that Pellicle is right. The evidence stands in this package's `tests/`; the library holds only
//! the example of the workspace's README, compiled and run as a documentation test.

#[cfg(doctest)]
mod readme;
