//! The pressure of one loading step as columns over the plane, like figures 2 and 5 of the paper.

use crate::axes::colour_bar;
use crate::axes::labels;
use crate::axes::panel::Axis;
use crate::sheet::heading;
use crate::sheet::svg::Rect;
use crate::step::coarse_field::CoarseField;
use crate::step::crop::Crop;
use crate::step::panel_3d::Panel3d;
use crate::step::projection::Projection;
use crate::step::subject::Subject;

/// The rectangle of the scene, in pixels.
const SCENE: Rect = Rect::at((0.0, heading::HEIGHT), (940.0, 730.0));
const BAR: Rect = Rect::at((950.0, heading::HEIGHT + 150.0), (26.0, 420.0));
const WIDTH: f64 = BAR.left + BAR.width + colour_bar::BESIDE;
const HEIGHT: f64 = SCENE.top + SCENE.height;
const HEADING_LEFT: f64 = 60.0;

const VIEW: Projection = Projection {
    unit: 300.0,
    height: 300.0,
    centre: (490.0, SCENE.top + 485.0),
};

/// Largest number of columns along a side.
const CELLS: usize = 200;

/// Draws the picture as SVG.
#[must_use]
pub fn draw(subject: &Subject<'_>) -> String {
    let fields = &subject.fields;
    let crop = Crop::around_contact(fields.pressure, fields.size);
    let coarse = CoarseField::new(fields, &crop, CELLS);
    let (scale, shades) = subject.pressures();
    let mut svg = subject.style.sheet(WIDTH, HEIGHT);
    subject.draw_heading(&mut svg, HEADING_LEFT, WIDTH - HEADING_LEFT, "");
    let metres = subject.metres(coarse.farthest());
    let along = |[from, to]: [f64; 2], symbol: &str| {
        let title = labels::axis_title(symbol, &metres.label);
        Axis::new(from / metres.divisor, to / metres.divisor, title, 6)
    };
    let title = labels::axis_title("p", &scale.label);
    let pressure = Axis::new(shades.from, shades.to, title, 5);
    let scene = Panel3d {
        place: SCENE,
        view: VIEW,
        x: along(coarse.x, "x"),
        y: along(coarse.y, "y"),
        z: pressure,
    };
    scene.draw(&mut svg, &coarse, (metres.divisor, scale.divisor), &shades);
    let title = labels::axis_title("pressure p", &scale.label);
    colour_bar::draw(&mut svg, BAR, &shades, &title);
    svg.finish()
}
