//! Pictures of the stresses inside.

mod contour_lines;
mod contour_places;
mod depth_scale;
pub mod extremes;
pub mod interfaces;
pub mod section;
mod section_field;
mod surface_strip;
pub mod view;
