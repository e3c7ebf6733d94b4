//! Panels with axes, ticks and labels, and colour bars.

pub mod colour_bar;
pub mod contour_bands;
pub mod labels;
pub mod panel;
pub mod ticks;
