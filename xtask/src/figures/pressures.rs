//! Figures 2 and 5: pressures as maps, and as columns over the surface, with the same axes in every panel.

use std::fmt::Write as _;

use pellicle_cli::DisplayUnit;
use pellicle_cli::drawing::{
    Anchor, Axis, CoarseField, ColourScale, Crop, Panel, Panel3d, Projection, Rect, Svg,
    colour_bar, labels, pressure_map,
};

use super::chart::{ChartLine, Pen, quoted};
use super::runner::SolvedStep;
use super::sheet::{Caption, Picture, TOP};

/// Sizes of a map and its colour bar, in pixels.
const MAP: f64 = 480.0;
const MAP_LEFT: f64 = 104.0;
const MAP_GAP: f64 = 16.0;
const BAR: f64 = 22.0;
const MAP_CELL: (f64, f64) = (
    MAP_LEFT + MAP + MAP_GAP + BAR + colour_bar::BESIDE,
    TITLE_ROOM + MAP + 74.0,
);

/// Sizes of a scene, in pixels.
const SCENE: (f64, f64) = (720.0, 560.0);
const SCENE_CELL: (f64, f64) = (SCENE.0, TITLE_ROOM + SCENE.1);

/// Room above a panel, and the size of its title.
const TITLE_ROOM: f64 = 34.0;
const TITLE: f64 = 18.0;

/// Maximum number of cells of a map, and of columns of a scene, per side.
const MAP_CELLS: usize = 480;
const SCENE_CELLS: usize = 200;

/// Half the side of the part shown, in contact radii.
const MARGIN: f64 = 1.06;

/// One panel, with its pressures in the common unit.
pub(super) struct PressurePanel<'a> {
    pub title: String,
    pub step: &'a SolvedStep,
    /// The upper end of its pressure axis.
    pub top: f64,
    /// The upper end of its map's colours; higher pressures have the last colour.
    pub brightest: f64,
}

/// Panels with the same axes.
pub(super) struct Pressures<'a> {
    pub caption: Caption,
    /// The unit of x and y.
    pub metres: DisplayUnit,
    /// The unit of the pressures.
    pub pascals: DisplayUnit,
    /// Half the side of the part shown, in the unit of x.
    pub reach: f64,
    pub panels: Vec<PressurePanel<'a>>,
}

