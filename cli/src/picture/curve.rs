//! The curves of a case with several loads: the force over the penetration, the largest pressure over the force.

use super::colours::{self, Colour};
use super::panel::{Axis, Panel};
use super::svg::{Anchor, Place, Stroke, Svg};
use super::{axis, heading};
use crate::display::{Scale, Unit};
use crate::output::record::Record;
use crate::output::summary::StepSummary;

/// Name of the picture, without ending.
pub const NAME: &str = "curve";

const LEFT: f64 = 112.0;
const TOP: f64 = heading::HEIGHT + 8.0;
const SIDE: f64 = 440.0;
const BETWEEN: f64 = 120.0;
const WIDTH: f64 = LEFT + 2.0 * SIDE + BETWEEN + 36.0;
const HEIGHT: f64 = TOP + SIDE + 72.0;

/// Above the largest value, as a part of it.
const MARGIN: f64 = 0.06;

/// From this ratio of the largest to the smallest force on, axes are logarithmic.
const DECADES: f64 = 50.0;

/// One coordinate of a curve.
#[derive(Clone, Copy)]
struct Coordinate {
    symbol: &'static str,
    unit: Unit,
    value: fn(&StepSummary) -> f64,
}

const FORCE: Coordinate = Coordinate {
    symbol: "force Q",
    unit: Unit::Newton,
    value: |step| step.force,
};
const PENETRATION: Coordinate = Coordinate {
    symbol: "penetration D",
    unit: Unit::Metre,
    value: |step| step.penetration,
};
const PEAK: Coordinate = Coordinate {
    symbol: "largest pressure p",
    unit: Unit::Pascal,
    value: |step| step.max_pressure,
};

/// The picture as SVG; none of a single step.
#[must_use]
pub fn draw(record: &Record) -> Option<String> {
    if record.steps.len() < 2 {
        return None;
    }
    let mut svg = Svg::new(WIDTH, HEIGHT);
    let open = record.steps.iter().any(|step| !step.certificate.satisfied);
    let note = if open {
        ", open circles are NOT CONVERGED"
    } else {
        ""
    };
    let numbers = format!("{} loading steps{note}", record.steps.len());
    heading::draw(&mut svg, LEFT, WIDTH - LEFT, &record.title, &numbers);
    draw_panel(&mut svg, record, LEFT, PENETRATION, FORCE);
    draw_panel(&mut svg, record, LEFT + SIDE + BETWEEN, FORCE, PEAK);
    Some(svg.finish())
}

fn draw_panel(svg: &mut Svg, record: &Record, left: f64, x: Coordinate, y: Coordinate) {
    let (x_axis, x_scale) = axis_of(record, x);
    let (y_axis, y_scale) = axis_of(record, y);
    let panel = Panel {
        place: Place {
            left,
            top: TOP,
            width: SIDE,
            height: SIDE,
        },
        x: x_axis,
        y: y_axis,
    };
    let point = |step: &StepSummary| {
        let (x, y) = ((x.value)(step), (y.value)(step));
        panel.at(x / x_scale.divisor, y / y_scale.divisor)
    };
    let points: Vec<_> = record
        .steps
        .iter()
        .map(|step| (point(step), step))
        .collect();
    let is_finite = |((x, y), _): &((f64, f64), &StepSummary)| x.is_finite() && y.is_finite();
    let points: Vec<_> = points.into_iter().filter(is_finite).collect();
    let line: Vec<_> = points.iter().map(|(point, _)| *point).collect();
    panel.draw_mesh(svg);
    svg.within(panel.place, |svg| {
        let (colour, width) = (colours::BLUE, 2.0);
        svg.line(&line, Stroke { colour, width });
    });
    for (point, step) in points {
        let (fill, edge) = mark(step.certificate.satisfied);
        svg.circle(point, 4.5, fill, edge);
    }
    panel.draw_axes(svg);
    if is_logarithmic(record) {
        let place = (panel.place.right() - 8.0, panel.place.bottom() - 16.0);
        svg.text(place, 14.0, Anchor::End, "logarithmic axes");
    }
}

/// Fill and edge of the mark of a step.
fn mark(satisfied: bool) -> (Colour, Colour) {
    if satisfied {
        (colours::BLUE, colours::BLUE)
    } else {
        (colours::WHITE, colours::ORANGE)
    }
}

/// Whether the forces of a curve span so much that small ones would vanish on a linear axis, and everything is positive.
fn is_logarithmic(record: &Record) -> bool {
    let all_positive = record.steps.iter().all(|step| {
        [FORCE, PENETRATION, PEAK]
            .iter()
            .all(|coordinate| (coordinate.value)(step) > 0.0)
    });
    let (smallest, largest) = ends(record, FORCE);
    all_positive && largest >= DECADES * smallest
}

fn ends(record: &Record, coordinate: Coordinate) -> (f64, f64) {
    let values = record.steps.iter().map(coordinate.value);
    let values = values.filter(|value| value.is_finite());
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (low.min(value), high.max(value))
    })
}

fn axis_of(record: &Record, coordinate: Coordinate) -> (Axis, Scale) {
    let (smallest, largest) = ends(record, coordinate);
    let scale = Scale::of(largest.max(-smallest), coordinate.unit, record.units);
    let title = axis::title(coordinate.symbol, &scale.label);
    let (low, high) = (smallest / scale.divisor, largest / scale.divisor);
    if is_logarithmic(record) {
        return (Axis::logarithmic(low, high, title), scale);
    }
    let (low, high) = (low.min(0.0), high.max(0.0));
    let length = if high > low { high - low } else { 1.0 };
    let low = if low < 0.0 {
        low - MARGIN * length
    } else {
        low
    };
    let high = high + MARGIN * length;
    (Axis::new(low, high, title, 6), scale)
}
