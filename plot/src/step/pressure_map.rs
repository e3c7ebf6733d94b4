//! The pressure of one loading step over the surface, with the outlines of the contact and of the relief.

use crate::axes::colour_bar;
use crate::axes::labels;
use crate::axes::panel::{Axis, Panel};
use crate::sheet::colour_map::ColourScale;
use crate::sheet::colours::{self, Colour};
use crate::sheet::heading;
use crate::sheet::raster::Raster;
use crate::sheet::svg::{Anchor, Rect, Stroke, Svg};
use crate::step::coarse_field::CoarseField;
use crate::step::crop::Crop;
use crate::step::outline;
use crate::step::subject::Subject;

/// The rectangle of the map, in pixels.
pub(super) const MAP: Rect = Rect::at((112.0, heading::HEIGHT), (760.0, 760.0));
const BELOW: f64 = 72.0;
const GAP: f64 = 28.0;
const BAR: f64 = 30.0;
/// Width of the picture, in pixels.
pub const WIDTH: f64 = MAP.left + MAP.width + GAP + BAR + colour_bar::BESIDE;
pub(super) const HEIGHT: f64 = MAP.top + MAP.height + BELOW;

/// Largest number of cells drawn along a side: about one per pixel.
pub const CELLS: usize = 760;

/// Width of the outlines, in pixels.
const OUTLINE: f64 = 1.2;

/// Draws the picture as SVG.
#[must_use]
pub fn draw(subject: &Subject<'_>) -> String {
    let fields = &subject.fields;
    let crop = Crop::around_contact(fields.pressure, fields.size);
    let coarse = CoarseField::new(fields, &crop, CELLS);
    let (scale, shades) = subject.pressures();
    let mut svg = subject.style.sheet(WIDTH, HEIGHT);
    subject.draw_heading(&mut svg, MAP.left, WIDTH - MAP.left, "");
    let (panel, metres) = panel(subject, coarse.ends());
    let pascals = ColourScale {
        from: shades.from * scale.divisor,
        to: shades.to * scale.divisor,
        ..shades
    };
    draw_field(&mut svg, &panel, &coarse, metres, &pascals);
    panel.draw_axes(&mut svg);
    draw_bar(
        &mut svg,
        &shades,
        &labels::axis_title("pressure p", &scale.label),
    );
    draw_legend(&mut svg, fields.mask.contains(&true));
    svg.finish()
}

/// Returns the panel of a map whose sides along x and y have these ends, m, with axes in a suitable unit, and the
/// divisor for that unit.
pub(super) fn panel(subject: &Subject<'_>, [x, y]: [[f64; 2]; 2]) -> (Panel, f64) {
    let farthest = [x, y].concat().into_iter().map(f64::abs);
    let scale = subject.metres(farthest.fold(0.0, f64::max));
    let along = |[from, to]: [f64; 2], symbol| {
        let title = labels::axis_title(symbol, &scale.label);
        Axis::new(from / scale.divisor, to / scale.divisor, title, 7)
    };
    let panel = Panel {
        place: MAP,
        x: along(x, "x"),
        y: along(y, "y"),
    };
    (panel, scale.divisor)
}

/// Draws pressure, relief and outlines on a panel; coordinates are divided by `divisor`.
pub fn draw_field(
    svg: &mut Svg,
    panel: &Panel,
    coarse: &CoarseField,
    divisor: f64,
    shades: &ColourScale,
) {
    let place = within(panel, coarse.ends(), divisor);
    let cells = coarse.cells;
    let colour = |i, j: usize| colour(coarse, i, cells - 1 - j, shades);
    svg.image(place, &Raster::of(cells, cells, colour));
    let relief = |i, j| coarse.is_relief(i, j);
    draw_outline(svg, place, cells, relief, pen(colours::RELIEF_OUTLINE));
    let contact = |i, j| coarse.pressure(i, j) > 0.0;
    draw_outline(svg, place, cells, contact, pen(colours::INK));
}

/// Returns the rectangle on a panel of a square whose sides have these ends, divided by `divisor`.
pub(super) fn within(panel: &Panel, ends: [[f64; 2]; 2], divisor: f64) -> Rect {
    let [[left, right], [low, high]] = ends.map(|ends| ends.map(|x| x / divisor));
    let ((left, top), (right, bottom)) = (panel.at(left, high), panel.at(right, low));
    Rect::at((left, top), (right - left, bottom - top))
}

/// Draws the outline of the cells for which `inside` holds.
pub(crate) fn draw_outline(
    svg: &mut Svg,
    field: Rect,
    cells: usize,
    inside: impl Fn(usize, usize) -> bool,
    stroke: Stroke,
) {
    let (width, height) = (field.width / cells as f64, field.height / cells as f64);
    let place = |(i, j)| {
        let [i, j]: [usize; 2] = [i, j];
        (
            field.left + width * i as f64,
            field.bottom() - height * j as f64,
        )
    };
    let lines = outline::trace(cells, inside).into_iter();
    let lines: Vec<Vec<_>> = lines
        .map(|line| line.into_iter().map(place).collect())
        .collect();
    svg.lines(&lines, stroke);
}

/// Stroke of an outline.
pub(crate) fn pen(colour: Colour) -> Stroke {
    Stroke::new(colour, OUTLINE)
}

/// Draws the bar beside the map.
pub(super) fn draw_bar(svg: &mut Svg, shades: &ColourScale, title: &str) {
    let bar = Rect {
        left: MAP.right() + GAP,
        width: BAR,
        ..MAP
    };
    colour_bar::draw(svg, bar, shades, title);
}

/// Draws the legend of grey below the bar.
fn draw_legend(svg: &mut Svg, has_relief: bool) {
    if !has_relief {
        return;
    }
    let swatch = Rect::at((MAP.right() + GAP, MAP.bottom() + 28.0), (18.0, 18.0));
    svg.rectangle(swatch, colours::RELIEF);
    let place = (swatch.right() + 8.0, swatch.top + 9.0);
    svg.text(place, 15.0, Anchor::Start, "free relief");
}

/// Returns the colour of a cell.
#[must_use]
pub fn colour(coarse: &CoarseField, i: usize, j: usize, shades: &ColourScale) -> Colour {
    let pressure = coarse.pressure(i, j);
    match (pressure > 0.0, coarse.is_relief(i, j)) {
        (true, _) => shades.colour(pressure),
        (false, true) => colours::RELIEF,
        (false, false) => colours::BARE,
    }
}
