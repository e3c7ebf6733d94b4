//! The subject of a picture: one loading step.

use pellicle::display::{self, DisplayUnit, Unit};
use pellicle::input::units::Units;

use crate::sheet::colour_map::ColourScale;
use crate::sheet::heading;
use crate::sheet::style::{Heading, Style};
use crate::sheet::svg::Svg;
use pellicle::result::fields::Fields;

/// One loading step: its fields, and what the heading says of it.
#[derive(Debug, Clone)]
pub struct Subject<'a> {
    /// First line of the heading: the title of the case.
    pub title: &'a str,
    /// Second line: force, penetration and largest pressure, and a mark if the step is not certified.
    pub numbers: String,
    /// Third line: grid, certificate, grid error.
    pub accuracy: String,
    /// Units of the case.
    pub units: Units,
    /// Height of the relief above the surface of the body, m, if it is uniform.
    pub relief_height: Option<f64>,
    /// Its fields.
    pub fields: Fields<'a>,
    /// Style of the picture.
    pub style: Style,
}

impl Subject<'_> {
    /// The coordinates of a point with their units.
    #[must_use]
    pub fn position<const AXES: usize>(&self, at: [f64; AXES]) -> String {
        display::position(at, self.fields.element_side(), self.units)
    }

    /// Draws the heading, if the style shows one; `more` is appended to the numbers.
    pub fn draw_heading(&self, svg: &mut Svg, left: f64, width: f64, more: &str) {
        if self.style.heading == Heading::Shown {
            let numbers = format!("{}{more}", self.numbers);
            heading::draw(svg, left, width, self.title, &numbers);
            heading::draw_accuracy(svg, left, &self.accuracy);
        }
    }

    /// The largest pressure, Pa; 0 without contact.
    #[must_use]
    pub fn largest_pressure(&self) -> f64 {
        self.fields.pressure.iter().copied().fold(0.0, f64::max)
    }

    /// Returns the scale for lengths up to this one.
    #[must_use]
    pub fn metres(&self, largest: f64) -> DisplayUnit {
        DisplayUnit::of(largest, Unit::Metre, self.units)
    }

    /// Returns the scale of the pressures and their colours in its unit: over the range of the style, or from 0 to the
    /// largest pressure, or to 1 without contact.
    #[must_use]
    pub fn pressures(&self) -> (DisplayUnit, ColourScale) {
        let [from, to] = (self.style.pressures).unwrap_or([0.0, self.largest_pressure()]);
        let scale = DisplayUnit::of(to, Unit::Pascal, self.units);
        let [from, to] = [from, to].map(|end| end / scale.divisor);
        let (from, to) = if from < to && to.is_finite() {
            (from, to)
        } else {
            (0.0, 1.0)
        };
        let map = self.style.colours;
        (scale, ColourScale { map, from, to })
    }
}
