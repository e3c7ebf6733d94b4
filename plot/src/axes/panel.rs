//! A rectangle with axes, which maps values to positions.

use crate::axes::labels;
use crate::axes::ticks;
use crate::sheet::colours;
use crate::sheet::heading;
use crate::sheet::svg::{Anchor, Rect, Stroke, Svg, TextDirection};

/// Font sizes of labels and titles, in pixels.
pub const LABEL: f64 = 17.0;
const TITLE: f64 = 18.0;

/// Length of a tick, in pixels.
const TICK: f64 = 6.0;

/// Least distance between neighbouring labels, in pixels.
const BETWEEN_LABELS: f64 = 6.0;

/// Distance from an axis to its title, in pixels.
const TITLE_BELOW: f64 = 48.0;
const TITLE_LEFT: f64 = 84.0;

/// One axis of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The value at its left or lower end.
    pub from: f64,
    /// The value at its other end, above or below the first.
    pub to: f64,
    /// Its quantity, with the unit.
    pub title: String,
    /// Marked values, with their labels.
    pub ticks: Vec<(f64, String)>,
    /// Whether equal lengths are equal ratios; then all values are positive.
    pub is_logarithmic: bool,
}

impl Axis {
    /// Returns an axis with about `count` round ticks.
    #[must_use]
    pub fn new(from: f64, to: f64, title: String, count: usize) -> Self {
        let length = (to - from).abs();
        let labelled = |tick| (tick, labels::tick(tick, length));
        let ticks = ticks::linear(from, to, count);
        Self {
            from,
            to,
            title,
            ticks: ticks.into_iter().map(labelled).collect(),
            is_logarithmic: false,
        }
    }

    /// Returns a logarithmic axis that contains these two positive values, with at least three ticks.
    #[must_use]
    pub fn logarithmic(smallest: f64, largest: f64, title: String) -> Self {
        Self::logarithmic_within(smallest / 1.3, largest * 1.3, title)
    }

    /// Returns a logarithmic axis between these two positive values.
    #[must_use]
    pub fn logarithmic_within(from: f64, to: f64, title: String) -> Self {
        let ticks = ticks::logarithmic(from, to);
        let labels = labels::logarithmic_ticks(&ticks);
        Self {
            from,
            to,
            title,
            ticks: ticks.into_iter().zip(labels).collect(),
            is_logarithmic: true,
        }
    }

    /// Returns the axis with ticks but without text, as the panel below has the same.
    #[must_use]
    pub fn unlabelled(self) -> Self {
        let ticks = self.ticks.into_iter();
        Self {
            title: String::new(),
            ticks: ticks.map(|(tick, _)| (tick, String::new())).collect(),
            ..self
        }
    }

    /// Returns the position of a value along the axis: 0 at its first end, 1 at its last.
    #[must_use]
    pub fn fraction(&self, value: f64) -> f64 {
        if self.is_logarithmic {
            return (value / self.from).ln() / (self.to / self.from).ln();
        }
        (value - self.from) / (self.to - self.from)
    }
}

/// A rectangle with two axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// The rectangle; labels are drawn outside it.
    pub place: Rect,
    /// The axis below.
    pub x: Axis,
    /// The axis on the left.
    pub y: Axis,
}

impl Panel {
    /// Returns the position of a point on the sheet.
    #[must_use]
    pub fn at(&self, x: f64, y: f64) -> (f64, f64) {
        let Rect {
            left,
            width,
            height,
            ..
        } = self.place;
        (
            left + width * self.x.fraction(x),
            self.place.bottom() - height * self.y.fraction(y),
        )
    }

    /// Returns the positions of many points.
    pub fn all_at(&self, points: impl IntoIterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
        points.into_iter().map(|(x, y)| self.at(x, y)).collect()
    }

    /// Draws the grid lines, below the contents of the panel.
    pub fn draw_mesh(&self, svg: &mut Svg) {
        let stroke = Stroke::new(colours::GRID, 1.0);
        let across = self.x.ticks.iter().map(|(x, _)| {
            let (x, _) = self.at(*x, self.y.from);
            [(x, self.place.top), (x, self.place.bottom())]
        });
        let along = self.y.ticks.iter().map(|(y, _)| {
            let (_, y) = self.at(self.x.from, *y);
            [(self.place.left, y), (self.place.right(), y)]
        });
        svg.lines(&across.chain(along).collect::<Vec<_>>(), stroke);
    }

