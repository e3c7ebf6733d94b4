//! The change of penetration, contact area and largest pressure from grid to grid.

use pellicle::display::{Unit, error_of, quantity};
use pellicle::input::units::Units;

use crate::axes::panel::{Axis, Panel};
use crate::sheet::colour_map::ColourMap;
use crate::sheet::colours::Colour;
use crate::sheet::heading;
use crate::sheet::style::{Heading, Style};
use crate::sheet::svg::{Anchor, Rect, Stroke, Svg};

const LEFT: f64 = 100.0;
const TOP: f64 = heading::HEIGHT + 56.0;
const PANEL_WIDTH: f64 = 290.0;
const PANEL_HEIGHT: f64 = 340.0;
const BETWEEN: f64 = 82.0;
const WIDTH: f64 = LEFT + 3.0 * PANEL_WIDTH + 2.0 * BETWEEN + 30.0;
const HEIGHT: f64 = TOP + PANEL_HEIGHT + 72.0;

/// Margin above and below the lines, as a fraction of their extent.
const MARGIN: f64 = 0.1;

/// End of the part of viridis in use: its lightest colours cannot be seen on white.
const LIGHTEST: f64 = 0.85;

/// A result that has a value on every grid, with its loading steps.
#[derive(Debug, Clone, PartialEq)]
pub struct GridNumber {
    /// Its name.
    pub name: &'static str,
    /// Its unit.
    pub unit: Unit,
    /// Its values in each loading step.
    pub steps: Vec<GridValues>,
}

/// A number on the grids of one loading step.
#[derive(Debug, Clone, PartialEq)]
pub struct GridValues {
    /// The number as reported.
    pub value: f64,
    /// Its estimated error, if there is one.
    pub error: Option<GridErrorNote>,
    /// Elements per side and value on each grid, from the coarsest to the finest.
    pub levels: Vec<(usize, f64)>,
}

/// What the grids tell about an error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GridErrorNote {
    /// The error.
    Resolved(f64),
    /// The grids do not resolve it.
    NotResolved,
}

/// Whether there is more than one grid, which the picture needs.
#[must_use]
pub fn is_drawn(numbers: &[GridNumber]) -> bool {
    let mut steps = numbers.iter().flat_map(|number| &number.steps);
    steps.any(|step| step.levels.len() > 1)
}

/// Draws the picture of three numbers as SVG; `None` if all are of one grid.
#[must_use]
pub fn draw(title: &str, numbers: &[GridNumber; 3], units: Units, style: &Style) -> Option<String> {
    if !is_drawn(numbers) {
        return None;
    }
    let mut svg = style.sheet(WIDTH, HEIGHT);
    let what = match numbers[0].steps.len() {
        1 => "change against the finest grid".to_owned(),
        steps => {
            format!("change against the finest grid; {steps} loading steps, from dark to light")
        }
    };
    if style.heading == Heading::Shown {
        heading::draw(&mut svg, LEFT, WIDTH - LEFT, title, &what);
    }
    for (i, number) in numbers.iter().enumerate() {
        let left = LEFT + i as f64 * (PANEL_WIDTH + BETWEEN);
        draw_panel(&mut svg, left, number, units);
    }
    Some(svg.finish())
}

fn draw_panel(svg: &mut Svg, left: f64, number: &GridNumber, units: Units) {
    let changes: Vec<_> = number.steps.iter().map(changes).collect();
    let title = if left > LEFT { "" } else { "change, %" };
    let panel = Panel {
        place: Rect::at((left, TOP), (PANEL_WIDTH, PANEL_HEIGHT)),
        x: grids(number),
        y: percent(&changes, title),
    };
    svg.text((left, TOP - 40.0), 18.0, Anchor::Start, number.name);
    if let [step] = &number.steps[..] {
        let note = note(step, number.unit, units);
        svg.text((left, TOP - 16.0), 15.0, Anchor::Start, &note);
    }
    panel.draw_mesh(svg);
    for (i, line) in changes.iter().enumerate() {
        let colour = colour(i, changes.len());
        let points = panel.all_at(line.iter().copied());
        svg.line(&points, Stroke::new(colour, 2.0));
        for point in points {
            svg.circle(point, 4.0, colour, colour);
        }
    }
    panel.draw_axes(svg);
}

/// Elements per side, and change relative to the finest grid in percent.
fn changes(step: &GridValues) -> Vec<(f64, f64)> {
    let finest = step.levels.last().map_or(f64::NAN, |(_, value)| *value);
    let change =
        |(elements, value): &(usize, f64)| (*elements as f64, 100.0 * (value / finest - 1.0));
    let points = step.levels.iter().map(change);
    points.filter(|(_, change)| change.is_finite()).collect()
}

/// Describes the value and its error estimated from the grids.
fn note(step: &GridValues, unit: Unit, units: Units) -> String {
    let text = quantity(step.value, unit, units);
    match step.error {
        Some(GridErrorNote::Resolved(error)) => {
            format!("{text} {}", error_of(step.value, error, unit, units))
        }
        Some(GridErrorNote::NotResolved) => format!("{text}, not resolved"),
        None => text,
    }
}

/// The axis of the grids: logarithmic in the elements per side.
fn grids(number: &GridNumber) -> Axis {
    let levels = number.steps.iter().flat_map(|step| &step.levels);
    let mut elements: Vec<_> = levels.map(|(elements, _)| *elements).collect();
    elements.sort_unstable();
    elements.dedup();
    let ticks = elements.iter().map(|n| (*n as f64, n.to_string()));
    let (first, last) = (elements.first().copied(), elements.last().copied());
    Axis {
        from: first.unwrap_or(1) as f64 / 1.25,
        to: last.unwrap_or(1) as f64 * 1.25,
        title: "elements per side N".into(),
        ticks: ticks.collect(),
        is_logarithmic: true,
    }
}

fn percent(changes: &[Vec<(f64, f64)>], title: &str) -> Axis {
    let values = || changes.iter().flatten().map(|(_, change)| *change);
    let (low, high) = (values().fold(0.0, f64::min), values().fold(0.0, f64::max));
    let length = if high > low { high - low } else { 1.0 };
    let (low, high) = (low - MARGIN * length, high + MARGIN * length);
    Axis::new(low, high, title.to_owned(), 6)
}

fn colour(step: usize, steps: usize) -> Colour {
    ColourMap::Viridis.at(LIGHTEST * step as f64 / (steps.max(2) - 1) as f64)
}
