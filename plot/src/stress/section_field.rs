//! A stress on a section, interpolated between its planes and points but never across an interface.

use crate::axes::contour_bands::ContourBands;
use crate::axes::panel::Panel;
use crate::sheet::colours::Colour;
use crate::sheet::raster::Raster;
use crate::sheet::svg::{Dash, Rect, Stroke, Svg};
use crate::stress::contour_lines::{Mesh, Polyline};
use crate::stress::contour_places::ContourPlaces;
use crate::stress::depth_scale::DepthScale;
use crate::stress::view::StressSection;

/// Distance in pixels between the nodes of a contour; it is straight between them.
const NODES: f64 = 2.5;

/// Width of a contour, and of the zero contour.
const LINE: f64 = 0.9;
const ZERO: f64 = 2.2;

/// The values of a stress on a section.
pub struct SectionField<'a> {
    section: &'a StressSection,
    values: &'a [f64],
    depths: &'a DepthScale,
    /// The planes of each body.
    planes: Vec<std::ops::Range<usize>>,
}

impl<'a> SectionField<'a> {
    /// Prepares the values of a section, one row per depth, for drawing on a depth axis.
    #[must_use]
    pub fn new(section: &'a StressSection, values: &'a [f64], depths: &'a DepthScale) -> Self {
        let of_body = |body: usize| {
            let first = section.bodies.partition_point(|other| *other < body);
            first..section.bodies.partition_point(|other| *other <= body)
        };
        Self {
            section,
            values,
            depths,
            planes: (0..depths.bodies()).map(of_body).collect(),
        }
    }

    fn row(&self, plane: usize) -> &[f64] {
        let count = self.section.along.len();
        &self.values[plane * count..(plane + 1) * count]
    }

    /// The least and the largest value.
    #[must_use]
    pub fn extent(&self) -> [f64; 2] {
        let finite = self
            .values
            .iter()
            .copied()
            .filter(|value| value.is_finite());
        finite.fold([0.0, 0.0], |[least, largest], value| {
            [f64::min(least, value), f64::max(largest, value)]
        })
    }

    /// Returns the position of the largest value along the section and down the picture, its body and the value.
    #[must_use]
    pub fn largest(&self) -> Option<(f64, f64, usize, f64)> {
        let count = self.section.along.len();
        let finite = self
            .values
            .iter()
            .enumerate()
            .filter(|(_, value)| value.is_finite());
        let (i, value) = finite.max_by(|one, other| one.1.total_cmp(other.1))?;
        let plane = i / count;
        let (depth, body) = (self.section.depths[plane], self.section.bodies[plane]);
        Some((self.section.along[i % count], depth, body, *value))
    }

    /// Returns `columns` values at a depth of a body, from end to end.
    fn across(&self, body: usize, depth: f64, columns: usize) -> Vec<f64> {
        let planes = self.planes[body].clone();
        let depths = &self.section.depths[planes.clone()];
        let (above, part) = between(depths, depth);
        let upper = self.row(planes.start + above);
        let lower = self.row((planes.start + above + 1).min(planes.end - 1));
        let [from, to] = self.section.ends();
        let at = |column: usize| {
            let along = from + (to - from) * column as f64 / (columns - 1) as f64;
            let (left, part_across) = between(&self.section.along, along);
            let right = (left + 1).min(upper.len() - 1);
            let [upper, lower] =
                [upper, lower].map(|row| row[left] + part_across * (row[right] - row[left]));
            upper + part * (lower - upper)
        };
        (0..columns).map(at).collect()
    }

    /// Returns an image of the section, with one image pixel per pixel of its rectangle.
    #[must_use]
    pub fn raster(&self, place: Rect, colour: impl Fn(f64) -> Colour) -> Raster {
        let [columns, rows] = [place.width, place.height].map(|side| nodes(side, 1.0));
        let values: Vec<Vec<f64>> = (0..rows)
            .map(|row| {
                let down = (row as f64 + 0.5) / rows as f64;
                let last = self.depths.bodies() - 1;
                let body = (0..last).find(|body| down < self.depths.within(*body)[1]);
                let body = body.unwrap_or(last);
                self.across(body, self.depths.depth(body, down), columns)
            })
            .collect();
        Raster::of(columns, rows, |column, row| colour(values[row][column]))
    }

    /// Draws the contours of each body and their labels; levels are in units of `divisor`.
    pub fn draw_contours(
        &self,
        svg: &mut Svg,
        panel: &Panel,
        bands: &ContourBands,
        divisor: f64,
        places: &mut ContourPlaces,
    ) {
        let drawn =
            (0..self.depths.bodies()).flat_map(|body| self.contours(body, panel, bands, divisor));
        let drawn: Vec<_> = drawn.collect();
        for (level, lines) in &drawn {
            let value = bands.levels[*level];
            let width = if value == 0.0 { ZERO } else { LINE };
            let stroke = Stroke::new(bands.ink(*level), width);
            let dash = if value < 0.0 {
                Dash::Dashed
            } else {
                Dash::Solid
            };
            svg.broken_lines(lines, stroke, dash);
        }
        for (level, lines) in &drawn {
            places.draw_labels(svg, lines, &bands.label(bands.levels[*level]));
        }
    }

    /// Returns the contours of a body, with the index of their level.
    fn contours(
        &self,
        body: usize,
        panel: &Panel,
        bands: &ContourBands,
        divisor: f64,
    ) -> Vec<(usize, Vec<Polyline>)> {
        let [top, bottom] = self.depths.within(body);
        let columns = nodes(panel.place.width, NODES);
        let rows = nodes((bottom - top) * panel.place.height, NODES);
        let down = |row: f64| top + (bottom - top) * row / (rows - 1) as f64;
        let values = (0..rows).flat_map(|row| {
            let depth = self.depths.depth(body, down(row as f64));
            self.across(body, depth, columns)
        });
        let mesh = Mesh {
            columns,
            values: values.map(|value| value / divisor).collect(),
        };
        let place = |(column, row): (f64, f64)| {
            let x = panel.place.left + panel.place.width * column / (columns - 1) as f64;
            (x, panel.place.top + panel.place.height * down(row))
        };
        let lines_at = |level: &f64| -> Vec<Polyline> {
            let lines = mesh.lines_at(*level).into_iter();
            lines
                .map(|line| line.into_iter().map(place).collect())
                .collect()
        };
        bands.levels.iter().map(lines_at).enumerate().collect()
    }
}

/// Returns the index of the last of these increasing numbers not above `number`, excluding the very last, and the
/// fraction of the way to the next.
fn between(numbers: &[f64], number: f64) -> (usize, f64) {
    let above = numbers.partition_point(|other| *other <= number);
    let first = above.clamp(1, numbers.len().max(2) - 1) - 1;
    match numbers.get(first..first + 2) {
        Some([one, other]) => (first, ((number - one) / (other - one)).clamp(0.0, 1.0)),
        _ => (0, 0.0),
    }
}

/// Number of nodes about this far apart that cover a length, both in pixels; at least two.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "at most the pixels of a panel"
)]
fn nodes(length: f64, apart: f64) -> usize {
    (length / apart).ceil().max(1.0) as usize + 1
}
