//! Tests of more than one crate: convergence, laws, stresses, the program, and the claims of the paper.

mod bytes;
mod convergence;
mod layers;
mod paper;
mod program;
mod property;
mod stress;
