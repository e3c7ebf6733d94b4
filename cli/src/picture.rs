//! Pictures of a solution, readable in print and by the colour-blind. Each is drawn as SVG and rendered from it as PNG.

pub mod accuracy;
pub mod coarse_field;
pub mod colour_bar;
pub mod colour_map;
pub mod colours;
pub mod column_view;
pub mod contour_bands;
pub mod contour_lines;
pub mod contour_places;
pub mod convergence;
pub mod crop;
pub mod curve;
pub mod depth_scale;
pub mod field_map;
pub mod fit;
pub mod heading;
pub mod histograms;
pub mod labels;
pub mod outline;
pub mod palette;
pub mod panel;
pub mod panel_3d;
pub mod png;
pub mod pressure_map;
pub mod pressure_view;
pub mod projection;
pub mod raster;
pub mod render;
pub mod section;
pub mod section_field;
pub mod spectrum;
pub mod stress_interfaces;
pub mod stress_section;
pub mod style;
pub mod subject;
pub mod surface_strip;
pub mod svg;
pub mod ticks;

#[cfg(test)]
mod tests;
