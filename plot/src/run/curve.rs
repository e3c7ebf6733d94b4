//! Curves of cases with several loads: force over penetration, largest pressure over force.

use pellicle::display::{DisplayUnit, Unit};
use pellicle::input::units::Units;

use crate::axes::labels;
use crate::axes::panel::{Axis, Panel};
use crate::sheet::colours::{self, Colour};
use crate::sheet::heading;
use crate::sheet::style::{Heading, Style};
use crate::sheet::svg::{Anchor, Dash, Rect, Stroke, Svg};

const LEFT: f64 = 112.0;
const TOP: f64 = heading::HEIGHT + 8.0;
const SIDE: f64 = 440.0;
const BETWEEN: f64 = 120.0;
const WIDTH: f64 = LEFT + 2.0 * SIDE + BETWEEN + 36.0;
const HEIGHT: f64 = TOP + SIDE + 72.0;

/// Height of a line of the legend, and number of columns.
const ENTRY: f64 = 28.0;
const COLUMNS: usize = 2;

/// Margin above the largest value, as a fraction of it.
const MARGIN: f64 = 0.06;

/// Ratio of the largest to the smallest force above which the axes are logarithmic.
const DECADES: f64 = 50.0;

/// Colours of several curves, distinguishable by the colour-blind; further curves are dashed.
const COLOURS: [Colour; 7] = [
    colours::BLUE,
    colours::ORANGE,
    colours::GREEN,
    colours::PURPLE,
    colours::SKY,
    colours::AMBER,
    colours::INK,
];

/// A loading step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveStep {
    /// Force, N.
    pub force: f64,
    /// Penetration, m.
    pub penetration: f64,
    /// Largest pressure, Pa.
    pub max_pressure: f64,
    /// The words that mark a step that is not certified.
    pub mark: Option<&'static str>,
}

/// A quantity of a loading step, shown on one of the axes.
#[derive(Clone, Copy)]
struct StepQuantity {
    symbol: &'static str,
    unit: Unit,
    value: fn(&CurveStep) -> f64,
}

const FORCE: StepQuantity = StepQuantity {
    symbol: "force Q",
    unit: Unit::Newton,
    value: |step| step.force,
};
const PENETRATION: StepQuantity = StepQuantity {
    symbol: "penetration D",
    unit: Unit::Metre,
    value: |step| step.penetration,
};
const PEAK: StepQuantity = StepQuantity {
    symbol: "largest pressure p",
    unit: Unit::Pascal,
    value: |step| step.max_pressure,
};

/// A result's curve and its name.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedCurve {
    /// Its name in the heading or the legend.
    pub name: String,
    /// Its loading steps.
    pub steps: Vec<CurveStep>,
}

/// Draws the picture of one result as SVG; `worst` marks its worst step, none if all are certified.
#[must_use]
pub fn draw(curve: NamedCurve, worst: Option<&'static str>, units: Units, style: &Style) -> String {
    let numbers = format!("{} loading steps", curve.steps.len());
    Sheet::new(vec![curve], units).draw(&numbers, worst, style)
}

/// Draws the picture of several results in common units as SVG; `worst` marks the worst step of all.
#[must_use]
pub fn draw_several(
    curves: Vec<NamedCurve>,
    worst: Option<&'static str>,
    units: Units,
    style: &Style,
) -> String {
    let numbers = format!("{} results", curves.len());
    Sheet::new(curves, units).draw(&numbers, worst, style)
}

/// The curves on one sheet, with axes that suit them all.
struct Sheet {
    curves: Vec<NamedCurve>,
    units: Units,
    is_logarithmic: bool,
}

impl Sheet {
    fn new(curves: Vec<NamedCurve>, units: Units) -> Self {
        let mut sheet = Self {
            curves,
            units,
            is_logarithmic: false,
        };
        sheet.is_logarithmic = sheet.suits_logarithms();
        sheet
    }

    fn draw(&self, numbers: &str, worst: Option<&'static str>, style: &Style) -> String {
        let several = self.curves.len() > 1;
        let entries = if several { self.curves.len() } else { 0 };
        let legend = ENTRY * entries.div_ceil(COLUMNS) as f64;
        let mut svg = style.sheet(WIDTH, HEIGHT + legend);
        if style.heading == Heading::Shown {
            let titles: Vec<_> = self.curves.iter().map(|curve| &curve.name[..]).collect();
            let note = worst.map_or(String::new(), |mark| format!(", open circles are {mark}"));
            let title = if several {
                "Curves of several results"
            } else {
                titles.first().copied().unwrap_or_default()
            };
            let numbers = format!("{numbers}{note}");
            heading::draw(&mut svg, LEFT, WIDTH - LEFT, title, &numbers);
        }
        self.draw_panel(&mut svg, LEFT, PENETRATION, FORCE);
        self.draw_panel(&mut svg, LEFT + SIDE + BETWEEN, FORCE, PEAK);
        if several {
            self.draw_legend(&mut svg);
        }
        svg.finish()
    }

