//! The colour bar of a picture, with the values beside it.

use crate::axes::contour_bands::ContourBands;
use crate::axes::labels;
use crate::axes::panel::LABEL;
use crate::axes::ticks;
use crate::sheet::colour_map::ColourScale;
use crate::sheet::colours;
use crate::sheet::raster::Raster;
use crate::sheet::svg::{Anchor, Rect, Stroke, Svg, TextDirection};

/// Width of the labels and the title beside the bar, in pixels.
pub const BESIDE: f64 = 112.0;

/// Colours in the bar.
const SHADES: usize = 256;

const TITLE: f64 = 18.0;
/// Width of a digit of a label, about.
const DIGIT: f64 = 0.64 * LABEL;
const TICK: f64 = 6.0;

/// Draws the bar of a colour scale, with a title for its values.
pub fn draw(svg: &mut Svg, place: Rect, shades: &ColourScale, title: &str) {
    let (from, to) = (shades.from, shades.to);
    let shade = |_, j| shades.map.at((SHADES - 1 - j) as f64 / (SHADES - 1) as f64);
    svg.image(place, &Raster::of(1, SHADES, shade));
    let ticks = ticks::linear(from, to, 6).into_iter();
    let at = |tick: f64| place.bottom() - place.height * (tick - from) / (to - from);
    let labelled = ticks.map(|tick| (at(tick), labels::tick(tick, to - from)));
    draw_labels(svg, place, &labelled.collect::<Vec<_>>(), title);
}

/// Draws a bar of bands of equal height, with their levels beside it.
pub fn draw_bands(svg: &mut Svg, place: Rect, bands: &ContourBands, title: &str) {
    let height = place.height / bands.colours().len() as f64;
    for (i, colour) in bands.colours().iter().enumerate() {
        let top = place.bottom() - height * (i + 1) as f64;
        let band = Rect {
            top,
            height,
            ..place
        };
        svg.rectangle(band, *colour);
    }
    let labels = bands.levels.iter().enumerate().map(|(i, level)| {
        let at = place.bottom() - height * (i + 1) as f64;
        (at, bands.label(*level))
    });
    let frame = [
        (place.left, place.top),
        (place.left, place.bottom()),
        (place.right(), place.bottom()),
        (place.right(), place.top),
        (place.left, place.top),
    ];
    svg.line(&frame, Stroke::new(colours::INK, 1.0));
    draw_labels(svg, place, &labels.collect::<Vec<_>>(), title);
}

/// Draws labels beside the bar at their heights, and the title beside the labels.
fn draw_labels(svg: &mut Svg, place: Rect, labels: &[(f64, String)], title: &str) {
    let stroke = Stroke::new(colours::INK, 1.2);
    let right = place.right();
    for (y, label) in labels {
        svg.line(&[(right, *y), (right + TICK, *y)], stroke);
        svg.text((right + TICK + 5.0, *y), LABEL, Anchor::Start, label);
    }
    let longest = labels.iter().map(|(_, label)| label.chars().count()).max();
    let beside = TICK + 5.0 + DIGIT * longest.unwrap_or(0) as f64 + TITLE;
    let middle = (
        right + beside.min(BESIDE - TITLE),
        place.top.midpoint(place.bottom()),
    );
    svg.directed_text(middle, TITLE, Anchor::Middle, TextDirection::Up, title);
}
