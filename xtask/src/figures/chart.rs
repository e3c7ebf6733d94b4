//! A panel of curves with its title, and a legend.

use pellicle_cli::drawing::{Anchor, Rect, Stroke, Svg};
use pellicle_cli::drawing::{Axis, Panel};

use super::line::Line;

/// Sizes of letters, width of lines and marks, in pixels.
const TITLE: f64 = 17.0;
const LEGEND: f64 = 17.0;
const MARK: f64 = 3.2;

/// Length of a line in the legend, and from there to its words.
const SAMPLE: f64 = 44.0;
const GAP: f64 = 8.0;

/// Draws curves on a panel, with a title above it; what leaves the panel is cut off at its frame.
pub(super) fn draw(svg: &mut Svg, title: &str, place: Rect, axes: (Axis, Axis), lines: &[Line]) {
    let (x, y) = axes;
    let panel = Panel { place, x, y };
    svg.text((place.left, place.top - 20.0), TITLE, Anchor::Start, title);
    panel.draw_mesh(svg);
    svg.within(place, |svg| {
        for line in lines {
            draw_line(svg, &panel, line);
        }
    });
    panel.draw_axes(svg);
}

fn draw_line(svg: &mut Svg, panel: &Panel, line: &Line) {
    let colour = line.colour;
    let parts = line
        .parts
        .iter()
        .map(|part| panel.all_at(part.iter().copied()));
    let parts: Vec<Vec<(f64, f64)>> = parts.collect();
    svg.broken_lines(
        &parts,
        Stroke {
            colour,
            width: line.width,
        },
        line.dash,
    );
    if line.is_marked {
        for point in parts.into_iter().flatten() {
            svg.circle(point, MARK, colour, colour);
        }
    }
}

/// Draws the legend of these curves in columns of equal width from a place on, row by row.
pub(super) fn legend(svg: &mut Svg, (left, top): (f64, f64), width: f64, rows: &[&[&Line]]) {
    for (row, lines) in rows.iter().enumerate() {
        let y = top + 26.0 * row as f64;
        for (column, line) in lines.iter().enumerate() {
            let x = left + width * column as f64;
            let colour = line.colour;
            let sample = [[(x, y), (x + SAMPLE, y)]];
            svg.broken_lines(&sample, Stroke { colour, width: 3.0 }, line.dash);
            svg.text((x + SAMPLE + GAP, y), LEGEND, Anchor::Start, &line.name);
        }
    }
}

/// An axis from 0 to a little above the largest of these values.
pub(super) fn from_zero(values: impl Iterator<Item = f64>, title: &str) -> Axis {
    let largest = values.fold(0.0, f64::max);
    Axis::new(0.0, 1.06 * largest, title.into(), 6)
}