impl Pressures<'_> {
    /// Draws the pressures as maps and as columns over the surface, under these names.
    pub(super) fn draw(&self, maps: &'static str, surfaces: &'static str) -> [Picture; 2] {
        [
            self.picture(maps, MAP_CELL, Self::draw_map),
            self.picture(surfaces, SCENE_CELL, Self::draw_scene),
        ]
    }

    /// The pressure of a panel along x beside the axis, constant over each element, in the units of the axes.
    pub(super) fn profile(&self, panel: usize, pen: Pen) -> ChartLine {
        let panel = &self.panels[panel];
        let fields = panel.step.fields();
        let along = |i: usize| {
            let pressure = fields.pressure[i * fields.size + fields.size / 2];
            let pressure = pressure / self.pascals.divisor;
            [i, i + 1].map(|i| (fields.edge(i) / self.metres.divisor, pressure))
        };
        let points = (0..fields.size).flat_map(along).collect();
        ChartLine::new(&panel.title, pen, vec![points])
    }

    /// Draws the panels, each from the top left corner of its cell.
    fn picture(
        &self,
        name: &'static str,
        cell: (f64, f64),
        draw: fn(&Self, &mut Svg, (f64, f64), &PressurePanel<'_>),
    ) -> Picture {
        let columns = if self.panels.len() == 3 { 3 } else { 2 };
        let rows = self.panels.len().div_ceil(columns);
        let size = (cell.0 * columns as f64, cell.1 * rows as f64);
        let mut svg = self.caption.sheet(size);
        for (i, panel) in self.panels.iter().enumerate() {
            let left = cell.0 * (i % columns) as f64;
            let top = TOP + cell.1 * (i / columns) as f64;
            draw(self, &mut svg, (left, top), panel);
        }
        Picture {
            name,
            svg: svg.finish(),
            width: size.0,
            csv: self.csv(),
        }
    }

    fn draw_map(&self, svg: &mut Svg, (left, top): (f64, f64), panel: &PressurePanel<'_>) {
        let place = Rect {
            left: left + MAP_LEFT,
            top: top + TITLE_ROOM,
            width: MAP,
            height: MAP,
        };
        let title = (place.left, top + 14.0);
        svg.text(title, TITLE, Anchor::Start, &panel.title);
        let axes = Panel {
            place,
            x: self.axis("x", 6),
            y: self.axis("y", 6),
        };
        let coarse = self.coarse(panel, MAP_CELLS);
        let in_pascals = ColourScale::up_to(panel.brightest * self.pascals.divisor);
        svg.within(place, |svg| {
            pressure_map::draw_field(svg, &axes, &coarse, self.metres.divisor, &in_pascals);
        });
        axes.draw_axes(svg);
        let bar = Rect {
            left: place.right() + MAP_GAP,
            width: BAR,
            ..place
        };
        let title = labels::axis_title("pressure p", &self.pascals.label);
        colour_bar::draw(svg, bar, &ColourScale::up_to(panel.brightest), &title);
    }

    fn draw_scene(&self, svg: &mut Svg, (left, top): (f64, f64), panel: &PressurePanel<'_>) {
        let title = (left + 40.0, top + 14.0);
        svg.text(title, TITLE, Anchor::Start, &panel.title);
        let top = top + TITLE_ROOM;
        let pressure = labels::axis_title("p", &self.pascals.label);
        let scene = Panel3d {
            place: Rect {
                left,
                top,
                width: SCENE.0,
                height: SCENE.1,
            },
            view: Projection {
                unit: 215.0,
                height: 225.0,
                centre: (left + 380.0, top + 372.0),
            },
            x: self.axis("x", 5),
            y: self.axis("y", 5),
            z: Axis::new(0.0, panel.top, pressure, 5),
        };
        let divisors = (self.metres.divisor, self.pascals.divisor);
        let coarse = self.coarse(panel, SCENE_CELLS);
        scene.draw(svg, &coarse, divisors, &ColourScale::up_to(panel.top));
    }

    /// One row per cell of each panel; a cell has the largest pressure of its elements.
    fn csv(&self) -> String {
        let mut csv = String::from("panel,x,y,pressure\n");
        for panel in &self.panels {
            let (title, coarse) = (quoted(&panel.title), self.coarse(panel, SCENE_CELLS));
            let centre = |[from, to]: [f64; 2], i: usize| {
                from + (to - from) * (i as f64 + 0.5) / coarse.cells as f64
            };
            for e in 0..coarse.cells * coarse.cells {
                let (i, j) = (e / coarse.cells, e % coarse.cells);
                let (x, y) = (centre(coarse.x, i), centre(coarse.y, j));
                let p = coarse.pressure(i, j);
                // Writing to a string does not fail.
                let _ = writeln!(csv, "{title},{x:e},{y:e},{p:e}");
            }
        }
        csv
    }

    fn axis(&self, symbol: &str, ticks: usize) -> Axis {
        let title = labels::axis_title(symbol, &self.metres.label);
        Axis::new(-self.reach, self.reach, title, ticks)
    }

    fn coarse(&self, panel: &PressurePanel<'_>, cells: usize) -> CoarseField {
        let fields = panel.step.fields();
        let part = 2.0 * self.reach * self.metres.divisor / fields.side;
        let crop = Crop::around_axis(fields.size, part);
        CoarseField::new(&fields, &crop, cells)
    }
}

/// The largest contact radius plus a margin.
pub(super) fn reach(steps: &[SolvedStep]) -> f64 {
    let radii = steps
        .iter()
        .map(|step| step.numbers().summary.contact_radius);
    MARGIN * radii.fold(0.0, f64::max)
}

/// The largest value, rounded up to two digits of which the second is even, so that the end of an axis is a round
/// number.
pub(super) fn rounded_up(values: impl IntoIterator<Item = f64>) -> f64 {
    let largest = values.into_iter().fold(0.0, f64::max);
    let unit = 2.0 * 10_f64.powf(largest.log10().floor() - 1.0);
    // A round value is unchanged, whatever its last bits.
    unit * (largest / unit - 1e-9).ceil()
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn the_end_of_an_axis_is_round_and_no_smaller_than_the_data() {
        for (value, end) in [(0.499, 0.50), (0.0434, 0.044), (4.19, 4.2), (0.5, 0.5)] {
            // A few roundings of products.
            assert_relative_eq!(rounded_up([value]), end, max_relative = 1e-14);
        }
    }
}
