//! One panel for each unknown: how wide its interval will be, against the largest force of a curve.

use pellicle::display::DisplayUnit;

use super::axes;
use super::colours::colour;
use super::heading::FitHeading;
use crate::axes::panel::{Axis, Panel};
use crate::sheet::colours;
use crate::sheet::heading;
use crate::sheet::style::{Heading, Style};
use crate::sheet::svg::{Anchor, Dash, Rect, Stroke, Svg};

const LEFT: f64 = 112.0;
const TOP: f64 = heading::HEIGHT + 40.0;
const PANEL_WIDTH: f64 = 360.0;
const PANEL_HEIGHT: f64 = 320.0;
const ACROSS: f64 = PANEL_WIDTH + 80.0;
const DOWN: f64 = PANEL_HEIGHT + 130.0;
const COLUMNS: usize = 3;

/// Height of a line of the legend, width of an entry, and width of its line sample.
const ENTRY: f64 = 28.0;
const ENTRY_WIDTH: f64 = 210.0;
const SAMPLE: f64 = 34.0;

/// Widest and narrowest interval shown, percent; wider ones are drawn at the upper edge.
const WIDEST: f64 = 1000.0;
const NARROWEST: f64 = 0.01;

/// The picture of the designs.
#[derive(Debug, Clone, PartialEq)]
pub struct Designs {
    /// The heading.
    pub head: FitHeading,
    /// The note under the picture: noise and number of points.
    pub note: String,
    /// The unit of the forces.
    pub forces: DisplayUnit,
    /// The indenters, each with its own line.
    pub indenters: Vec<String>,
    /// The unknowns, each with its own panel.
    pub unknowns: Vec<DesignedUnknown>,
}

/// Half the interval of an unknown, in percent of the value.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignedUnknown {
    /// Its name in words.
    pub name: String,
    /// For each indenter, the largest forces, N, with the half-width of the interval; `None` if the unknown is not
    /// determined.
    pub lines: Vec<Vec<(f64, Option<f64>)>>,
    /// The half-width with all curves together.
    pub together: Option<f64>,
}

impl Designs {
    /// Draws the picture as SVG; `None` without a curve.
    #[must_use]
    pub fn draw(&self, style: &Style) -> Option<String> {
        let forces = axes::ends(self.all_lines().flatten().map(|(force, _)| *force))?;
        let columns = self.unknowns.len().clamp(1, COLUMNS);
        let rows = self.unknowns.len().div_ceil(COLUMNS);
        let width = LEFT + columns.max(2) as f64 * ACROSS - 44.0;
        let entries = self.entries();
        let across = self.entries_across(width);
        let legend = TOP + rows as f64 * DOWN - 30.0;
        let height = legend + ENTRY * entries.len().div_ceil(across) as f64 + 10.0;
        let mut svg = style.sheet(width, height);
        if style.heading == Heading::Shown {
            let FitHeading { title, numbers } = &self.head;
            heading::draw(&mut svg, LEFT, width - LEFT, title, numbers);
            heading::draw_accuracy(&mut svg, LEFT, &self.note);
        }
        // A single panel is as wide as the heading.
        let alone = if columns == 1 { ACROSS } else { 0.0 };
        for (i, unknown) in self.unknowns.iter().enumerate() {
            let place = Rect {
                left: LEFT + (i % COLUMNS) as f64 * ACROSS,
                top: TOP + (i / COLUMNS) as f64 * DOWN,
                width: PANEL_WIDTH + alone,
                height: PANEL_HEIGHT,
            };
            let mut y = self.widths();
            if i % COLUMNS > 0 {
                y.title.clear();
            }
            let x = axes::logarithmic(forces, &self.forces, "largest force");
            self.draw_panel(&mut svg, &Panel { place, x, y }, unknown);
        }
        self.draw_legend(&mut svg, legend, across);
        Some(svg.finish())
    }

    fn draw_legend(&self, svg: &mut Svg, legend: f64, across: usize) {
        for (i, (name, sample)) in self.entries().iter().enumerate() {
            let left = LEFT + (i % across) as f64 * ENTRY_WIDTH;
            let y = legend + ENTRY * (i / across) as f64;
            match sample {
                LegendSample::Line(stroke, dash) => {
                    svg.broken_lines(&[[(left, y), (left + SAMPLE, y)]], *stroke, *dash);
                }
                LegendSample::Circle => {
                    let place = (left + 0.5 * SAMPLE, y);
                    svg.circle(place, 5.0, colours::WHITE, colours::INK);
                }
            }
            svg.text((left + SAMPLE + 8.0, y), 16.0, Anchor::Start, name);
        }
    }

    fn entries_across(&self, width: f64) -> usize {
        let fits = |count: &usize| *count as f64 * ENTRY_WIDTH <= width - LEFT;
        (1..=self.entries().len())
            .take_while(fits)
            .last()
            .unwrap_or(1)
    }

