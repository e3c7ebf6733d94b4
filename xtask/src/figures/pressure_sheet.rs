//! Sheets of pressures: as maps, and as columns over the surface, with the same axes in every panel.

use std::fmt::Write as _;

use pellicle_cli::Scale;
use pellicle_cli::drawing::CoarseField;
use pellicle_cli::drawing::ColourScale;
use pellicle_cli::drawing::Crop;
use pellicle_cli::drawing::Panel3d;
use pellicle_cli::drawing::Projection;
use pellicle_cli::drawing::{Anchor, Rect, Svg};
use pellicle_cli::drawing::{Axis, Panel};
use pellicle_cli::drawing::{colour_bar, labels, pressure_map};
use pellicle_cli::results::Fields;

use super::line::quoted;
use super::picture::Picture;
use super::sheet::Sheet;

/// Panels side by side.
const COLUMNS: usize = 2;

/// Of a map and its colour bar, in pixels.
const MAP: f64 = 480.0;
const MAP_LEFT: f64 = 104.0;
const MAP_GAP: f64 = 16.0;
const BAR: f64 = 22.0;
const MAP_COLUMN: f64 = MAP_LEFT + MAP + MAP_GAP + BAR + colour_bar::BESIDE;
const MAP_ROW: f64 = TITLE_ROOM + MAP + 74.0;

/// Of a scene, in pixels.
const SCENE_COLUMN: f64 = 720.0;
const SCENE_HEIGHT: f64 = 560.0;
const SCENE_ROW: f64 = TITLE_ROOM + SCENE_HEIGHT;

/// Above a panel.
const TITLE_ROOM: f64 = 34.0;
const TITLE: f64 = 18.0;

/// Most cells of a map, and most columns of a scene, along a side.
const CELLS: usize = 480;
const SCENE_CELLS: usize = 200;

/// One panel.
pub(super) struct Shown<'a> {
    /// What it shows.
    pub title: String,
    /// The fields of the step.
    pub fields: Fields<'a>,
    /// The unit of its pressures.
    pub pascals: Scale,
    /// The end of its pressures' axis, in that unit.
    pub top: f64,
    /// The end of the colours of its map, in that unit; what is above has the last colour.
    pub brightest: f64,
}

/// What is the same in all panels.
pub(super) struct Common<'a> {
    pub title: &'a str,
    pub subtitle: &'a str,
    pub notes: &'a [String],
    /// The unit of x and y.
    pub metres: Scale,
    /// Half the side of what is shown, in that unit.
    pub reach: f64,
}

impl Common<'_> {
    fn axis(&self, symbol: &str, ticks: usize) -> Axis {
        let title = labels::axis_title(symbol, &self.metres.label);
        Axis::new(-self.reach, self.reach, title, ticks)
    }

    fn coarse(&self, shown: &Shown<'_>, cells: usize) -> CoarseField {
        let part = 2.0 * self.reach * self.metres.divisor / shown.fields.side;
        let crop = Crop::around_axis(shown.fields.size, part);
        CoarseField::new(&shown.fields, &crop, cells)
    }

    /// The pressure along x beside the axis, constant over an element, in the units of axes.
    pub(super) fn profile(&self, shown: &Shown<'_>) -> Vec<(f64, f64)> {
        let fields = &shown.fields;
        let step = |i: usize| {
            let pressure = fields.pressure[i * fields.size + fields.size / 2];
            let pressure = pressure / shown.pascals.divisor;
            [i, i + 1].map(|i| (fields.edge(i) / self.metres.divisor, pressure))
        };
        (0..fields.size).flat_map(step).collect()
    }

    fn sheet(&self, panels: usize, (column, row): (f64, f64)) -> Sheet {
        let rows = panels.div_ceil(COLUMNS) as f64;
        let size = (COLUMNS as f64 * column, rows * row);
        Sheet::new(size, self.title, self.subtitle, self.notes)
    }
}

/// Left and upper corner of a panel's cell.
fn corner(i: usize, (column, row): (f64, f64)) -> (f64, f64) {
    let left = column * (i % COLUMNS) as f64;
    (left, Sheet::TOP + row * (i / COLUMNS) as f64)
}