    /// Draws frame, ticks, labels and titles, above the contents of the panel.
    pub fn draw_axes(&self, svg: &mut Svg) {
        let Rect { left, top, .. } = self.place;
        let (right, bottom) = (self.place.right(), self.place.bottom());
        let stroke = Stroke::new(colours::INK, 1.2);
        let frame = [
            (left, top),
            (left, bottom),
            (right, bottom),
            (right, top),
            (left, top),
        ];
        svg.line(&frame, stroke);
        self.draw_x_ticks(svg, stroke);
        self.draw_y_ticks(svg, stroke);
        let middle = left.midpoint(right);
        svg.text(
            (middle, bottom + TITLE_BELOW),
            TITLE,
            Anchor::Middle,
            &self.x.title,
        );
        let place = (left - TITLE_LEFT, top.midpoint(bottom));
        svg.directed_text(
            place,
            TITLE,
            Anchor::Middle,
            TextDirection::Up,
            &self.y.title,
        );
    }

    fn draw_x_ticks(&self, svg: &mut Svg, stroke: Stroke) {
        let bottom = self.place.bottom();
        let length = |label: &str| heading::width(label, LABEL);
        let labels = apart(&self.x, self.place.width, length);
        for ((value, _), label) in self.x.ticks.iter().zip(labels) {
            let (x, _) = self.at(*value, self.y.from);
            svg.line(&[(x, bottom), (x, bottom + TICK)], stroke);
            svg.text((x, bottom + TICK + 14.0), LABEL, Anchor::Middle, label);
        }
    }

    fn draw_y_ticks(&self, svg: &mut Svg, stroke: Stroke) {
        let left = self.place.left;
        let labels = apart(&self.y, self.place.height, |_| LABEL);
        for ((value, _), label) in self.y.ticks.iter().zip(labels) {
            let (_, y) = self.at(self.x.from, *value);
            svg.line(&[(left - TICK, y), (left, y)], stroke);
            svg.text((left - TICK - 5.0, y), LABEL, Anchor::End, label);
        }
    }
}

/// The labels of an axis of this many pixels, without those that would touch one before; `length` is the room of a
/// label along the axis. Of crowded ticks, those of the most round values keep their labels: powers of ten, then 5 and
/// 2.
fn apart(axis: &Axis, pixels: f64, length: impl Fn(&str) -> f64) -> Vec<&str> {
    let mut order: Vec<usize> = (0..axis.ticks.len()).collect();
    if axis.is_logarithmic {
        order.sort_by_key(|tick| roundness(axis.ticks[*tick].0));
    }
    let mut taken: Vec<[f64; 2]> = Vec::new();
    let mut labels = vec![""; axis.ticks.len()];
    for tick in order {
        let (value, label) = &axis.ticks[tick];
        let (middle, half) = (pixels * axis.fraction(*value), 0.5 * length(label));
        let [from, to] = [middle - half, middle + half];
        let touches =
            |[other, end]: &[f64; 2]| from < end + BETWEEN_LABELS && *other < to + BETWEEN_LABELS;
        if !label.is_empty() && !taken.iter().any(touches) {
            taken.push([from, to]);
            labels[tick] = label;
        }
    }
    labels
}

/// The place of a value's leading digits in the order 1, 5, 2, others.
fn roundness(value: f64) -> usize {
    let digits = value / 10_f64.powf(value.log10().floor());
    let is = |wanted: &f64| (digits - wanted).abs() < 1e-6;
    [1.0, 5.0, 2.0].iter().position(is).unwrap_or(3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_never_touch_and_round_values_keep_theirs() {
        // 44 pixels for each of 20 numbers of four digits, which are 41 wide.
        let crowded = Axis {
            from: 0.0,
            to: 10.0,
            title: String::new(),
            ticks: (0..=20)
                .map(|i| (0.5 * f64::from(i), format!("{:.2}", 0.5 * f64::from(i))))
                .collect(),
            is_logarithmic: false,
        };
        let labels = apart(&crowded, 440.0, |label| heading::width(label, LABEL));
        let shown = labels.iter().filter(|label| !label.is_empty()).count();
        assert_eq!(shown, 7, "{labels:?}");
        let decade = Axis::logarithmic(1.0, 1.5, String::new());
        let labels = apart(&decade, 120.0, |label| heading::width(label, LABEL));
        assert!(labels.contains(&"1") && labels.contains(&""), "{labels:?}");
        // With room, all are there.
        let labels = apart(&decade, 1000.0, |label| heading::width(label, LABEL));
        assert!(!labels.contains(&""), "{labels:?}");
    }

    #[test]
    fn values_are_placed_correctly_on_a_reversed_axis() {
        let panel = Panel {
            place: Rect {
                left: 10.0,
                top: 20.0,
                width: 100.0,
                height: 50.0,
            },
            x: Axis::new(-1.0, 1.0, String::new(), 5),
            y: Axis::new(4.0, 0.0, String::new(), 5),
        };
        assert_eq!(panel.at(0.0, 4.0), (60.0, 70.0));
        assert_eq!(panel.at(1.0, 0.0), (110.0, 20.0));
    }
}
