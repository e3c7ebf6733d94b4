//! Displacements and stresses inside the body under a uniformly loaded square element.
//!
//! In the top layer the fields are those of a half-space of its material, in [closed form](homogeneous), and what the
//! layers change, which is smooth; below it they are smooth altogether. What is smooth comes from
//! [point loads](point_kernels), whose fields are fifteen functions of the radius for each depth, summed
//! [over the element](element) by Gauss points.

mod element;
mod element_table;
mod homogeneous;
mod loaded_grid;
mod log_lattice;
mod plane;
mod point_kernels;
mod state;

pub use element::{ElementFields, ElementLoads, SurfaceLoad};
pub use loaded_grid::{LoadedGrid, Squares};
pub use plane::Plane;
pub use state::SubsurfaceState;
