//! The change of penetration, contact area and largest pressure from grid to grid.

use pellicle_contact::{ErrorEstimate, GridError, LevelValues};
use pellicle::display::{Unit, error_of, quantity};
use pellicle::input::units::Units;
use pellicle::summary::{RunSummary, StepSummary};

use super::colour_map::ColourMap;
use super::colours::Colour;
use super::heading;
use super::panel::{Axis, Panel};
use super::style::{Heading, Style};
use super::svg::{Anchor, Rect, Stroke, Svg};

/// File name of the picture, without extension.
pub const NAME: &str = "convergence";

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

/// A result that has a value on every grid.
#[derive(Clone, Copy)]
struct Number {
    name: &'static str,
    unit: Unit,
    on_level: fn(&LevelValues) -> f64,
    value: fn(&StepSummary) -> f64,
    estimate: fn(&GridError) -> Option<ErrorEstimate>,
}

const NUMBERS: [Number; 3] = [
    Number {
        name: "penetration D",
        unit: Unit::Metre,
        on_level: |level| level.penetration,
        value: |step| step.penetration,
        estimate: |error| error.penetration,
    },
    Number {
        name: "contact area",
        unit: Unit::SquareMetre,
        on_level: |level| level.contact_area,
        value: |step| step.summary.contact_area,
        estimate: |error| error.contact_area,
    },
    Number {
        name: "largest pressure",
        unit: Unit::Pascal,
        on_level: |level| level.max_pressure,
        value: |step| step.summary.max_pressure,
        estimate: |error| error.max_pressure,
    },
];

/// Whether the run has more than one grid, which the picture needs.
#[must_use]
pub fn is_drawn(summary: &RunSummary) -> bool {
    let mut steps = summary.steps.iter();
    steps.any(|step| step.grid_error.levels.len() > 1)
}

/// Draws the picture as SVG; `None` for a run on one grid.
#[must_use]
pub fn draw(summary: &RunSummary, style: &Style) -> Option<String> {
    if !is_drawn(summary) {
        return None;
    }
    let mut svg = style.sheet(WIDTH, HEIGHT);
    let numbers = match summary.steps.len() {
        1 => "change against the finest grid".to_owned(),
        steps => {
            format!("change against the finest grid; {steps} loading steps, from dark to light")
        }
    };
    if style.heading == Heading::Shown {
        heading::draw(&mut svg, LEFT, WIDTH - LEFT, &summary.title, &numbers);
    }
    for (i, number) in NUMBERS.into_iter().enumerate() {
        let left = LEFT + i as f64 * (PANEL_WIDTH + BETWEEN);
        draw_panel(&mut svg, summary, left, number);
    }
    Some(svg.finish())
}

fn draw_panel(svg: &mut Svg, summary: &RunSummary, left: f64, number: Number) {
    let changes: Vec<_> = summary
        .steps
        .iter()
        .map(|step| changes(step, number))
        .collect();
    let title = if left > LEFT { "" } else { "change, %" };
    let panel = Panel {
        place: Rect::at((left, TOP), (PANEL_WIDTH, PANEL_HEIGHT)),
        x: grids(summary),
        y: percent(&changes, title),
    };
    svg.text((left, TOP - 40.0), 18.0, Anchor::Start, number.name);
    if let [step] = &summary.steps[..] {
        let note = note(step, number, summary.units);
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
fn changes(step: &StepSummary, number: Number) -> Vec<(f64, f64)> {
    let levels = &step.grid_error.levels;
    let finest = levels.last().map_or(f64::NAN, number.on_level);
    let change = |level: &LevelValues| 100.0 * ((number.on_level)(level) / finest - 1.0);
    let points = levels
        .iter()
        .map(|level| (level.elements as f64, change(level)));
    points.filter(|(_, change)| change.is_finite()).collect()
}

/// Describes the value and its error estimated from the grids.
fn note(step: &StepSummary, number: Number, units: Units) -> String {
    let value = (number.value)(step);
    let text = quantity(value, number.unit, units);
    match (number.estimate)(&step.grid_error) {
        Some(estimate) if estimate.resolved => {
            format!(
                "{text} {}",
                error_of(value, estimate.estimate, number.unit, units)
            )
        }
        Some(_) => format!("{text}, not resolved"),
        None => text,
    }
}

/// The axis of the grids: logarithmic in the elements per side.
fn grids(summary: &RunSummary) -> Axis {
    let levels = summary
        .steps
        .iter()
        .flat_map(|step| &step.grid_error.levels);
    let mut elements: Vec<_> = levels.map(|level| level.elements).collect();
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
