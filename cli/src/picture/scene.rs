//! A box with three axes, seen from above one corner, in which a field of pressure stands as columns.

use super::coarse::Coarse;
use super::colours::{self, Colour};
use super::panel::{Axis, LABEL};
use super::pressure_map;
use super::projection::{self, Projection};
use super::raster::Raster;
use super::svg::{Anchor, Place, Stroke, Svg};

/// Light on the sides of a column, against 1 on its top.
const LIT_LEFT: f64 = 0.74;
const LIT_FRONT: f64 = 0.88;

/// Pixels of the raster per pixel of the drawing, before it is halved.
const FINENESS: f64 = 2.0;

/// A box with three axes, in which a field stands as columns.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// What is filled by columns; labels may stand outside.
    pub place: Place,
    /// How the box is seen.
    pub view: Projection,
    /// The axis in front, to the right.
    pub x: Axis,
    /// The axis in front, to the left.
    pub y: Axis,
    /// The axis upwards.
    pub z: Axis,
}

impl Scene {
    /// Draws walls, columns and labels; coordinates are divided by `metres`, pressures by `pascals`. The field may be
    /// smaller than the box.
    pub fn draw(&self, svg: &mut Svg, coarse: &Coarse, metres: f64, pascals: f64) {
        self.draw_walls(svg);
        let columns = Columns {
            scene: self,
            coarse,
            metres,
            largest: pascals * self.z.to,
        };
        svg.image(self.place, &columns.raster().halved());
        self.draw_labels(svg);
    }

    /// Lines on the two walls behind.
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
        svg.lines(&lines, stroke(colours::GRID, 1.0));
        let posts = [[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]];
        let posts = posts.map(|[x, y]| line([x, y, 0.0], [x, y, 1.0]));
        svg.lines(&posts, stroke(colours::RELIEF_OUTLINE, 1.0));
    }

    /// Edges, ticks, labels and titles in front.
    fn draw_labels(&self, svg: &mut Svg) {
        let ink = stroke(colours::INK, 1.2);
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

/// The columns of a field, one a cell.
struct Columns<'a> {
    scene: &'a Scene,
    coarse: &'a Coarse,
    metres: f64,
    /// The pressure at the top of the box, Pa.
    largest: f64,
}

impl Columns<'_> {
    /// From the back to the front.
    fn raster(&self) -> Raster {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the size of the scene"
        )]
        let side = |length: f64| (FINENESS * length) as usize;
        let Place { width, height, .. } = self.scene.place;
        let mut raster = Raster::new(side(width), side(height));
        for i in (0..self.coarse.cells).rev() {
            for j in (0..self.coarse.cells).rev() {
                self.draw_column(&mut raster, i, j);
            }
        }
        raster
    }

    /// Where a corner of a cell is along an axis of the box, from −1 to 1.
    fn corner(&self, [from, to]: [f64; 2], axis: &Axis, i: usize) -> f64 {
        let x = from + (to - from) * i as f64 / self.coarse.cells as f64;
        2.0 * axis.fraction(x / self.metres) - 1.0
    }

    /// The top of a column, and what its two sides in front show above the columns before them.
    fn draw_column(&self, raster: &mut Raster, i: usize, j: usize) {
        let [x, right] = [i, i + 1].map(|i| self.corner(self.coarse.x, &self.scene.x, i));
        let [y, back] = [j, j + 1].map(|j| self.corner(self.coarse.y, &self.scene.y, j));
        let height = |i: usize, j: usize| self.coarse.pressure(i, j) / self.largest;
        let z = height(i, j);
        let left = if i > 0 { height(i - 1, j) } else { 0.0 };
        let front = if j > 0 { height(i, j - 1) } else { 0.0 };
        let colour = pressure_map::colour(self.coarse, i, j, self.largest);
        if left < z {
            let side = [[x, y, left], [x, back, left], [x, back, z], [x, y, z]];
            self.draw_face(raster, side, colour.lit(LIT_LEFT));
        }
        if front < z {
            let side = [[x, y, front], [right, y, front], [right, y, z], [x, y, z]];
            self.draw_face(raster, side, colour.lit(LIT_FRONT));
        }
        let top = [[x, y, z], [right, y, z], [right, back, z], [x, back, z]];
        self.draw_face(raster, top, colour);
    }

    fn draw_face(&self, raster: &mut Raster, corners: [[f64; 3]; 4], colour: Colour) {
        let Place { left, top, .. } = self.scene.place;
        let [a, b, c, d] = corners.map(|corner| {
            let (x, y) = self.scene.view.at(corner);
            (FINENESS * (x - left), FINENESS * (y - top))
        });
        projection::fill(raster, [a, b, c], colour);
        projection::fill(raster, [a, c, d], colour);
    }
}

fn stroke(colour: Colour, width: f64) -> Stroke {
    Stroke { colour, width }
}
