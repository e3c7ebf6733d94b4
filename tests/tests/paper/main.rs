//! The paper's sentences about its results, each a test: F. I. Stepanov, E. V. Torskaya, Mech. Solids 57 (2022).
//!
//! Every test solves its cases with the library crates and asserts the verdict and each number that `docs/claims.md`
//! gives. A sentence holds if it is true on every grid, is refuted if it is true on none, and depends on the grid
//! otherwise. Thresholds have their reason beside them.

mod cases;
mod edges;
mod fields;
mod film;
mod layer_between;
mod loading;
mod numbers;
mod refinement;
mod section;
