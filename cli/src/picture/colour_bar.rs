//! The bar of a picture's colours, with the values beside it.

use super::colour_map::ColourScale;
use super::panel::LABEL;
use super::raster::Raster;
use super::svg::{Anchor, Rect, Stroke, Svg, TextDirection};
use super::{colours, labels, ticks};

/// Width of the labels and the title beside the bar, in pixels.
pub const BESIDE: f64 = 112.0;

/// Colours in the bar.
const SHADES: usize = 256;

const TITLE: f64 = 18.0;
/// A digit of a label is about this wide.
const DIGIT: f64 = 0.64 * LABEL;
const TICK: f64 = 6.0;

/// Draws the bar of these colours, whose values have this title.
pub fn draw(svg: &mut Svg, place: Rect, shades: &ColourScale, title: &str) {
    let (from, to) = (shades.from, shades.to);
    let shade = |_, j| shades.map.at((SHADES - 1 - j) as f64 / (SHADES - 1) as f64);
    svg.image(place, &Raster::of(1, SHADES, shade));
    let stroke = Stroke::new(colours::INK, 1.2);
    let right = place.right();
    let ticks = ticks::linear(from, to, 6);
    let label = |tick: &f64| labels::tick(*tick, to - from);
    let labels: Vec<_> = ticks.iter().map(label).collect();
    for (tick, label) in ticks.iter().zip(&labels) {
        let y = place.bottom() - place.height * (tick - from) / (to - from);
        svg.line(&[(right, y), (right + TICK, y)], stroke);
        svg.text((right + TICK + 5.0, y), LABEL, Anchor::Start, label);
    }
    let longest = labels.iter().map(|label| label.chars().count()).max();
    let beside = TICK + 5.0 + DIGIT * longest.unwrap_or(0) as f64 + TITLE;
    let middle = (
        right + beside.min(BESIDE - TITLE),
        place.top.midpoint(place.bottom()),
    );
    svg.directed_text(middle, TITLE, Anchor::Middle, TextDirection::Up, title);
}
