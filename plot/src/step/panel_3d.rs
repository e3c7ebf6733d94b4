//! A box with three axes, seen from above one corner, that shows a field of pressure as columns.

use crate::axes::panel::{Axis, LABEL};
use crate::sheet::colour_map::{ColourScale, within_the_scale};
use crate::sheet::colours;
use crate::sheet::svg::{Anchor, Rect, Stroke, Svg};
use crate::step::coarse_field::CoarseField;
use crate::step::column_view::{self, ColumnField};
use crate::step::pressure_map;
use crate::step::projection::Projection;

/// A box with three axes that shows a field as columns.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel3d {
    /// The rectangle of the columns; labels may lie outside.
    pub place: Rect,
    /// The view of the box.
    pub view: Projection,
    /// The front axis on the right.
    pub x: Axis,
    /// The front axis on the left.
    pub y: Axis,
    /// The vertical axis.
    pub z: Axis,
}

impl Panel3d {
    /// Draws walls, columns and labels. Coordinates are divided by `metres`, pressures by `pascals`, which is the unit
    /// of the colours. The field may be smaller than the box.
    pub fn draw(
        &self,
        svg: &mut Svg,
        coarse: &CoarseField,
        (metres, pascals): (f64, f64),
        shades: &ColourScale,
    ) {
        self.draw_walls(svg);
        let in_pascals = ColourScale {
            from: shades.from * pascals,
            to: shades.to * pascals,
            ..*shades
        };
        let columns = self.columns(coarse, metres, pascals, &in_pascals);
        svg.image(
            self.place,
            &column_view::draw(&columns, &self.view, self.place),
        );
        self.draw_labels(svg);
    }

    /// Returns a column for each cell, cut off at the ceiling.
    fn columns(
        &self,
        coarse: &CoarseField,
        metres: f64,
        pascals: f64,
        shades: &ColourScale,
    ) -> ColumnField {
        let ends =
            |ends: [f64; 2], axis: &Axis| ends.map(|x| 2.0 * axis.fraction(x / metres) - 1.0);
        let cells = coarse.cells;
        let column = |e: usize| {
            let (i, j) = (e / cells, e % cells);
            let height = self.z.fraction(coarse.pressure(i, j) / pascals);
            let colour = pressure_map::colour(coarse, i, j, shades);
            (within_the_scale(height), colour)
        };
        ColumnField {
            cells,
            ends: [ends(coarse.x, &self.x), ends(coarse.y, &self.y)],
            tops: (0..cells * cells).map(column).collect(),
        }
    }

    /// Draws lines on the two rear walls.
    fn draw_walls(&self, svg: &mut Svg) {
        let line = |from, to| [self.view.at(from), self.view.at(to)];
        let mut lines = Vec::new();
        for (z, _) in &self.z.ticks {
            let z = self.z.fraction(*z);
            lines.push(line([-1.0, 1.0, z], [1.0, 1.0, z]));
            lines.push(line([1.0, 1.0, z], [1.0, -1.0, z]));
        }
        for (x, _) in &self.x.ticks {
            let x = 2.0 * self.x.fraction(*x) - 1.0;
            lines.push(line([x, 1.0, 0.0], [x, 1.0, 1.0]));
        }
        for (y, _) in &self.y.ticks {
            let y = 2.0 * self.y.fraction(*y) - 1.0;
            lines.push(line([1.0, y, 0.0], [1.0, y, 1.0]));
        }
        svg.lines(&lines, Stroke::new(colours::GRID, 1.0));
        let posts = [[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]];
        let posts = posts.map(|[x, y]| line([x, y, 0.0], [x, y, 1.0]));
        svg.lines(&posts, Stroke::new(colours::RELIEF_OUTLINE, 1.0));
    }

    /// Draws the edges, ticks, labels and titles in front.
    fn draw_labels(&self, svg: &mut Svg) {
        let ink = Stroke::new(colours::INK, 1.2);
        let edges = [
            [-1.0, 1.0, 1.0],
            [-1.0, 1.0, 0.0],
            [-1.0, -1.0, 0.0],
            [1.0, -1.0, 0.0],
        ];
        svg.line(&edges.map(|corner| self.view.at(corner)), ink);
        for (x, label) in &self.x.ticks {
            let at = 2.0 * self.x.fraction(*x) - 1.0;
            let (from, to) = (
                self.view.at([at, -1.0, 0.0]),
                self.view.at([at, -1.04, 0.0]),
            );
            svg.line(&[from, to], ink);
            svg.text((to.0 + 4.0, to.1 + 12.0), LABEL, Anchor::Start, label);
        }
        for (y, label) in &self.y.ticks {
            let at = 2.0 * self.y.fraction(*y) - 1.0;
            let (from, to) = (
                self.view.at([-1.0, at, 0.0]),
                self.view.at([-1.04, at, 0.0]),
            );
            svg.line(&[from, to], ink);
            svg.text((to.0 - 4.0, to.1 + 12.0), LABEL, Anchor::End, label);
        }
        for (z, label) in &self.z.ticks {
            let (x, y) = self.view.at([-1.0, 1.0, self.z.fraction(*z)]);
            svg.line(&[(x - 6.0, y), (x, y)], ink);
            svg.text((x - 11.0, y), LABEL, Anchor::End, label);
        }
        self.draw_titles(svg);
    }

    fn draw_titles(&self, svg: &mut Svg) {
        let (x, y) = self.view.at([0.1, -1.32, 0.0]);
        svg.text((x, y), 18.0, Anchor::Start, &self.x.title);
        let (x, y) = self.view.at([-1.32, -0.1, 0.0]);
        svg.text((x, y), 18.0, Anchor::End, &self.y.title);
        let (x, y) = self.view.at([-1.0, 1.0, 1.0]);
        svg.text((x - 62.0, y - 26.0), 18.0, Anchor::Start, &self.z.title);
    }
}