/// The pressures as maps.
pub(super) fn maps(name: &'static str, common: &Common<'_>, panels: &[Shown<'_>]) -> Picture {
    let cell = (MAP_COLUMN, MAP_ROW);
    let mut sheet = common.sheet(panels.len(), cell);
    let mut csv = String::from("panel,x,y,pressure\n");
    for (i, shown) in panels.iter().enumerate() {
        let coarse = common.coarse(shown, CELLS);
        draw_map(&mut sheet.svg, corner(i, cell), common, shown, &coarse);
        push_rows(&mut csv, &shown.title, &common.coarse(shown, SCENE_CELLS));
    }
    sheet.finish(name, csv)
}

fn draw_map(
    svg: &mut Svg,
    (left, top): (f64, f64),
    common: &Common<'_>,
    shown: &Shown<'_>,
    coarse: &CoarseField,
) {
    let place = Rect {
        left: left + MAP_LEFT,
        top: top + TITLE_ROOM,
        width: MAP,
        height: MAP,
    };
    svg.text((place.left, top + 14.0), TITLE, Anchor::Start, &shown.title);
    let panel = Panel {
        place,
        x: common.axis("x", 6),
        y: common.axis("y", 6),
    };
    let shades = ColourScale::up_to(shown.brightest * shown.pascals.divisor);
    svg.within(place, |svg| {
        pressure_map::draw_field(svg, &panel, coarse, common.metres.divisor, &shades);
    });
    panel.draw_axes(svg);
    let bar = Rect {
        left: place.right() + MAP_GAP,
        width: BAR,
        ..place
    };
    let title = labels::axis_title("pressure p", &shown.pascals.label);
    colour_bar::draw(svg, bar, &ColourScale::up_to(shown.brightest), &title);
}

/// The pressures as columns over the surface.
pub(super) fn surfaces(name: &'static str, common: &Common<'_>, panels: &[Shown<'_>]) -> Picture {
    let cell = (SCENE_COLUMN, SCENE_ROW);
    let mut sheet = common.sheet(panels.len(), cell);
    let mut csv = String::from("panel,x,y,pressure\n");
    for (i, shown) in panels.iter().enumerate() {
        let coarse = common.coarse(shown, SCENE_CELLS);
        draw_scene(&mut sheet.svg, corner(i, cell), common, shown, &coarse);
        push_rows(&mut csv, &shown.title, &coarse);
    }
    sheet.finish(name, csv)
}

fn draw_scene(
    svg: &mut Svg,
    (left, top): (f64, f64),
    common: &Common<'_>,
    shown: &Shown<'_>,
    coarse: &CoarseField,
) {
    svg.text(
        (left + 40.0, top + 14.0),
        TITLE,
        Anchor::Start,
        &shown.title,
    );
    let place = Rect {
        left,
        top: top + TITLE_ROOM,
        width: SCENE_COLUMN,
        height: SCENE_HEIGHT,
    };
    let view = Projection {
        unit: 215.0,
        height: 225.0,
        centre: (left + 380.0, place.top + 372.0),
    };
    let pressure = labels::axis_title("p", &shown.pascals.label);
    let scene = Panel3d {
        place,
        view,
        x: common.axis("x", 5),
        y: common.axis("y", 5),
        z: Axis::new(0.0, shown.top, pressure, 5),
    };
    let divisors = (common.metres.divisor, shown.pascals.divisor);
    scene.draw(svg, coarse, divisors, &ColourScale::up_to(shown.top));
}

/// One row a cell; a cell has the largest pressure of its elements.
fn push_rows(csv: &mut String, panel: &str, coarse: &CoarseField) {
    let centre = |[from, to]: [f64; 2], i: usize| {
        from + (to - from) * (i as f64 + 0.5) / coarse.cells as f64
    };
    let panel = quoted(panel);
    for i in 0..coarse.cells {
        for j in 0..coarse.cells {
            let (x, y, p) = (
                centre(coarse.x, i),
                centre(coarse.y, j),
                coarse.pressure(i, j),
            );
            // Writing to a string does not fail.
            let _ = writeln!(csv, "{panel},{x:e},{y:e},{p:e}");
        }
    }
}
