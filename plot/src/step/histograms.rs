//! Histograms of the pressures in contact and of the gaps beside it, relative to the mean pressure and the mean gap.

use pellicle::display::{Unit, quantity};

use crate::axes::panel::{Axis, Panel};
use crate::sheet::colours::{self, Colour};
use crate::sheet::heading;
use crate::sheet::svg::{Anchor, Rect, Stroke, Svg};
use crate::step::subject::Subject;

const LEFT: f64 = 100.0;
const TOP: f64 = heading::HEIGHT + 36.0;
const SIDE: f64 = 400.0;
const BETWEEN: f64 = 110.0;
const WIDTH: f64 = LEFT + 2.0 * SIDE + BETWEEN + 36.0;
const HEIGHT: f64 = TOP + SIDE + 72.0;

/// Space above the tallest class, as a fraction of its height.
const MARGIN: f64 = 0.06;

/// How often a number lies in each of equal classes from 0 to the largest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Distribution<'a> {
    /// The mean of the number.
    pub mean: f64,
    /// The largest number, the end of the last class.
    pub largest: f64,
    /// The numbers in each class.
    pub counts: &'a [usize],
}

/// The distributions of a rough contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoughContact<'a> {
    /// The pressures of the elements in contact, Pa.
    pub pressures: Distribution<'a>,
    /// The gaps of the others, m.
    pub gaps: Distribution<'a>,
}

/// Draws the picture as SVG; without contact there are no distributions.
#[must_use]
pub fn draw(subject: &Subject<'_>, rough: Option<&RoughContact<'_>>) -> String {
    let mut svg = subject.style.sheet(WIDTH, HEIGHT);
    subject.draw_heading(&mut svg, LEFT, WIDTH - LEFT, "");
    let Some(RoughContact { pressures, gaps }) = rough else {
        svg.text((LEFT, TOP), 18.0, Anchor::Start, "no contact");
        return svg.finish();
    };
    let written = |value, unit| quantity(value, unit, subject.units);
    let mean_pressure = format!("mean pressure {}", written(pressures.mean, Unit::Pascal));
    let mean_gap = format!("mean gap {}", written(gaps.mean, Unit::Metre));
    let right = LEFT + SIDE + BETWEEN;
    draw_panel(
        &mut svg,
        LEFT,
        pressures,
        "p / mean p",
        &mean_pressure,
        colours::BLUE,
    );
    draw_panel(
        &mut svg,
        right,
        gaps,
        "g / mean g",
        &mean_gap,
        colours::GREEN,
    );
    svg.finish()
}

fn draw_panel(
    svg: &mut Svg,
    left: f64,
    of: &Distribution<'_>,
    title: &str,
    note: &str,
    colour: Colour,
) {
    svg.text((left, TOP - 20.0), 17.0, Anchor::Start, note);
    let densities = densities(of);
    if densities.is_empty() {
        return;
    }
    let tallest = densities.iter().copied().fold(0.0, f64::max);
    let class = of.largest / of.mean / densities.len() as f64;
    let along_y = if left > LEFT {
        ""
    } else {
        "probability density"
    };
    let panel = Panel {
        place: Rect::at((left, TOP), (SIDE, SIDE)),
        x: Axis::new(0.0, class * densities.len() as f64, title.to_owned(), 6),
        y: Axis::new(0.0, tallest * (1.0 + MARGIN), along_y.to_owned(), 6),
    };
    panel.draw_mesh(svg);
    let steps = densities
        .iter()
        .enumerate()
        .flat_map(|(k, density)| [k, k + 1].map(|end| panel.at(end as f64 * class, *density)));
    let ends = [
        panel.at(0.0, 0.0),
        panel.at(class * densities.len() as f64, 0.0),
    ];
    let line: Vec<_> = std::iter::once(ends[0])
        .chain(steps)
        .chain([ends[1]])
        .collect();
    svg.area(&line, lightened(colour));
    svg.line(&line, Stroke::new(colour, 1.6));
    panel.draw_axes(svg);
}

/// The density of each class of a number over its mean, normalised to an area of 1; empty if there are no numbers.
fn densities(of: &Distribution<'_>) -> Vec<f64> {
    let total: usize = of.counts.iter().sum();
    let width = of.largest / of.mean / of.counts.len() as f64;
    if total == 0 || !width.is_finite() {
        return Vec::new();
    }
    let density = |count: &usize| *count as f64 / total as f64 / width;
    of.counts.iter().map(density).collect()
}

/// Lightens a colour halfway to white, twice.
fn lightened(Colour(red, green, blue): Colour) -> Colour {
    let light = |part: u8| 255 - (255 - part) / 4;
    Colour(light(red), light(green), light(blue))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_area_under_a_density_is_one() {
        let densities = densities(&Distribution {
            mean: 2.0,
            largest: 6.0,
            counts: &[5, 3, 2, 0, 0, 1],
        });
        // The classes are half a mean wide.
        let area: f64 = densities.iter().map(|density| 0.5 * density).sum();
        assert!((area - 1.0).abs() < 1e-15 && densities.len() == 6);
        let nothing = Distribution {
            mean: 0.0,
            largest: 0.0,
            counts: &[],
        };
        assert!(super::densities(&nothing).is_empty());
    }
}
