//! How pictures are to look.

use super::colour_map::ColourMap;
use super::heading;
use super::svg::{Frame, Svg};

/// What may be ordered of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Style {
    /// Width on the screen and of the PNG, in pixels; that of the drawing unless given.
    pub width: Option<f64>,
    /// Whether the lines above a picture are there.
    pub heading: Heading,
    /// The colours of a map.
    pub colours: ColourMap,
    /// Ends of the scale of pressures, Pa; from 0 to the largest unless given.
    pub pressures: Option<[f64; 2]>,
    /// Where a section is.
    pub cut: Cut,
}

/// Whether the lines above a picture are there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Heading {
    /// They are.
    #[default]
    Shown,
    /// They are not, nor is their room.
    Hidden,
}

/// Where a section is.
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

/// What stays above a picture without heading, in pixels: labels reach a little higher than what they stand at.
const ABOVE: f64 = 16.0;

impl Style {
    /// A white sheet for a picture of this width and height, which begins below a heading.
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
