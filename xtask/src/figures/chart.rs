//! A sheet with panels of curves and one legend, and the table of the points.

use pellicle_plot::axes::panel::{Axis, Panel};
use pellicle_plot::sheet::colours::Colour;
use pellicle_plot::sheet::svg::{Anchor, Dash, Rect, Stroke, Svg};

use super::sheet::{Caption, Picture, TOP, csv};

/// Distance from the left side of a column to its panel, in pixels.
const LEFT: f64 = 112.0;

/// Sizes of letters and marks, in pixels.
const LETTERS: f64 = 17.0;
const MARK: f64 = 3.2;

/// Room above the legend, distance between its rows, length of a line in it, and distance from the line to its label.
const ABOVE: f64 = 14.0;
const ROW: f64 = 26.0;
const SAMPLE: f64 = 44.0;
const GAP: f64 = 8.0;

/// The columns of a table of curves.
pub(super) const COLUMNS: &str = "panel,curve,x,y";

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
#[derive(Clone)]
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
        let (size, [above, right, below]) = (self.panel, self.margins);
        let cell = (LEFT + size.0 + right, above + size.1 + below);
        let entries = self.panels[0].lines.len();
        let legend = ABOVE + ROW * entries.div_ceil(self.legend.0) as f64;
        let draw = |svg: &mut Svg, (left, top): (f64, f64), panel: &CurvePanel| {
            panel.draw(svg, Rect::at((left + LEFT, top + above), size));
        };
        let mut svg = self.caption.sheet(legend, cell, &self.panels, draw);
        self.draw_legend(&mut svg);
        let csv = csv(COLUMNS, self.panels.iter().flat_map(CurvePanel::rows));
        let (name, svg) = (self.name, svg.finish());
        Picture {
            name: name.into(),
            svg,
            csv,
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
            svg.text((x + SAMPLE + GAP, y), LETTERS, Anchor::Start, &line.name);
        }
    }
}

impl CurvePanel {
    fn draw(&self, svg: &mut Svg, place: Rect) {
        let [x, y] = self.axes.clone();
        let panel = Panel { place, x, y };
        let above = (place.left, place.top - 20.0);
        svg.text(above, LETTERS, Anchor::Start, &self.title);
        panel.draw_mesh(svg);
        svg.within(place, |svg| {
            self.lines.iter().for_each(|line| line.draw(svg, &panel));
        });
        panel.draw_axes(svg);
    }

    fn rows(&self) -> impl Iterator<Item = String> + '_ {
        self.lines.iter().flat_map(|line| line.rows(self.name))
    }
}

impl ChartLine {
    /// A line of the usual width, without marks.
    pub(super) fn new(name: impl Into<String>, pen: Pen, parts: Vec<Vec<(f64, f64)>>) -> Self {
        Self {
            name: name.into(),
            pen,
            width: 2.2,
            is_marked: false,
            parts,
        }
    }

    /// The line with its points marked.
    pub(super) fn marked(self) -> Self {
        let is_marked = true;
        Self { is_marked, ..self }
    }

    /// All its points.
    pub(super) fn points(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.parts.iter().flatten().copied()
    }

    /// Its points as rows of a table with the [`COLUMNS`], with all digits.
    pub(super) fn rows(&self, panel: &str) -> impl Iterator<Item = String> + '_ {
        let start = format!("\"{panel}\",\"{}\"", self.name);
        self.points()
            .map(move |(x, y)| format!("{start},{x:e},{y:e}"))
    }

    fn draw(&self, svg: &mut Svg, panel: &Panel) {
        let (colour, dash) = self.pen;
        let place = |part: &Vec<(f64, f64)>| panel.all_at(part.iter().copied());
        let parts: Vec<_> = self.parts.iter().map(place).collect();
        svg.broken_lines(&parts, Stroke::new(colour, self.width), dash);
        let marks = parts.into_iter().flatten().filter(|_| self.is_marked);
        marks.for_each(|point| svg.circle(point, MARK, colour, colour));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_keeps_every_bit_of_every_point() {
        let third = 1.0 / 3.0;
        let parts = vec![vec![(1.0, third)], vec![(2.0, -third)]];
        let line = ChartLine::new("a, b", (Colour(0, 0, 0), Dash::Solid), parts);
        let rows: Vec<_> = line.rows("p").collect();
        assert_eq!(rows.len(), 2);
        assert!(rows[0].starts_with("\"p\",\"a, b\",1e0,"));
        let last: f64 = rows[1].rsplit(',').next().unwrap().parse().unwrap();
        assert_eq!(last.to_bits(), (-third).to_bits());
    }
}
