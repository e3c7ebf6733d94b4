//! Displacements and stresses inside the body under a uniformly loaded square element.
//!
//! Waves are [solved for](waves) on a lattice of wavenumbers and summed to [functions of the
//! radius](radial_panels), fifteen for each depth, which give the fields of [point loads](point_kernels). Far from
//! its centre an element has such functions [of its own](under_load). Near it the field is a sum over Gauss points
//! of the element; near the surface this sum is only the smooth correction to the [closed form](homogeneous) for a
//! half-space of the top layer's material. Searches use [rough] stresses, at a fraction of the cost.

mod centre_stresses;
mod depth;
mod element;
mod element_table;
mod homogeneous;
mod layer_compression;
mod log_lattice;
mod parity;
mod plane_fields;
mod point_kernels;
mod principal;
mod radial_panels;
mod rough;
mod state;
mod surface_means;
mod traction_steps;
mod transformed_pressure;
mod under_load;
mod waves;

pub use centre_stresses::CentreStresses;
pub use depth::Depth;
pub use element::{ElementDepths, ElementFields, ElementLoads};
pub use layer_compression::{LayerColumn, LayerCompression};
pub use plane_fields::PlaneFields;
pub use rough::RoughDepths;
pub use state::{SubsurfaceState, SurfaceLoad};
pub use surface_means::SurfaceMeans;
pub use transformed_pressure::Squares;
