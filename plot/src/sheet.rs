//! The sheet of a picture: an SVG text with its colours, headings and style, and the PNG or PDF made from it.

pub mod colour_map;
pub mod colours;
pub mod heading;
mod palette;
mod pdf;
mod png;
pub mod raster;
pub mod render;
pub mod style;
pub mod svg;
