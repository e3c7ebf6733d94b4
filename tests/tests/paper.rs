//! The paper's statements about its results, each as a test: F. I. Stepanov, E. V. Torskaya, Mech. Solids 57 (2022).
//!
//! Every test solves its cases with the library crates and asserts the verdict and each number in `docs/paper.md`. A
//! statement holds if it is true on every grid, is refuted if it is true on none, and depends on the grid otherwise.
//! The reason for each threshold is given beside it.

mod cases;
mod edges;
mod fields;
mod film;
mod layer_between;
mod loading;
mod numbers;
mod refinement;
mod rounded;
mod section;