    fn draw_panel(&self, svg: &mut Svg, left: f64, x: StepQuantity, y: StepQuantity) {
        let (x_axis, x_scale) = self.axis_of(x);
        let (y_axis, y_scale) = self.axis_of(y);
        let panel = Panel {
            place: Rect::at((left, TOP), (SIDE, SIDE)),
            x: x_axis,
            y: y_axis,
        };
        panel.draw_mesh(svg);
        for (i, curve) in self.curves.iter().enumerate() {
            let point = |step: &CurveStep| {
                let (x, y) = ((x.value)(step), (y.value)(step));
                panel.at(x / x_scale.divisor, y / y_scale.divisor)
            };
            let points = curve.steps.iter().map(|step| (point(step), step));
            let is_finite = |((x, y), _): &((f64, f64), &CurveStep)| x.is_finite() && y.is_finite();
            let points: Vec<_> = points.filter(is_finite).collect();
            let line: Vec<_> = points.iter().map(|(point, _)| *point).collect();
            let (stroke, dash) = pen(i);
            svg.within(panel.place, |svg| {
                if line.len() > 1 {
                    svg.broken_lines(&[line], stroke, dash);
                }
            });
            for (point, step) in points {
                let (fill, edge) = mark(step.mark.is_none(), stroke.colour);
                svg.circle(point, 4.5, fill, edge);
            }
        }
        panel.draw_axes(svg);
        if self.is_logarithmic {
            let place = (panel.place.right() - 8.0, panel.place.bottom() - 16.0);
            svg.text(place, 14.0, Anchor::End, "logarithmic axes");
        }
    }

    /// Draws the legend below the panels.
    fn draw_legend(&self, svg: &mut Svg) {
        let column = (WIDTH - LEFT) / COLUMNS as f64;
        for (i, curve) in self.curves.iter().enumerate() {
            let (stroke, dash) = pen(i);
            let x = LEFT + column * (i % COLUMNS) as f64;
            let y = HEIGHT + ENTRY * (0.5 + (i / COLUMNS) as f64) - 8.0;
            svg.broken_lines(&[[(x, y), (x + 40.0, y)]], stroke, dash);
            svg.circle((x + 20.0, y), 4.5, stroke.colour, stroke.colour);
            let name = heading::fitted(&curve.name, column - 60.0, 16.0);
            svg.text((x + 50.0, y), 16.0, Anchor::Start, &name);
        }
    }

    fn steps(&self) -> impl Iterator<Item = &CurveStep> {
        self.curves.iter().flat_map(|curve| &curve.steps)
    }

    /// Whether all values are positive and the forces span a range in which small ones would vanish on a linear axis.
    fn suits_logarithms(&self) -> bool {
        let all_positive = self.steps().all(|step| {
            [FORCE, PENETRATION, PEAK]
                .iter()
                .all(|coordinate| (coordinate.value)(step) > 0.0)
        });
        let (smallest, largest) = self.ends(FORCE);
        all_positive && largest >= DECADES * smallest
    }

    fn ends(&self, coordinate: StepQuantity) -> (f64, f64) {
        let values = self.steps().map(coordinate.value);
        let values = values.filter(|value| value.is_finite());
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        })
    }

    fn axis_of(&self, coordinate: StepQuantity) -> (Axis, DisplayUnit) {
        let (smallest, largest) = self.ends(coordinate);
        let scale = DisplayUnit::of(largest.max(-smallest), coordinate.unit, self.units);
        let title = labels::axis_title(coordinate.symbol, &scale.label);
        let (low, high) = (smallest / scale.divisor, largest / scale.divisor);
        if self.is_logarithmic {
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
}

/// Stroke of curve number `i`.
fn pen(i: usize) -> (Stroke, Dash) {
    let colour = COLOURS[i % COLOURS.len()];
    let dash = if i < COLOURS.len() {
        Dash::Solid
    } else {
        Dash::Dashed
    };
    (Stroke::new(colour, 2.0), dash)
}

/// Fill and edge colour of a step's mark.
fn mark(certified: bool, colour: Colour) -> (Colour, Colour) {
    match (certified, colour) {
        (true, colour) => (colour, colour),
        (false, colours::BLUE) => (colours::WHITE, colours::ORANGE),
        (false, colour) => (colours::WHITE, colour),
    }
}
