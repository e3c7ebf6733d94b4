//! Displacements and stresses inside the body under a uniformly loaded square element.
//!
//! Near the surface each field is the [closed form](homogeneous) of a half-space of the top layer's material plus a
//! smooth correction for the layers; deeper down the whole field is smooth. The smooth part is summed [over the
//! element](element) by Gauss points from the fields of [point loads](point_kernels), fifteen functions of the radius
//! for each depth.

mod centre_stresses;
mod depth;
mod element;
mod element_table;
mod homogeneous;
mod log_lattice;
mod panels;
mod parity;
mod plane_fields;
mod point_kernels;
mod pressed;
mod principal;
mod state;
mod under_load;
mod waves;

pub use centre_stresses::CentreStresses;
pub use depth::Depth;
pub use element::{ElementFields, ElementLoads};
pub use plane_fields::PlaneFields;
pub use pressed::Squares;
pub use state::{SubsurfaceState, SurfaceLoad};
