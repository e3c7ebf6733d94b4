//! Pictures of a solution, readable in print and by the colour-blind: each is drawn as SVG and rendered from that to
//! PNG.

pub mod axis;
pub mod coarse;
pub mod colour_bar;
pub mod colour_map;
pub mod colours;
pub mod convergence;
pub mod curve;
pub mod field_map;
pub mod heading;
pub mod number;
pub mod outline;
pub mod palette;
pub mod panel;
pub mod png;
pub mod pressure_map;
pub mod pressure_view;
pub mod projection;
pub mod raster;
pub mod scene;
pub mod section;
pub mod skyline;
pub mod style;
pub mod subject;
pub mod svg;
pub mod ticks;
pub mod trust;
pub mod window;

#[cfg(test)]
mod tests;
