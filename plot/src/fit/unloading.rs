//! Loads and unloadings with the laws of their unloadings, in small panels.

use std::ops::Range;

use pellicle::display::{DisplayUnit, Unit, count};
use pellicle::input::units::Units;

use super::axes;
use crate::axes::panel::Panel;
use crate::sheet::colours;
use crate::sheet::heading;
use crate::sheet::style::{Heading, Style};
use crate::sheet::svg::{Anchor, Dash, Rect, Stroke, Svg};

/// Number of panels on a sheet.
pub const PANELS: usize = 6;

const COLUMNS: usize = 2;
const WIDE: f64 = 440.0;
const HIGH: f64 = 300.0;
const LEFT: f64 = 100.0;
/// Room above a panel for its name and numbers, and below it for its axis.
const ABOVE: f64 = 64.0;
const BELOW: f64 = 74.0;
const RIGHT: f64 = 30.0;
/// Most points drawn of a curve.
const POINTS: usize = 1200;

/// A curve and the law of its unloading, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct UnloadingPanel {
    /// Its name.
    pub name: String,
    /// Its main numbers, in words.
    pub numbers: String,
    /// Depths (m) and forces (N), in the order of measurement.
    pub points: Vec<(f64, f64)>,
    /// The points to which the law is fitted.
    pub fitted: Range<usize>,
    /// The law from no force to the largest.
    pub law: Vec<(f64, f64)>,
    /// Both ends of the tangent at the largest force.
    pub tangent: [(f64, f64); 2],
}

/// Draws up to [`PANELS`] curves as SVG: those from `first` on, counted from 1, of `all` curves.
#[must_use]
pub fn draw(
    title: &str,
    panels: &[UnloadingPanel],
    [first, all]: [usize; 2],
    style: &Style,
) -> String {
    let columns = panels.len().clamp(1, COLUMNS);
    let rows = panels.len().div_ceil(COLUMNS).max(1);
    let [wide, high] = [LEFT + WIDE + RIGHT, ABOVE + HIGH + BELOW];
    let mut svg = style.sheet(
        columns as f64 * wide,
        heading::HEIGHT + rows as f64 * high + 8.0,
    );
    if style.heading == Heading::Shown {
        let which = match panels.len() {
            shown if shown == all => count(all, "unloading"),
            1 => format!("unloading {first} of {all}"),
            shown => format!("unloadings {first} to {} of {all}", first + shown - 1),
        };
        let numbers = format!("{which}, evaluated by Oliver and Pharr");
        heading::draw(
            &mut svg,
            LEFT,
            columns as f64 * wide - LEFT,
            title,
            &numbers,
        );
    }
    for (place, panel) in panels.iter().enumerate() {
        let (column, row) = (place % COLUMNS, place / COLUMNS);
        let corner = (
            column as f64 * wide + LEFT,
            heading::HEIGHT + row as f64 * high + ABOVE,
        );
        panel.draw(&mut svg, Rect::at(corner, (WIDE, HIGH)));
    }
    svg.finish()
}

impl UnloadingPanel {
    fn draw(&self, svg: &mut Svg, place: Rect) {
        let all = || self.points.iter().chain(&self.law);
        let ends = |values: &mut dyn Iterator<Item = f64>| axes::ends(values).unwrap_or([0.0, 1.0]);
        let x = ends(&mut all().map(|point| point.0));
        let y = ends(&mut all().map(|point| point.1));
        let scale = |[low, high]: [f64; 2], unit| DisplayUnit::of(high.max(-low), unit, Units::Si);
        let (depth, force) = (scale(x, Unit::Metre), scale(y, Unit::Newton));
        let panel = Panel {
            place,
            x: axes::linear(x, &depth, "depth h", 5),
            y: axes::linear(y, &force, "force P", 5),
        };
        let at = |points: &[(f64, f64)]| {
            let scaled = points
                .iter()
                .map(|(h, p)| (h / depth.divisor, p / force.divisor));
            panel.all_at(scaled)
        };
        panel.draw_mesh(svg);
        let step = self.points.len().div_ceil(POINTS).max(1);
        let shown: Vec<_> = self.points.iter().copied().step_by(step).collect();
        svg.within(place, |svg| {
            svg.dots(&at(&shown), 1.8, colours::SKY);
            let fitted = self.points.get(self.fitted.clone()).unwrap_or_default();
            let step = fitted.len().div_ceil(POINTS).max(1);
            let fitted: Vec<_> = fitted.iter().copied().step_by(step).collect();
            svg.dots(&at(&fitted), 2.2, colours::BLUE);
            svg.line(&at(&self.law), Stroke::new(colours::ORANGE, 2.0));
            let tangent = [at(&self.tangent)];
            svg.broken_lines(&tangent, Stroke::new(colours::INK, 1.2), Dash::Dashed);
        });
        panel.draw_axes(svg);
        let text = |svg: &mut Svg, (up, size): (f64, f64), words: &str| {
            let words = heading::fitted(words, WIDE, size);
            svg.text((place.left, place.top - up), size, Anchor::Start, &words);
        };
        text(svg, (36.0, 15.0), &self.name);
        text(svg, (14.0, 13.0), &self.numbers);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_curve_has_a_panel_with_its_name_and_numbers() {
        let panel = UnloadingPanel {
            name: "silica.txt".into(),
            numbers: "E_IT = 72.0 GPa".into(),
            points: vec![(0.0, 0.0), (2e-7, 5e-3), (1e-7, 0.0)],
            fitted: 1..3,
            law: vec![(1e-7, 0.0), (2e-7, 5e-3)],
            tangent: [(1.5e-7, 0.0), (2e-7, 5e-3)],
        };
        let panels = [panel.clone(), panel];
        let svg = draw("films", &panels, [1, 2], &Style::default());
        assert_eq!(svg.matches("silica.txt").count(), 2);
        assert!(svg.contains("2 unloadings") && svg.contains("E_IT = 72.0 GPa"));
        assert!(svg.contains("depth h"));
        for (panels, which) in [
            (&panels[..], "unloadings 3 to 4 of 7"),
            (&panels[..1], "unloading 3 of 7"),
        ] {
            let svg = draw("films", panels, [3, 7], &Style::default());
            assert!(svg.contains(which), "{svg}");
        }
    }
}
