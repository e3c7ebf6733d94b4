//! A modulus from each contact alone over the contact depth: exactly for the layered body, and by a formula for a
//! homogeneous one, with the interval of all contacts together.

use pellicle::display::{DisplayUnit, Unit};
use pellicle::input::units::Units;

use super::axes;
use super::heading::FitHeading;
use crate::axes::panel::Panel;
use crate::sheet::colours::{self, Colour};
use crate::sheet::heading;
use crate::sheet::style::{Heading, Style};
use crate::sheet::svg::{Anchor, Rect, Stroke, Svg};

const PLACE: Rect = Rect::at((112.0, heading::HEIGHT + 8.0), (840.0, 460.0));
const WIDTH: f64 = PLACE.left + PLACE.width + 36.0;
/// Height of a line of the legend, and distance of the legend below the panel.
const ENTRY: f64 = 28.0;
const LEGEND: f64 = 86.0;
const BAND: Colour = Colour(205, 226, 240);

/// A contact: its depth (m) and a modulus (Pa) with its standard uncertainty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModulusAtDepth {
    /// The contact depth, m.
    pub depth: f64,
    /// The modulus, Pa.
    pub modulus: f64,
    /// Its standard uncertainty, Pa.
    pub sd: f64,
}

/// The moduli of all contacts.
#[derive(Debug, Clone, PartialEq)]
pub struct Moduli {
    /// The heading.
    pub head: FitHeading,
    /// Name of the modulus that is sought.
    pub name: String,
    /// From each contact alone, exactly for the layered body.
    pub exact: Vec<ModulusAtDepth>,
    /// By the formula for a homogeneous body.
    pub formula: Vec<ModulusAtDepth>,
    /// The interval of all contacts together, Pa, where it closes.
    pub interval: [Option<f64>; 2],
}

impl Moduli {
    /// Draws the picture as SVG; `None` without a contact.
    #[must_use]
    pub fn draw(&self, style: &Style) -> Option<String> {
        let all = || self.exact.iter().chain(&self.formula);
        let x = axes::ends(all().map(|of| of.depth).chain([0.0]))?;
        let ends = self.interval.into_iter().flatten();
        let y = axes::ends(all().map(|of| of.modulus).chain(ends))?;
        if self.exact.is_empty() {
            return None;
        }
        let depth = DisplayUnit::of(x[1], Unit::Metre, Units::Si);
        let modulus = DisplayUnit::of(y[1], Unit::Pascal, Units::Si);
        let panel = Panel {
            place: PLACE,
            x: axes::linear(x, &depth, "contact depth h_c", 6),
            y: axes::linear([0.0, y[1]], &modulus, "Young's modulus", 6),
        };
        let mut svg = style.sheet(WIDTH, PLACE.bottom() + LEGEND + 3.0 * ENTRY);
        if style.heading == Heading::Shown {
            let FitHeading { title, numbers } = &self.head;
            heading::draw(&mut svg, PLACE.left, WIDTH - PLACE.left, title, numbers);
        }
        let scaled = |depth_of: f64, of: f64| (depth_of / depth.divisor, of / modulus.divisor);
        if let [Some(low), Some(high)] = self.interval {
            let corners = [(x[0], low), (x[1], low), (x[1], high), (x[0], high)];
            let corners = panel.all_at(corners.map(|(h, e)| scaled(h, e)));
            svg.within(PLACE, |svg| svg.area(&corners, BAND));
        }
        panel.draw_mesh(&mut svg);
        let draw = |svg: &mut Svg, points: &[ModulusAtDepth], colour| {
            for of in points {
                let bar = [of.modulus - of.sd, of.modulus + of.sd].map(|end| scaled(of.depth, end));
                svg.line(&panel.all_at(bar), Stroke::new(colour, 2.0));
            }
            let centres = points.iter().map(|of| scaled(of.depth, of.modulus));
            svg.dots(&panel.all_at(centres), 5.0, colour);
        };
        svg.within(PLACE, |svg| {
            draw(svg, &self.formula, colours::ORANGE);
            draw(svg, &self.exact, colours::BLUE);
        });
        panel.draw_axes(&mut svg);
        let exact = format!("{} on the layered body, from each contact alone", self.name);
        for (line, (colour, words)) in [
            (colours::BLUE, exact.as_str()),
            (
                colours::ORANGE,
                "Oliver and Pharr's, as if the body were homogeneous",
            ),
            (BAND, "95 % interval of all contacts together"),
        ]
        .into_iter()
        .enumerate()
        {
            let y = PLACE.bottom() + LEGEND + ENTRY * line as f64;
            svg.dots(&[(PLACE.left + 14.0, y)], 6.0, colour);
            svg.text((PLACE.left + 34.0, y), 16.0, Anchor::Start, words);
        }
        Some(svg.finish())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_names_both_moduli_and_needs_a_contact() {
        let at = |depth: f64, modulus: f64| ModulusAtDepth {
            depth,
            modulus,
            sd: 1e9,
        };
        let mut moduli = Moduli {
            head: FitHeading {
                title: "oxide".into(),
                numbers: "2 contacts".into(),
            },
            name: "Young's modulus of layer 0".into(),
            exact: vec![at(2e-8, 70e9), at(2e-7, 71e9)],
            formula: vec![at(2e-8, 75e9), at(2e-7, 119e9)],
            interval: [Some(69e9), Some(72e9)],
        };
        let svg = moduli.draw(&Style::default()).unwrap();
        assert!(svg.contains("layer 0 on the layered body") && svg.contains("Oliver and Pharr"));
        moduli.exact.clear();
        assert!(moduli.draw(&Style::default()).is_none());
    }
}
