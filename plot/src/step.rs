//! Pictures of one loading step.

pub mod coarse_field;
mod column_view;
pub mod crop;
pub mod field_map;
pub mod histograms;
mod outline;
pub mod panel_3d;
pub mod pressure_map;
pub mod pressure_view;
pub mod projection;
pub mod section;
pub mod subject;
pub mod surface_figure;
