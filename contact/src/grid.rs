//! Parts of a grid: the elements a problem is solved on, and how fields pass from a coarse grid to a finer one.

pub mod candidates;
pub mod prolongation;
pub mod window;
