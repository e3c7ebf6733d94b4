//! The look of pictures.

use super::colour_map::ColourMap;
use super::heading;
use super::svg::{Frame, Svg};

/// The options of a picture's look.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Style {
    /// Width on the screen and of the PNG, in pixels; by default that of the drawing.
    pub width: Option<f64>,
    /// Whether there is a heading.
    pub heading: Heading,
    /// The colours of a map.
    pub colours: ColourMap,
    /// Ends of the scale of pressures, Pa; by default 0 and the largest.
    pub pressures: Option<[f64; 2]>,
    /// The place of the section.
    pub cut: Cut,
}

/// Whether a picture has the lines above it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Heading {
    /// It has.
    #[default]
    Shown,
    /// It has not, nor room for them.
    Hidden,
}

/// The place of a section.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Cut {
    /// Along x, through the axis.
    #[default]
    Axis,
    /// Along x, through the largest pressure.
    Peak,
    /// Along x at this y, m.
    AlongX(f64),
    /// Along y at this x, m.
    AlongY(f64),
}

/// Room left above a picture without heading, in pixels: labels reach a little above their ticks.
const ABOVE: f64 = 16.0;

impl Style {
    /// A white sheet for a picture of this width and height, heading included.
    #[must_use]
    pub fn sheet(&self, width: f64, height: f64) -> Svg {
        let top = match self.heading {
            Heading::Shown => 0.0,
            Heading::Hidden => heading::HEIGHT - ABOVE,
        };
        Svg::framed(&Frame {
            width,
            height,
            top,
            shown_width: self.width.unwrap_or(width),
        })
    }
}
