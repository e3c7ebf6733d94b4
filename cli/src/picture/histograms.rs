//! Histograms of the pressures in contact and of the gaps beside it, relative to the mean pressure and the mean gap.

use pellicle_contact::Histogram;

use super::colours::{self, Colour};
use super::heading;
use super::panel::{Axis, Panel};
use super::subject::Subject;
use super::svg::{Anchor, Rect, Stroke, Svg};
use crate::display::{Unit, quantity};

const LEFT: f64 = 100.0;
const TOP: f64 = heading::HEIGHT + 36.0;
const SIDE: f64 = 400.0;
const BETWEEN: f64 = 110.0;
const WIDTH: f64 = LEFT + 2.0 * SIDE + BETWEEN + 36.0;
const HEIGHT: f64 = TOP + SIDE + 72.0;

/// Space above the tallest class, as a fraction of its height.
const MARGIN: f64 = 0.06;

/// Returns the file name of a step's picture, without extension.
#[must_use]
pub fn name(step: usize) -> String {
    format!("histograms-{step:03}")
}

/// Draws the picture as SVG.
#[must_use]
pub fn draw(subject: &Subject<'_>) -> String {
    let mut svg = subject.style.sheet(WIDTH, HEIGHT);
    subject.draw_heading(&mut svg, LEFT, WIDTH - LEFT, "");
    let Some(rough) = &subject.step.rough_contact else {
        svg.text((LEFT, TOP), 18.0, Anchor::Start, "no contact");
        return svg.finish();
    };
    let (mean_pressure, mean_gap) = (subject.step.summary.mean_pressure, rough.mean_gap);
    let written = |value, unit| quantity(value, unit, subject.units);
    let pressures = format!("mean pressure {}", written(mean_pressure, Unit::Pascal));
    let gaps = format!("mean gap {}", written(mean_gap, Unit::Metre));
    let right = LEFT + SIDE + BETWEEN;
    draw_panel(
        &mut svg,
        LEFT,
        (&rough.pressures, mean_pressure),
        "p / mean p",
        &pressures,
        colours::BLUE,
    );
    draw_panel(
        &mut svg,
        right,
        (&rough.gaps, mean_gap),
        "g / mean g",
        &gaps,
        colours::GREEN,
    );
    svg.finish()
}

fn draw_panel(
    svg: &mut Svg,
    left: f64,
    (histogram, mean): (&Histogram, f64),
    title: &str,
    note: &str,
    colour: Colour,
) {
    svg.text((left, TOP - 20.0), 17.0, Anchor::Start, note);
    let densities = densities(histogram, mean);
    if densities.is_empty() {
        return;
    }
    let tallest = densities.iter().copied().fold(0.0, f64::max);
    let class = histogram.largest / mean / densities.len() as f64;
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
fn densities(histogram: &Histogram, mean: f64) -> Vec<f64> {
    let total: usize = histogram.counts.iter().sum();
    let width = histogram.largest / mean / histogram.counts.len() as f64;
    if total == 0 || !width.is_finite() {
        return Vec::new();
    }
    let density = |count: &usize| *count as f64 / total as f64 / width;
    histogram.counts.iter().map(density).collect()
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
        let histogram = Histogram {
            largest: 6.0,
            counts: vec![5, 3, 2, 0, 0, 1],
        };
        let densities = densities(&histogram, 2.0);
        // The classes are half a mean wide.
        let area: f64 = densities.iter().map(|density| 0.5 * density).sum();
        assert!((area - 1.0).abs() < 1e-15 && densities.len() == 6);
        let nothing = Histogram {
            largest: 0.0,
            counts: Vec::new(),
        };
        assert!(super::densities(&nothing, 0.0).is_empty());
    }
}
