//! Contact fraction over reduced pressure of a rough contact, with the lines of two theories, on logarithmic axes.

use std::f64::consts::{PI, TAU};

use crate::axes::panel::{Axis, Panel};
use crate::sheet::colours::{self, Colour};
use crate::sheet::heading;
use crate::sheet::style::{Heading, Style};
use crate::sheet::svg::{Anchor, Rect, Stroke};

const PLACE: Rect = Rect::at((132.0, heading::HEIGHT + 8.0), (620.0, 460.0));
const WIDTH: f64 = PLACE.left + PLACE.width + 36.0;
/// Height of a line of the legend, and distance of the legend below the panel.
const ENTRY: f64 = 28.0;
const LEGEND: f64 = 86.0;

/// Points of a line.
const POINTS: u32 = 200;

/// Pressures shown below the least and above the largest of the steps, as a factor.
const MARGIN: f64 = 3.0;

/// A theory of the contact fraction as a function of the reduced pressure.
type Theory = fn(f64) -> f64;

/// Words, colour and line of the theories.
const THEORIES: [(&str, Colour, Theory); 2] = [
    (
        "Bush, Gibson and Thomas: κ = √(2π), for light loads",
        colours::ORANGE,
        bush_gibson_thomas,
    ),
    (
        "Persson: erf(√2 p*), κ = √(8/π) for light loads",
        colours::BLUE,
        persson,
    ),
];

/// Whether there is a point to draw.
#[must_use]
pub fn is_drawn(points: &[(f64, f64)]) -> bool {
    points.iter().any(is_shown)
}

/// Draws the contact fractions of some steps over their reduced pressures `p* = p̄/(E* h'_rms)` as SVG; `None` without
/// contact.
#[must_use]
pub fn draw(title: &str, points: &[(f64, f64)], style: &Style) -> Option<String> {
    let points: Vec<_> = points.iter().copied().filter(is_shown).collect();
    if points.is_empty() {
        return None;
    }
    let mut svg = style.sheet(WIDTH, PLACE.bottom() + LEGEND + 3.0 * ENTRY);
    if style.heading == Heading::Shown {
        let numbers = "contact fraction of a rough surface";
        heading::draw(&mut svg, PLACE.left, WIDTH - PLACE.left, title, numbers);
    }
    let ends = |values: &mut dyn Iterator<Item = f64>| {
        values.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), value| {
            (low.min(value), high.max(value))
        })
    };
    let (least, most) = ends(&mut points.iter().map(|point| point.0));
    let (from, to) = (least / MARGIN, most * MARGIN);
    let fractions = points.iter().map(|point| point.1);
    let (low, high) = ends(&mut fractions.chain([persson(from), bush_gibson_thomas(to).min(1.0)]));
    let panel = Panel {
        place: PLACE,
        x: Axis::logarithmic(from, to, "reduced pressure p* = p̄/(E* h′ rms)".into()),
        y: Axis::logarithmic(low, high, "contact fraction A/A₀".into()),
    };
    panel.draw_mesh(&mut svg);
    let left = PLACE.left;
    for (k, (words, colour, theory)) in THEORIES.into_iter().enumerate() {
        let step = (to / from).powf(1.0 / f64::from(POINTS));
        let pressures = (0..=POINTS).map(|k| from * step.powf(f64::from(k)));
        let places = panel.all_at(pressures.map(|pressure| (pressure, theory(pressure))));
        svg.within(PLACE, |svg| svg.line(&places, Stroke::new(colour, 2.0)));
        let y = PLACE.bottom() + LEGEND + ENTRY * k as f64;
        svg.line(&[(left, y), (left + 40.0, y)], Stroke::new(colour, 2.0));
        svg.text((left + 50.0, y), 16.0, Anchor::Start, words);
    }
    svg.dots(&panel.all_at(points.iter().copied()), 4.0, colours::INK);
    let y = PLACE.bottom() + LEGEND + 2.0 * ENTRY;
    svg.dots(&[(left + 20.0, y)], 4.0, colours::INK);
    svg.text((left + 50.0, y), 16.0, Anchor::Start, &words(&points));
    panel.draw_axes(&mut svg);
    Some(svg.finish())
}

/// `solved: κ = 2.10`, or its range.
fn words(points: &[(f64, f64)]) -> String {
    let ratios = points
        .iter()
        .map(|(pressure, fraction)| fraction / pressure);
    let (least, most) = ratios.fold((f64::INFINITY, 0.0_f64), |(least, most), ratio| {
        (least.min(ratio), most.max(ratio))
    });
    if points.len() == 1 {
        format!("solved: κ = {most:.2}")
    } else {
        format!("solved: κ from {least:.2} to {most:.2}")
    }
}

fn is_shown((pressure, fraction): &(f64, f64)) -> bool {
    [pressure, fraction]
        .into_iter()
        .all(|value| *value > 0.0 && value.is_finite())
}

/// `A/A_0 = √(2π) p*` (Bush, Gibson and Thomas 1975).
fn bush_gibson_thomas(pressure: f64) -> f64 {
    TAU.sqrt() * pressure
}

/// `A/A_0 = erf(√2 p*)` (Persson 2001).
fn persson(pressure: f64) -> f64 {
    error_function(2.0_f64.sqrt() * pressure)
}

/// `erf z = 2/√π exp(−z²) Σ 2ⁿ z²ⁿ⁺¹/(1·3·5 … (2n + 1))` for z ≥ 0: all terms are positive.
fn error_function(z: f64) -> f64 {
    /// Beyond, erf is 1 to rounding.
    const ONE: f64 = 6.0;
    if z > ONE {
        return 1.0;
    }
    let (mut term, mut sum, mut n) = (z, 0.0, 0.0);
    while term > f64::EPSILON * sum {
        sum += term;
        n += 1.0;
        term *= 2.0 * z * z / (2.0 * n + 1.0);
    }
    2.0 / PI.sqrt() * (-z * z).exp() * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_function_has_the_values_of_its_tables() {
        // Abramowitz and Stegun, table 7.1.
        for (z, wanted) in [
            (0.0, 0.0),
            (0.5, 0.520_499_877_8),
            (1.0, 0.842_700_792_9),
            (2.0, 0.995_322_265_0),
        ] {
            assert!((error_function(z) - wanted).abs() < 1e-10, "{z}");
        }
        assert!((error_function(7.0) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn both_theories_begin_with_their_slopes() {
        let slope = |theory: Theory| theory(1e-6) / 1e-6;
        assert!((slope(bush_gibson_thomas) / 2.5066 - 1.0).abs() < 1e-4);
        assert!((slope(persson) / 1.5958 - 1.0).abs() < 1e-4);
    }

    #[test]
    fn a_picture_names_its_theories_and_the_solved_ratio_and_needs_contact() {
        let svg = draw("scan", &[(0.01, 0.02), (0.0, 0.0)], &Style::default());
        let svg = svg.expect("a point");
        for words in ["Persson", "Bush, Gibson and Thomas", "κ = 2.00"] {
            assert!(svg.contains(words), "{words}");
        }
        assert!(!is_drawn(&[(0.0, 0.0)]) && draw("", &[], &Style::default()).is_none());
    }
}
