//! The value of every unknown in each repeat, with the common value, its interval and the scatter between repeats.

use pellicle::display::significant;

use super::axes;
use super::colours::colour;
use super::heading::FitHeading;
use super::unknown::FittedUnknown;
use crate::axes::panel::{Axis, Panel};
use crate::sheet::colours;
use crate::sheet::heading;
use crate::sheet::style::{Heading, Style};
use crate::sheet::svg::{Anchor, Dash, Rect, Stroke, Svg};

const LEFT: f64 = 300.0;
const TOP: f64 = heading::HEIGHT + 64.0;
const PANEL_WIDTH: f64 = 560.0;
const ROW: f64 = 26.0;
const BETWEEN: f64 = 150.0;
const WIDTH: f64 = LEFT + PANEL_WIDTH + 50.0;

/// Font size of the names on the left, and the width reserved for them.
const NAMES: f64 = 14.0;
const ROOM: f64 = LEFT - 40.0;

/// An unknown and its value in each repeat.
#[derive(Debug, Clone, PartialEq)]
pub struct Repeated {
    /// The unknown with its value common to all repeats.
    pub unknown: FittedUnknown,
    /// Standard deviation between repeats.
    pub scatter: f64,
    /// The value in each repeat alone, with the repeat's index.
    pub values: Vec<(usize, f64)>,
}

/// The picture of the repeats.
#[derive(Debug, Clone, PartialEq)]
pub struct RepeatsPlot {
    /// The heading.
    pub head: FitHeading,
    /// The names of all curves.
    pub names: Vec<String>,
    /// The unknowns that may differ between repeats.
    pub unknowns: Vec<Repeated>,
}

impl RepeatsPlot {
    /// Draws the picture as SVG; `None` without repeats.
    #[must_use]
    pub fn draw(&self, style: &Style) -> Option<String> {
        let panels: Option<Vec<_>> = self.unknowns.iter().map(axis).collect();
        let panels = panels.filter(|panels| !panels.is_empty())?;
        let high = ROW * (self.names.len() + 1) as f64;
        let height = TOP + panels.len() as f64 * (high + BETWEEN) - 50.0;
        let mut svg = style.sheet(WIDTH, height);
        if style.heading == Heading::Shown {
            let left = LEFT - ROOM;
            heading::draw(
                &mut svg,
                left,
                WIDTH - left,
                &self.head.title,
                &self.head.numbers,
            );
            heading::draw_accuracy(
                &mut svg,
                left,
                "line and shade: common value and its interval; dashed: one standard deviation between repeats; \
                 dots: each repeat alone",
            );
        }
        for (i, (x, repeated)) in panels.into_iter().zip(&self.unknowns).enumerate() {
            let panel = Panel {
                place: Rect::at(
                    (LEFT, TOP + i as f64 * (high + BETWEEN)),
                    (PANEL_WIDTH, high),
                ),
                x,
                y: self.rows(),
            };
            draw_panel(&mut svg, &panel, repeated);
            self.draw_names(&mut svg, &panel, repeated);
        }
        Some(svg.finish())
    }

    /// The rows of the curves, the first on top; their names are smaller than number labels.
    fn rows(&self) -> Axis {
        let count = self.names.len();
        Axis {
            from: count as f64,
            to: -1.0,
            title: String::new(),
            ticks: (0..count).map(|i| (i as f64, String::new())).collect(),
            is_logarithmic: false,
        }
    }

    fn draw_names(&self, svg: &mut Svg, panel: &Panel, repeated: &Repeated) {
        for (i, name) in self.names.iter().enumerate() {
            let (_, y) = panel.at(panel.x.from, i as f64);
            let is_used = repeated.values.iter().any(|(index, _)| *index == i);
            let note = if is_used { "" } else { " (left out)" };
            let name = heading::fitted(&format!("{name}{note}"), ROOM, NAMES);
            svg.text((LEFT - 14.0, y), NAMES, Anchor::End, &name);
        }
    }
}

/// The axis of the values.
fn axis(repeated: &Repeated) -> Option<Axis> {
    let Repeated {
        unknown,
        scatter,
        values,
    } = repeated;
    let around = [unknown.value - scatter, unknown.value + scatter];
    let interval = unknown.interval.into_iter().flatten();
    let values = values.iter().map(|(_, value)| *value);
    let ends = axes::ends(values.chain(interval).chain(around))?;
    Some(axes::linear(ends, &unknown.scale, &unknown.name, 6))
}

fn draw_panel(svg: &mut Svg, panel: &Panel, repeated: &Repeated) {
    let Repeated {
        unknown,
        scatter,
        values,
    } = repeated;
    let Rect { left, top, .. } = panel.place;
    let upright = |value: f64| {
        let (x, _) = panel.at(value / unknown.scale.divisor, 0.0);
        [(x, top), (x, panel.place.bottom())]
    };
    let numbers = format!(
        "{}, {}, scatter {} {}",
        unknown.numbers(),
        unknown.verdict,
        significant(*scatter / unknown.scale.divisor, 3),
        unknown.scale.label
    );
    svg.text((left, top - 16.0), 14.0, Anchor::Start, &numbers);
    svg.within(panel.place, |svg| {
        let [low, high] = unknown.interval;
        let from = low.map_or(left, |end| upright(end)[0].0);
        let to = high.map_or(panel.place.right(), |end| upright(end)[0].0);
        let shade = Rect {
            left: from,
            width: to - from,
            ..panel.place
        };
        svg.rectangle(shade, colours::INTERVAL);
    });
    panel.draw_mesh(svg);
    svg.within(panel.place, |svg| {
        svg.line(&upright(unknown.value), Stroke::new(colours::INK, 2.0));
        let band = [
            upright(unknown.value - scatter),
            upright(unknown.value + scatter),
        ];
        svg.broken_lines(&band, Stroke::new(colours::INK, 1.2), Dash::Dashed);
    });
    for (index, value) in values {
        let place = panel.at(value / unknown.scale.divisor, *index as f64);
        svg.dots(&[place], 6.0, colour(*index));
    }
    panel.draw_axes(svg);
}

#[cfg(test)]
mod tests {
    use super::super::unknown::tests::unknown;
    use super::*;

    #[test]
    fn every_repeat_has_a_row_and_excluded_ones_are_marked() {
        let repeats = RepeatsPlot {
            head: FitHeading {
                title: "a fit".into(),
                numbers: "fitted".into(),
            },
            names: ["a.csv", "b.csv", "c.csv"].map(String::from).to_vec(),
            unknowns: vec![Repeated {
                unknown: unknown("one", 7e10, 0.02),
                scatter: 1e9,
                values: vec![(0, 6.9e10), (2, 7.1e10)],
            }],
        };
        let svg = repeats.draw(&Style::default()).unwrap();
        assert!(svg.contains(">a.csv</text>") && svg.contains(">b.csv (left out)</text>"));
        assert!(svg.contains("scatter 1.00 GPa"), "{svg}");
        let none = RepeatsPlot {
            unknowns: Vec::new(),
            ..repeats
        };
        assert_eq!(none.draw(&Style::default()), None);
    }
}
