//! The subject of a picture: one loading step.

use super::accuracy;
use super::colour_map::ColourScale;
use super::heading;
use super::style::{Heading, Style};
use super::svg::Svg;
use crate::display::{self, DisplayUnit, Unit};
use crate::input::units::Units;
use crate::output::fields::Fields;
use crate::output::summary::{RunSummary, StepSummary};

/// One loading step: its numbers and its fields.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// Title of the case.
    pub title: &'a str,
    /// Units of the case.
    pub units: Units,
    /// Height of the relief above the surface of the body, m, if it is uniform.
    pub relief_height: Option<f64>,
    /// Its numbers.
    pub step: &'a StepSummary,
    /// Its fields.
    pub fields: Fields<'a>,
    /// Style of the picture.
    pub style: Style,
}

impl<'a> Subject<'a> {
    /// A step of a run.
    #[must_use]
    pub fn of(
        run: &'a RunSummary,
        step: &'a StepSummary,
        fields: Fields<'a>,
        style: Style,
    ) -> Self {
        Self {
            title: &run.title,
            units: run.units,
            relief_height: run.relief_height(),
            step,
            fields,
            style,
        }
    }

    /// The second line of a heading: force, penetration, largest pressure, and a mark if the step is not certified.
    #[must_use]
    pub fn numbers(&self) -> String {
        let quantity = |value, unit| display::quantity(value, unit, self.units);
        let mark = self.step.mark();
        let mark = mark.map_or(String::new(), |mark| format!("{mark}:  "));
        format!(
            "{mark}Q = {},  D = {},  largest p = {}",
            quantity(self.step.force, Unit::Newton),
            quantity(self.step.penetration, Unit::Metre),
            quantity(self.step.summary.max_pressure, Unit::Pascal),
        )
    }

    /// The coordinates of a point with their units.
    #[must_use]
    pub fn position<const AXES: usize>(&self, at: [f64; AXES]) -> String {
        display::position(at, self.fields.element_side(), self.units)
    }

    /// Draws the heading, if the style shows one; `more` is appended to the numbers.
    pub fn draw_heading(&self, svg: &mut Svg, left: f64, width: f64, more: &str) {
        if self.style.heading == Heading::Shown {
            let numbers = self.numbers() + more;
            heading::draw(svg, left, width, self.title, &numbers);
            heading::draw_accuracy(svg, left, &self.accuracy());
        }
    }

    /// The third line of a heading: grid, certificate, grid error.
    #[must_use]
    pub fn accuracy(&self) -> String {
        accuracy::of_step(self.fields.size, self.step)
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