    fn all_lines(&self) -> impl Iterator<Item = &Vec<(f64, Option<f64>)>> {
        self.unknowns.iter().flat_map(|unknown| &unknown.lines)
    }

    /// The entries of the legend.
    fn entries(&self) -> Vec<(String, LegendSample)> {
        let indenters = self.indenters.iter().enumerate();
        let indenters =
            indenters.map(|(i, name)| (name.clone(), LegendSample::Line(line(i), Dash::Solid)));
        let has_together = self.unknowns.iter().any(|of| of.together.is_some());
        let is_lost = self.all_lines().flatten().any(|(_, width)| width.is_none());
        let entry = |name: &str, sample| (name.to_owned(), sample);
        let together = entry("all together", LegendSample::Line(TOGETHER, Dash::Dashed));
        indenters
            .chain(has_together.then_some(together))
            .chain(is_lost.then(|| entry("lost", LegendSample::Circle)))
            .collect()
    }

    /// Axis of the widths, the same in all panels.
    fn widths(&self) -> Axis {
        let lines = self.all_lines().flatten().filter_map(|(_, width)| *width);
        let levels = self.unknowns.iter().filter_map(|of| of.together);
        let ends = axes::ends(
            lines
                .chain(levels)
                .map(|width| width.clamp(NARROWEST, WIDEST)),
        );
        let [low, high] = ends.unwrap_or([1.0, WIDEST]);
        // Widths that are nearly equal are put in the middle.
        let middle = (low * high).sqrt();
        let (low, high) = (low.min(middle / 2.0), high.max(middle * 2.0));
        Axis::logarithmic(low, high, "half the interval, %".into())
    }

    fn draw_panel(&self, svg: &mut Svg, panel: &Panel, unknown: &DesignedUnknown) {
        let place = panel.place;
        let name = heading::fitted(&unknown.name, place.width, 17.0);
        svg.text((place.left, place.top - 16.0), 17.0, Anchor::Start, &name);
        panel.draw_mesh(svg);
        let level = |width: f64| {
            let width = width.max(panel.y.from);
            [panel.at(panel.x.from, width), panel.at(panel.x.to, width)]
        };
        svg.within(place, |svg| {
            if let Some(together) = unknown.together {
                svg.broken_lines(&[level(together)], TOGETHER, Dash::Dashed);
            }
        });
        for (i, points) in unknown.lines.iter().enumerate() {
            self.draw_line(svg, panel, i, points);
        }
        panel.draw_axes(svg);
    }

    fn draw_line(&self, svg: &mut Svg, panel: &Panel, i: usize, points: &[(f64, Option<f64>)]) {
        let at = |force: f64, width: f64| {
            panel.at(
                force / self.forces.divisor,
                width.clamp(panel.y.from, panel.y.to),
            )
        };
        let known: Vec<_> = points
            .iter()
            .filter_map(|(force, width)| Some(at(*force, (*width)?)))
            .collect();
        svg.line(&known, line(i));
        svg.dots(&known, 7.0, colour(i));
        for (force, _) in points.iter().filter(|(_, width)| width.is_none()) {
            svg.circle(at(*force, panel.y.to), 5.0, colours::WHITE, colour(i));
        }
    }
}

/// Stroke for all curves together.
const TOGETHER: Stroke = Stroke {
    colour: colours::INK,
    width: 1.8,
};

/// The sample beside a name in the legend.
enum LegendSample {
    Line(Stroke, Dash),
    Circle,
}

fn line(i: usize) -> Stroke {
    Stroke::new(colour(i), 2.4)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn designs() -> Designs {
        Designs {
            head: FitHeading {
                title: "a plan".into(),
                numbers: "95 % intervals".into(),
            },
            note: String::new(),
            forces: DisplayUnit {
                divisor: 1e-3,
                label: "mN".into(),
            },
            indenters: vec!["R 1 µm".into(), "R 100 µm".into()],
            unknowns: vec![DesignedUnknown {
                name: "Young's modulus of layer 0".into(),
                lines: vec![
                    vec![(1e-3, Some(3.0)), (1e-2, None)],
                    vec![(1e-3, Some(40.0)), (1e-2, Some(4.0))],
                ],
                together: Some(2.0),
            }],
        }
    }

    #[test]
    fn every_indenter_has_a_line_and_lost_unknowns_are_marked() {
        let svg = designs().draw(&Style::default()).unwrap();
        for text in [
            "R 1 µm",
            "R 100 µm",
            "all together",
            "lost",
            "largest force, mN",
        ] {
            assert!(svg.contains(&format!(">{text}</text>")), "{text}");
        }
        assert!(!svg.contains("what was measured"));
        assert_eq!(svg.matches("<circle").count(), 2);
    }

    #[test]
    fn without_a_curve_there_is_no_picture() {
        let mut none = designs();
        none.unknowns[0].lines.clear();
        assert_eq!(none.draw(&Style::default()), None);
    }
}
