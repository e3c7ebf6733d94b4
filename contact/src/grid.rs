//! Parts of a grid on which a problem is solved, and the transfer of fields from a coarse grid to a finer one.

pub mod candidates;
pub mod prolongation;
pub mod region;
