//! The kinds of steps that the loop chooses from, one file each, and their common parts.

pub mod conjugate;
pub mod face;
pub mod newton;
pub mod projection;
pub mod segment;
pub mod spectral;
pub mod stiffness;
