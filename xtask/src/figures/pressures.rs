//! Figures 2 and 5: pressures as maps, and as columns over the surface, with the same axes in every panel.

use pellicle_plot::axes::colour_bar;
use pellicle_plot::axes::panel::{Axis, Panel};
use pellicle_plot::sheet::colour_map::ColourScale;
use pellicle_plot::sheet::svg::{Anchor, Rect, Svg};
use pellicle_plot::step::coarse_field::CoarseField;
use pellicle_plot::step::crop::Crop;
use pellicle_plot::step::panel_3d::Panel3d;
use pellicle_plot::step::pressure_map;
use pellicle_plot::step::projection::Projection;

use super::chart::{ChartLine, Pen};
use super::runner::SolvedStep;
use super::sheet::{Caption, Picture, csv};

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

/// Panels with the same axes.
pub(super) struct Pressures<'a> {
    pub caption: Caption,
    /// The units of x and y, and of the pressures, with their sizes in the units of the cases.
    pub units: [(&'static str, f64); 2],
    pub panels: Vec<PressurePanel<'a>>,
}

/// One panel, with its pressures in the common unit.
pub(super) struct PressurePanel<'a> {
    pub title: String,
    pub step: &'a SolvedStep,
    /// The upper end of its pressure axis.
    pub top: f64,
    /// The upper end of its map's colours; higher pressures have the last colour.
    pub brightest: f64,
}

impl Pressures<'_> {
    /// Draws the pressures as maps and as columns over the surface, each with the table of the columns.
    pub(super) fn draw(&self, [maps, surfaces]: [&'static str; 2]) -> Vec<Picture> {
        let rows = self.panels.iter().flat_map(|panel| self.rows(panel));
        let table = csv("panel,x,y,pressure", rows);
        let picture =
            |name: &str, cell, draw: fn(&Self, &mut Svg, (f64, f64), &PressurePanel<'_>)| {
                let draw = |svg: &mut Svg, corner, panel: &_| draw(self, svg, corner, panel);
                let svg = self.caption.sheet(0.0, cell, &self.panels, draw);
                let (svg, csv) = (svg.finish(), table.clone());
                Picture {
                    name: name.into(),
                    svg,
                    csv,
                }
            };
        vec![
            picture(maps, MAP_CELL, Self::draw_map),
            picture(surfaces, SCENE_CELL, Self::draw_scene),
        ]
    }

    /// The pressure of a panel along x beside the axis, constant over each element.
    pub(super) fn profile(&self, panel: usize, pen: Pen) -> ChartLine {
        let panel = &self.panels[panel];
        let fields = panel.step.fields();
        let [(_, metre), (_, pascal)] = self.units;
        let along = |i: usize| {
            let pressure = fields.pressure[i * fields.size + fields.size / 2] / pascal;
            [i, i + 1].map(|i| (fields.edge(i) / metre, pressure))
        };
        let points = (0..fields.size).flat_map(along).collect();
        ChartLine::new(&panel.title, pen, vec![points])
    }

    /// The axis of a coordinate, which reaches beyond the largest contact.
    pub(super) fn axis(&self, symbol: &str, ticks: usize) -> Axis {
        let (reach, title) = (self.reach(), format!("{symbol}, {}", self.units[0].0));
        Axis::new(-reach, reach, title, ticks)
    }

    /// Half the side of the part shown, in the unit of x.
    fn reach(&self) -> f64 {
        let panels = self.panels.iter();
        let radii = panels.map(|panel| panel.step.numbers.summary.contact_radius);
        MARGIN * radii.fold(0.0, f64::max) / self.units[0].1
    }

    /// The part shown of a panel's fields.
    fn coarse(&self, panel: &PressurePanel<'_>, cells: usize) -> CoarseField {
        let fields = panel.step.fields();
        let part = 2.0 * self.reach() * self.units[0].1 / fields.side;
        CoarseField::new(&fields, &Crop::around_axis(fields.size, part), cells)
    }

    fn draw_map(&self, svg: &mut Svg, (left, top): (f64, f64), panel: &PressurePanel<'_>) {
        let [(_, metre), (pascals, pascal)] = self.units;
        let place = Rect::at((left + MAP_LEFT, top + TITLE_ROOM), (MAP, MAP));
        svg.text((place.left, top + 14.0), TITLE, Anchor::Start, &panel.title);
        let [x, y] = ["x", "y"].map(|symbol| self.axis(symbol, 6));
        let axes = Panel { place, x, y };
        let coarse = self.coarse(panel, MAP_CELLS);
        let in_pascals = ColourScale::up_to(panel.brightest * pascal);
        svg.within(place, |svg| {
            pressure_map::draw_field(svg, &axes, &coarse, metre, &in_pascals);
        });
        axes.draw_axes(svg);
        let bar = Rect::at((place.right() + MAP_GAP, place.top), (BAR, MAP));
        let scale = ColourScale::up_to(panel.brightest);
        colour_bar::draw(svg, bar, &scale, &format!("pressure p, {pascals}"));
    }

    fn draw_scene(&self, svg: &mut Svg, (left, top): (f64, f64), panel: &PressurePanel<'_>) {
        let [(_, metre), (pascals, pascal)] = self.units;
        let title = (left + 40.0, top + 14.0);
        svg.text(title, TITLE, Anchor::Start, &panel.title);
        let top = top + TITLE_ROOM;
        let scene = Panel3d {
            place: Rect::at((left, top), SCENE),
            view: Projection {
                unit: 215.0,
                height: 225.0,
                centre: (left + 380.0, top + 372.0),
            },
            x: self.axis("x", 5),
            y: self.axis("y", 5),
            z: Axis::new(0.0, panel.top, format!("p, {pascals}"), 5),
        };
        let coarse = self.coarse(panel, SCENE_CELLS);
        scene.draw(
            svg,
            &coarse,
            (metre, pascal),
            &ColourScale::up_to(panel.top),
        );
    }

    /// One row per column of a scene; a column has the largest pressure of its elements.
    fn rows(&self, panel: &PressurePanel<'_>) -> Vec<String> {
        let (title, coarse) = (&panel.title, self.coarse(panel, SCENE_CELLS));
        let cells = coarse.cells;
        let centre = |[from, to]: [f64; 2], i| from + (to - from) * (i as f64 + 0.5) / cells as f64;
        let row = |e: usize| {
            let (i, j) = (e / cells, e % cells);
            let (x, y) = (centre(coarse.x, i), centre(coarse.y, j));
            format!("\"{title}\",{x:e},{y:e},{:e}", coarse.pressure(i, j))
        };
        (0..cells * cells).map(row).collect()
    }
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
