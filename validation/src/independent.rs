//! Independent solutions for axisymmetric stress: no grid, no elements, no transform of the other crates.
//!
//! They start from the kernel's amplitudes of single waves, which are tested separately, and share nothing else with
//! the code that they check. Pressures come from the integral equation of [`pellicle_contact::axisymmetric`], which
//! shares only `Φ` with the solvers on grids, fields from [`hankel`]'s integrals.

pub mod hankel;
