//! A sheet with panels of curves and one legend, and the table of the points.

use std::fmt::Write as _;

use pellicle_cli::drawing::colours::Colour;
use pellicle_cli::drawing::{Anchor, Axis, Dash, Panel, Rect, Stroke, Svg};

use super::sheet::{Caption, Picture, TOP};

/// Distance from the left side of a column to its panel, in pixels.
const LEFT: f64 = 112.0;

/// Sizes of letters and marks, in pixels.
const TITLE: f64 = 17.0;
const LEGEND: f64 = 17.0;
const MARK: f64 = 3.2;

/// Room above the legend, distance between its rows, length of a line in it, and distance from the line to its label.
const ABOVE: f64 = 14.0;
const ROW: f64 = 26.0;
const SAMPLE: f64 = 44.0;
const GAP: f64 = 8.0;

/// Panels of curves, in two columns, below the legend of the first. Lengths are in pixels.
pub(super) struct Chart {
    pub name: &'static str,
    pub caption: Caption,
    /// Width and height of a panel.
    pub panel: (f64, f64),
    /// Margins above a panel, to its right and below.
    pub margins: [f64; 3],
    /// Columns of the legend, and their width.
    pub legend: (usize, f64),
    /// The first curve in the legend; those before it come last.
    pub legend_from: usize,
    pub panels: Vec<CurvePanel>,
}

/// A panel of curves.
pub(super) struct CurvePanel {
    /// Its name in the table.
    pub name: &'static str,
    /// The words above it.
    pub title: String,
    pub axes: [Axis; 2],
    pub lines: Vec<ChartLine>,
}

/// Colour and dash of a curve.
pub(super) type Pen = (Colour, Dash);

/// A curve in one or more parts, each a list of points.
pub(super) struct ChartLine {
    /// Its name in the legend and in the table.
    pub name: String,
    pub pen: Pen,
    /// Width in pixels.
    pub width: f64,
    /// Whether its points are marked.
    pub is_marked: bool,
    pub parts: Vec<Vec<(f64, f64)>>,
}

impl Chart {
    /// Draws the chart as a picture; curves are clipped at the frames of panels.
    pub(super) fn draw(&self) -> Picture {
        let (panel, [above, right, below]) = (self.panel, self.margins);
        let columns = self.panels.len().min(2);
        let (width, height) = (LEFT + panel.0 + right, above + panel.1 + below);
        let entries = self.panels[0].lines.len();
        let legend = ABOVE + ROW * entries.div_ceil(self.legend.0) as f64;
        let rows = self.panels.len().div_ceil(columns);
        let size = (width * columns as f64, legend + height * rows as f64);
        let mut svg = self.caption.sheet(size);
        for (i, curves) in self.panels.iter().enumerate() {
            let place = Rect {
                left: width * (i % columns) as f64 + LEFT,
                top: TOP + legend + height * (i / columns) as f64 + above,
                width: panel.0,
                height: panel.1,
            };
            curves.draw(&mut svg, place);
        }
        self.draw_legend(&mut svg);
        let tables = self.panels.iter();
        Picture {
            name: self.name,
            svg: svg.finish(),
            width: size.0,
            csv: csv(tables.map(|panel| (panel.name, panel.lines.as_slice()))),
        }
    }

    fn draw_legend(&self, svg: &mut Svg) {
        let (columns, column) = self.legend;
        let (last, first) = self.panels[0].lines.split_at(self.legend_from);
        for (i, line) in first.iter().chain(last).enumerate() {
            let x = LEFT + column * (i % columns) as f64;
            let y = TOP + 12.0 + ROW * (i / columns) as f64;
            let (colour, dash) = line.pen;
            let sample = [(x, y), (x + SAMPLE, y)];
            svg.broken_lines(&[sample], Stroke::new(colour, 3.0), dash);
            svg.text((x + SAMPLE + GAP, y), LEGEND, Anchor::Start, &line.name);
        }
    }
}

impl CurvePanel {
    fn draw(&self, svg: &mut Svg, place: Rect) {
        let [x, y] = self.axes.clone();
        let panel = Panel { place, x, y };
        let above = (place.left, place.top - 20.0);
        svg.text(above, TITLE, Anchor::Start, &self.title);
        panel.draw_mesh(svg);
        svg.within(place, |svg| {
            self.lines.iter().for_each(|line| line.draw(svg, &panel));
        });
        panel.draw_axes(svg);
    }
}

impl ChartLine {
    /// A line of the usual width.
    pub(super) fn new(name: impl Into<String>, pen: Pen, parts: Vec<Vec<(f64, f64)>>) -> Self {
        Self {
            name: name.into(),
            pen,
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
        let (colour, dash) = self.pen;
        let place = |part: &Vec<(f64, f64)>| panel.all_at(part.iter().copied());
        let parts: Vec<_> = self.parts.iter().map(place).collect();
        svg.broken_lines(&parts, Stroke::new(colour, self.width), dash);
        if self.is_marked {
            for point in parts.into_iter().flatten() {
                svg.circle(point, MARK, colour, colour);
            }
        }
    }
}

/// A table of the points of curves: panel, curve, x, y, with all digits.
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

/// Quotes a text as a cell of a table.
pub(super) fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('"', "\"\""))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_keeps_every_bit_of_every_point() {
        let third = 1.0 / 3.0;
        let parts = vec![vec![(1.0, third)], vec![(2.0, -third)]];
        let line = ChartLine::new("a, b", (Colour(0, 0, 0), Dash::Solid), parts);
        let table = csv([("p", [line].as_slice())]);
        let rows: Vec<_> = table.lines().collect();
        assert_eq!(rows.len(), 3);
        assert!(rows[1].starts_with("\"p\",\"a, b\",1e0,"));
        let last: f64 = rows[2].rsplit(',').next().unwrap().parse().unwrap();
        assert_eq!(last.to_bits(), (-third).to_bits());
    }
}
