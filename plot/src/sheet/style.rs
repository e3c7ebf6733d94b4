//! Style of the pictures.

use crate::sheet::colour_map::ColourMap;
use crate::sheet::heading;
use crate::sheet::svg::{Frame, Svg};

/// Options for the style of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Style {
    /// Width on the screen and of the PNG, in pixels; by default the width of the drawing.
    pub width: Option<f64>,
    /// Width on paper, in millimetres; by default a picture has a width in pixels.
    pub paper_mm: Option<f64>,
    /// Whether the heading is shown.
    pub heading: Heading,
    /// The colour map.
    pub colours: ColourMap,
    /// Ends of the scale of pressures, Pa; by default 0 and the largest pressure.
    pub pressures: Option<[f64; 2]>,
    /// The place of the section; by default through the axis.
    pub cut: Option<Cut>,
}

/// Whether a picture has a heading.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Heading {
    /// The heading is shown.
    #[default]
    Shown,
    /// Neither the heading nor the space for it.
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

/// Space left above a picture without heading, in pixels: labels reach a little above their ticks.
const ABOVE: f64 = 16.0;

/// Pixels of a sheet for a millimetre of paper: letters of 17 pixels are then 8 points high.
const PER_MILLIMETRE: f64 = 6.0;

/// Width of a picture drawn for paper, unless it is given, in millimetres: one and a half columns of a journal.
const PAPER_MM: f64 = 120.0;

impl Style {
    /// The width of a drawing made for paper, in pixels of the sheet; its letters have the same size at any width.
    #[must_use]
    pub fn drawn_width(&self) -> f64 {
        PER_MILLIMETRE * self.paper_mm.unwrap_or(PAPER_MM)
    }

    /// Returns a white sheet for a picture of this width and height, which includes the heading.
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
            shown_width: self.paper_mm.or(self.width).unwrap_or(width),
            unit: if self.paper_mm.is_some() { "mm" } else { "" },
        })
    }
}
