//! Panels of curves, their legend, and the table of their points.

use std::fmt::Write as _;

use pellicle_cli::drawing::colours::Colour;
use pellicle_cli::drawing::{Anchor, Dash, Rect, Stroke, Svg};
use pellicle_cli::drawing::{Axis, Panel};

use super::sheet::Sheet;

/// From the sheet's left side to the first panel, in pixels.
pub(super) const LEFT: f64 = 112.0;
/// Room below a panel for its axis, in pixels.
pub(super) const AXIS: f64 = 76.0;

/// Sizes of letters and marks, in pixels.
const TITLE: f64 = 17.0;
const LEGEND: f64 = 17.0;
const MARK: f64 = 3.2;

/// Length of a line in the legend, from there to its words, and from row to row.
const SAMPLE: f64 = 44.0;
const GAP: f64 = 8.0;
const ROW: f64 = 26.0;

/// A curve in one or more parts, each a list of points.
pub(super) struct ChartLine {
    /// Its name in the legend and in the table.
    pub name: String,
    pub colour: Colour,
    pub dash: Dash,
    /// In pixels.
    pub width: f64,
    /// Whether its points are marked.
    pub is_marked: bool,
    pub parts: Vec<Vec<(f64, f64)>>,
}

impl ChartLine {
    /// A solid line of usual width.
    pub(super) fn new(name: String, colour: Colour, parts: Vec<Vec<(f64, f64)>>) -> Self {
        Self {
            name,
            colour,
            dash: Dash::Solid,
            width: 2.2,
            is_marked: false,
            parts,
        }
    }

    /// All its points.
    pub(super) fn points(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.parts.iter().flatten().copied()
    }

    fn draw(&self, svg: &mut Svg, panel: &Panel) {
        let Self { colour, width, .. } = *self;
        let place = |part: &Vec<(f64, f64)>| panel.all_at(part.iter().copied());
        let parts: Vec<_> = self.parts.iter().map(place).collect();
        svg.broken_lines(&parts, Stroke { colour, width }, self.dash);
        if self.is_marked {
            for point in parts.into_iter().flatten() {
                svg.circle(point, MARK, colour, colour);
            }
        }
    }
}

/// Draws curves on a panel, with a title above it; what leaves the panel is cut off at its frame.
pub(super) fn draw(
    svg: &mut Svg,
    title: &str,
    place: Rect,
    [x, y]: [Axis; 2],
    lines: &[ChartLine],
) {
    let panel = Panel { place, x, y };
    svg.text((place.left, place.top - 20.0), TITLE, Anchor::Start, title);
    panel.draw_mesh(svg);
    svg.within(place, |svg| {
        lines.iter().for_each(|line| line.draw(svg, &panel));
    });
    panel.draw_axes(svg);
}

/// Draws the legend of curves above the panels, row by row in so many columns of this width.
pub(super) fn legend<'a>(
    svg: &mut Svg,
    (columns, width): (usize, f64),
    lines: impl IntoIterator<Item = &'a ChartLine>,
) {
    for (i, line) in lines.into_iter().enumerate() {
        let x = LEFT + width * (i % columns) as f64;
        let y = Sheet::TOP + 12.0 + ROW * (i / columns) as f64;
        let (colour, width) = (line.colour, 3.0);
        svg.broken_lines(
            &[[(x, y), (x + SAMPLE, y)]],
            Stroke { colour, width },
            line.dash,
        );
        svg.text((x + SAMPLE + GAP, y), LEGEND, Anchor::Start, &line.name);
    }
}

/// A table of the points of curves: panel, curve, x, y, every bit of the numbers.
pub(super) fn csv<'a>(panels: impl IntoIterator<Item = (&'a str, &'a [ChartLine])>) -> String {
    let mut text = String::from("panel,curve,x,y\n");
    for (panel, lines) in panels {
        for line in lines {
            let (panel, name) = (quoted(panel), quoted(&line.name));
            for (x, y) in line.points() {
                // Writing to a string does not fail.
                let _ = writeln!(text, "{panel},{name},{x:e},{y:e}");
            }
        }
    }
    text
}

/// A text as a cell of a table.
pub(super) fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_holds_every_bit_of_every_point() {
        let third = 1.0 / 3.0;
        let parts = vec![vec![(1.0, third)], vec![(2.0, -third)]];
        let line = ChartLine::new("a, b".into(), Colour(0, 0, 0), parts);
        let table = csv([("p", [line].as_slice())]);
        let rows: Vec<_> = table.lines().collect();
        assert_eq!(rows.len(), 3);
        assert!(rows[1].starts_with("\"p\",\"a, b\",1e0,"));
        let last: f64 = rows[2].rsplit(',').next().unwrap().parse().unwrap();
        assert_eq!(last.to_bits(), (-third).to_bits());
    }
}
