//! The section through a surface as it wears, at several sliding distances.

use pellicle::display::{DisplayUnit, Unit, quantity};
use pellicle::input::units::Units;

use crate::axes::labels;
use crate::axes::panel::{Axis, Panel};
use crate::sheet::colour_map::ColourMap;
use crate::sheet::heading;
use crate::sheet::style::{Heading, Style};
use crate::sheet::svg::{Anchor, Rect, Stroke};

const PLACE: Rect = Rect::at((132.0, heading::HEIGHT + 8.0), (620.0, 460.0));
const WIDTH: f64 = PLACE.left + PLACE.width + 36.0;
/// Height of a line of the legend, and distance of the legend below the panel.
const ENTRY: f64 = 28.0;
const LEGEND: f64 = 86.0;
/// Most sections in a picture: more are not told apart.
const MOST: usize = 8;
/// The part of the colour map that is dark enough for lines on white.
const DARK: f64 = 0.85;
/// Ticks of an axis, about.
const TICKS: usize = 6;

/// The heights along x at a sliding distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WornSection<'a> {
    /// Sliding distance, m.
    pub distance: f64,
    /// Heights at points that are equally spaced over the side of the domain, m.
    pub heights: &'a [f64],
}

/// Whether there is a section to draw.
#[must_use]
pub fn is_drawn(sections: &[WornSection<'_>]) -> bool {
    sections.iter().any(|section| section.heights.len() > 1)
}

/// Draws the sections across a domain of this side (m) as SVG, of many some; `None` without any.
#[must_use]
pub fn draw(
    title: &str,
    sections: &[WornSection<'_>],
    (side, units): (f64, Units),
    style: &Style,
) -> Option<String> {
    if !is_drawn(sections) {
        return None;
    }
    let shown = some(sections);
    let legend = ENTRY * shown.len() as f64;
    let mut svg = style.sheet(WIDTH, PLACE.bottom() + LEGEND + legend);
    if style.heading == Heading::Shown {
        let numbers = "section along x through the axis as the surface wears";
        heading::draw(&mut svg, PLACE.left, WIDTH - PLACE.left, title, numbers);
    }
    let all = || shown.iter().flat_map(|section| section.heights);
    let high = all().fold(f64::NEG_INFINITY, |most, height| most.max(*height));
    let low = all().fold(f64::INFINITY, |least, height| least.min(*height));
    let along = DisplayUnit::of(side / 2.0, Unit::Metre, units);
    let across = DisplayUnit::of(high.abs().max(low.abs()), Unit::Metre, units);
    let margin = 0.05 * (high - low).max(f64::MIN_POSITIVE);
    let (half, bottom, top) = (
        side / 2.0 / along.divisor,
        (low - margin) / across.divisor,
        (high + margin) / across.divisor,
    );
    let name = |symbol: &str, unit: &DisplayUnit| labels::axis_title(symbol, &unit.label);
    let panel = Panel {
        place: PLACE,
        x: Axis::new(-half, half, name("x", &along), TICKS),
        y: Axis::new(bottom, top, name("height", &across), TICKS),
    };
    panel.draw_mesh(&mut svg);
    let last = shown.len().saturating_sub(1).max(1) as f64;
    for (k, section) in shown.iter().enumerate() {
        let stroke = Stroke::new(ColourMap::Viridis.at(DARK * k as f64 / last), 2.0);
        let count = section.heights.len() as f64;
        let points = section.heights.iter().enumerate().map(|(i, height)| {
            let x = half * ((2 * i + 1) as f64 / count - 1.0);
            (x, height / across.divisor)
        });
        let places = panel.all_at(points);
        svg.within(PLACE, |svg| svg.line(&places, stroke));
        let y = PLACE.bottom() + LEGEND + ENTRY * k as f64;
        let left = PLACE.left;
        svg.line(&[(left, y), (left + 40.0, y)], stroke);
        let words = format!("after {}", quantity(section.distance, Unit::Metre, units));
        svg.text((left + 50.0, y), 16.0, Anchor::Start, &words);
    }
    panel.draw_axes(&mut svg);
    Some(svg.finish())
}

/// At most some of the sections, the first and the last among them.
fn some<'a>(sections: &[WornSection<'a>]) -> Vec<WornSection<'a>> {
    let drawn: Vec<_> = sections.iter().filter(|of| of.heights.len() > 1).collect();
    let count = drawn.len().min(MOST);
    let index = |k: usize| k * (drawn.len() - 1) / (count - 1).max(1);
    (0..count).map(|k| *drawn[index(k)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_are_drawn_with_their_distances_and_many_are_thinned() {
        let heights = [0.0, -1e-6, -3e-6, -1e-6, 0.0];
        let sections: Vec<_> = (0..20)
            .map(|k| WornSection {
                distance: f64::from(k),
                heights: &heights,
            })
            .collect();
        let drawn = |sections: &[WornSection<'_>]| {
            let style = Style::default();
            draw("title", sections, (1e-4, Units::Si), &style)
        };
        let svg = drawn(&sections).unwrap();
        assert_eq!(svg.matches("after ").count(), MOST);
        assert!(
            svg.contains("after 0 m") && svg.contains("after 19.000 m"),
            "{svg}"
        );
        assert!(drawn(&[]).is_none() && drawn(&sections[..1]).is_some());
    }
}
