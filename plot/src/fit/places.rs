//! A map of one number over the places where it was measured.

use pellicle::display::DisplayUnit;

use super::axes;
use super::heading::FitHeading;
use crate::axes::panel::Panel;
use crate::axes::{colour_bar, labels};
use crate::sheet::colour_map::ColourScale;
use crate::sheet::colours;
use crate::sheet::heading;
use crate::sheet::style::{Heading, Style};
use crate::sheet::svg::{Rect, Stroke, Svg};

/// The rectangle of the map, in pixels.
const MAP: Rect = Rect::at((112.0, heading::HEIGHT + 24.0), (640.0, 640.0));
const BELOW: f64 = 72.0;
const GAP: f64 = 28.0;
const BAR: f64 = 30.0;
const WIDTH: f64 = MAP.left + MAP.width + GAP + BAR + colour_bar::BESIDE;
const HEIGHT: f64 = MAP.top + MAP.height + BELOW;
/// The sides of the square of a place, in pixels: as large as its distance from the next, within these.
const SQUARE: [f64; 2] = [6.0, 90.0];

/// A number over places.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacesMap {
    /// The heading.
    pub head: FitHeading,
    /// The coordinates x and y of each place, and the number there, in SI; none where there is no result.
    pub places: Vec<([f64; 2], Option<f64>)>,
    /// The unit of the coordinates.
    pub along: DisplayUnit,
    /// The quantity, and its unit.
    pub quantity: (String, DisplayUnit),
}

impl PlacesMap {
    /// Draws the picture as SVG; none without two different places or without a number.
    #[must_use]
    pub fn draw(&self, style: &Style) -> Option<String> {
        let coordinate = |axis: usize| self.places.iter().map(move |(place, _)| place[axis]);
        let (x, y) = (axes::ends(coordinate(0))?, axes::ends(coordinate(1))?);
        let side = (x[1] - x[0]).max(y[1] - y[0]);
        let [from, to] = axes::ends(self.places.iter().filter_map(|(_, value)| *value))?;
        if side == 0.0 {
            return None;
        }
        let (name, unit) = &self.quantity;
        // A single number has a scale around it.
        let room = if to > from { 0.0 } else { 0.05 * from.abs() };
        let shades = ColourScale {
            map: style.colours,
            from: (from - room) / unit.divisor,
            to: (to + room) / unit.divisor,
        };
        let around = |ends: [f64; 2]| {
            let middle = ends[0].midpoint(ends[1]);
            [middle - 0.55 * side, middle + 0.55 * side]
        };
        let panel = Panel {
            place: MAP,
            x: axes::linear(around(x), &self.along, "x", 6),
            y: axes::linear(around(y), &self.along, "y", 6),
        };
        let mut svg = style.sheet(WIDTH, HEIGHT);
        if style.heading == Heading::Shown {
            let FitHeading { title, numbers } = &self.head;
            heading::draw(&mut svg, MAP.left, WIDTH - MAP.left, title, numbers);
        }
        panel.draw_mesh(&mut svg);
        svg.within(MAP, |svg| self.draw_places(svg, &panel, &shades));
        panel.draw_axes(&mut svg);
        let bar = Rect::at((MAP.right() + GAP, MAP.top), (BAR, MAP.height));
        let title = labels::axis_title(name, &unit.label);
        colour_bar::draw(&mut svg, bar, &shades, &title);
        Some(svg.finish())
    }

    /// Draws a square at each place, empty and framed where there is no number.
    fn draw_places(&self, svg: &mut Svg, panel: &Panel, shades: &ColourScale) {
        let at = |[x, y]: [f64; 2]| panel.at(x / self.along.divisor, y / self.along.divisor);
        let places: Vec<_> = self.places.iter().map(|(place, _)| at(*place)).collect();
        let side = nearest(&places).clamp(SQUARE[0], SQUARE[1]);
        for ((x, y), (_, value)) in places.iter().zip(&self.places) {
            let square = Rect::at((x - 0.5 * side, y - 0.5 * side), (side, side));
            let colour = value.map_or(colours::BARE, |value| {
                shades.colour(value / self.quantity.1.divisor)
            });
            svg.rectangle(square, colour);
            if value.is_none() {
                let corners = [
                    [(square.left, square.top), (square.right(), square.bottom())],
                    [(square.left, square.bottom()), (square.right(), square.top)],
                ];
                svg.lines(&corners, Stroke::new(colours::RELIEF_OUTLINE, 1.0));
            }
        }
    }
}

/// The least distance of different places along an axis, in pixels.
fn nearest(places: &[(f64, f64)]) -> f64 {
    // Below a tenth of a pixel places are the same.
    const SAME: f64 = 0.1;
    let steps = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        let steps = values
            .windows(2)
            .map(|pair| pair[1] - pair[0])
            .filter(|step| *step > SAME);
        steps.fold(f64::INFINITY, f64::min)
    };
    let x = steps(places.iter().map(|place| place.0).collect());
    x.min(steps(places.iter().map(|place| place.1).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(places: Vec<([f64; 2], Option<f64>)>) -> PlacesMap {
        let unit = |divisor, label: &str| DisplayUnit {
            divisor,
            label: label.into(),
        };
        PlacesMap {
            head: FitHeading {
                title: "cells".into(),
                numbers: "4 curves".into(),
            },
            places,
            along: unit(1e-6, "µm"),
            quantity: ("Young's modulus".into(), unit(1e3, "kPa")),
        }
    }

    #[test]
    fn every_place_has_a_square_and_one_without_a_number_is_crossed_out() {
        let places = vec![
            ([0.0, 0.0], Some(1e3)),
            ([1e-6, 0.0], Some(2e3)),
            ([0.0, 1e-6], Some(3e3)),
            ([1e-6, 1e-6], None),
        ];
        let svg = map(places).draw(&Style::default()).unwrap();
        assert!(svg.contains("modulus, kPa") && svg.contains("µm"), "{svg}");
        assert!(svg.contains(&colours::BARE.to_string()));
    }

    #[test]
    fn one_place_or_no_number_gives_no_map() {
        let style = Style::default();
        assert_eq!(map(vec![([0.0, 0.0], Some(1.0))]).draw(&style), None);
        assert_eq!(
            map(vec![([0.0, 0.0], None), ([1.0, 0.0], None)]).draw(&style),
            None
        );
    }
}
