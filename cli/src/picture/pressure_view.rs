//! The pressure of one loading step as columns over the plane, like figures 2 and 5 of the paper.

use super::coarse::Coarse;
use super::colours::{self, Colour};
use super::panel::{Axis, LABEL};
use super::projection::{self, Projection};
use super::raster::Raster;
use super::subject::Subject;
use super::svg::{Anchor, Place, Stroke, Svg};
use super::window::Window;
use super::{axis, colour_bar, heading, pressure_map};

/// The scene, in pixels.
const SCENE: Place = Place {
    left: 0.0,
    top: heading::HEIGHT,
    width: 940.0,
    height: 730.0,
};
const BAR: Place = Place {
    left: 950.0,
    top: heading::HEIGHT + 150.0,
    width: 26.0,
    height: 420.0,
};
const WIDTH: f64 = BAR.left + BAR.width + colour_bar::BESIDE;
const HEIGHT: f64 = SCENE.top + SCENE.height;
const HEADING_LEFT: f64 = 60.0;

const VIEW: Projection = Projection {
    unit: 300.0,
    height: 300.0,
    centre: (490.0, SCENE.top + 485.0),
};

/// Most columns along a side.
const CELLS: usize = 200;

/// Light on the sides of a column, against 1 on its top.
const LIT_LEFT: f64 = 0.74;
const LIT_FRONT: f64 = 0.88;

/// Pixels of the raster per pixel of the drawing, before it is halved.
const FINENESS: f64 = 2.0;

/// Name of the picture of a step, without ending.
#[must_use]
pub fn name(step: usize) -> String {
    format!("pressure-3d-{step:03}")
}

/// The picture as SVG.
#[must_use]
pub fn draw(subject: &Subject<'_>) -> String {
    let fields = &subject.fields;
    let window = Window::around_contact(fields.pressure, fields.size);
    let coarse = Coarse::new(fields, &window, CELLS);
    let (scale, top) = subject.pressures();
    let mut svg = Svg::new(WIDTH, HEIGHT);
    heading::draw(
        &mut svg,
        HEADING_LEFT,
        WIDTH - HEADING_LEFT,
        subject.title,
        &subject.numbers(),
    );
    let metres = subject.metres(coarse.farthest());
    let along = |[from, to]: [f64; 2], symbol: &str| {
        let title = axis::title(symbol, &metres.label);
        Axis::new(from / metres.divisor, to / metres.divisor, title, 6)
    };
    let pressure = Axis::new(0.0, top, axis::title("p", &scale.label), 5);
    let frame = Frame {
        x: along(coarse.x, "x"),
        y: along(coarse.y, "y"),
        z: pressure,
    };
    frame.draw_walls(&mut svg);
    let raster = columns(&coarse, top * scale.divisor).halved();
    svg.image(SCENE, &raster);
    frame.draw_labels(&mut svg);
    colour_bar::draw(&mut svg, BAR, &scale, top);
    svg.finish()
}

/// One column a cell, from the back to the front.
fn columns(coarse: &Coarse, largest: f64) -> Raster {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the size of the scene"
    )]
    let side = |length: f64| (FINENESS * length) as usize;
    let mut raster = Raster::new(side(SCENE.width), side(SCENE.height));
    for i in (0..coarse.cells).rev() {
        for j in (0..coarse.cells).rev() {
            draw_column(&mut raster, coarse, (i, j), largest);
        }
    }
    raster
}

/// The top of a column, and what its two sides in front show above the columns before them.
fn draw_column(raster: &mut Raster, coarse: &Coarse, (i, j): (usize, usize), largest: f64) {
    let corner = |i: usize| 2.0 * i as f64 / coarse.cells as f64 - 1.0;
    let ([x, right], [y, back]) = ([i, i + 1].map(corner), [j, j + 1].map(corner));
    let height = |i: usize, j: usize| coarse.pressure(i, j) / largest;
    let z = height(i, j);
    let left = if i > 0 { height(i - 1, j) } else { 0.0 };
    let front = if j > 0 { height(i, j - 1) } else { 0.0 };
    let colour = pressure_map::colour(coarse, i, j, largest);
    if left < z {
        let side = [[x, y, left], [x, back, left], [x, back, z], [x, y, z]];
        draw_face(raster, side, colour.lit(LIT_LEFT));
    }
    if front < z {
        let side = [[x, y, front], [right, y, front], [right, y, z], [x, y, z]];
        draw_face(raster, side, colour.lit(LIT_FRONT));
    }
    draw_face(
        raster,
        [[x, y, z], [right, y, z], [right, back, z], [x, back, z]],
        colour,
    );
}

fn draw_face(raster: &mut Raster, corners: [[f64; 3]; 4], colour: Colour) {
    let [a, b, c, d] = corners.map(|corner| {
        let (x, y) = VIEW.at(corner);
        (FINENESS * (x - SCENE.left), FINENESS * (y - SCENE.top))
    });
    projection::fill(raster, [a, b, c], colour);
    projection::fill(raster, [a, c, d], colour);
}

/// The axes of the box.
struct Frame {
    x: Axis,
    y: Axis,
    z: Axis,
}

impl Frame {
    /// Lines on the two walls behind.
    fn draw_walls(&self, svg: &mut Svg) {
        let line = |from, to| [VIEW.at(from), VIEW.at(to)];
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
        svg.line(&edges.map(|corner| VIEW.at(corner)), ink);
        for (x, label) in &self.x.ticks {
            let at = 2.0 * self.x.fraction(*x) - 1.0;
            let (from, to) = (VIEW.at([at, -1.0, 0.0]), VIEW.at([at, -1.04, 0.0]));
            svg.line(&[from, to], ink);
            svg.text((to.0 + 4.0, to.1 + 12.0), LABEL, Anchor::Start, label);
        }
        for (y, label) in &self.y.ticks {
            let at = 2.0 * self.y.fraction(*y) - 1.0;
            let (from, to) = (VIEW.at([-1.0, at, 0.0]), VIEW.at([-1.04, at, 0.0]));
            svg.line(&[from, to], ink);
            svg.text((to.0 - 4.0, to.1 + 12.0), LABEL, Anchor::End, label);
        }
        for (z, label) in &self.z.ticks {
            let (x, y) = VIEW.at([-1.0, 1.0, self.z.fraction(*z)]);
            svg.line(&[(x - 6.0, y), (x, y)], ink);
            svg.text((x - 11.0, y), LABEL, Anchor::End, label);
        }
        self.draw_titles(svg);
    }

    fn draw_titles(&self, svg: &mut Svg) {
        let (x, y) = VIEW.at([0.1, -1.32, 0.0]);
        svg.text((x, y), 18.0, Anchor::Start, &self.x.title);
        let (x, y) = VIEW.at([-1.32, -0.1, 0.0]);
        svg.text((x, y), 18.0, Anchor::End, &self.y.title);
        let (x, y) = VIEW.at([-1.0, 1.0, 1.0]);
        svg.text((x - 62.0, y - 26.0), 18.0, Anchor::Start, &self.z.title);
    }
}

fn stroke(colour: Colour, width: f64) -> Stroke {
    Stroke { colour, width }
}
