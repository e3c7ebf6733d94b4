//! The pressure of one loading step over the surface, with the outlines of the contact and of the relief.

use std::io;
use std::path::Path;

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use super::window::Window;
use super::{axis, colours, font};
use crate::case::units::Units;
use crate::display::{self, Scale, Unit};
use crate::failure::Failure;
use crate::output::file::create_whole;

/// Side of the square map and the widths around it, in pixels.
const MAP: u32 = 760;
const TITLE: u32 = 84;
const LEFT: u32 = 112;
const BOTTOM: u32 = 72;
/// Between a label and the edge of the picture.
const RIM: u32 = 12;
const GAP: u32 = 28;
const BAR: u32 = 30;
const BAR_LABELS: u32 = 124;
const WIDTH: u32 = LEFT + MAP + GAP + BAR + BAR_LABELS;
const HEIGHT: u32 = TITLE + MAP + BOTTOM;

/// Colours in the bar.
const SHADES: u32 = 256;

/// Heights of the title, the line below it, the axes' texts and the legend, in pixels.
const LARGE: u32 = 27;
const MEDIUM: u32 = 22;
const SMALL: u32 = 21;
const TINY: u32 = 18;

/// What is drawn.
#[derive(Debug, Clone, Copy)]
pub struct PressureMap<'a> {
    /// Of the case.
    pub title: &'a str,
    /// Of the case.
    pub units: Units,
    /// Whether the step's certificate is satisfied; a picture of one that is not says so.
    pub certified: bool,
    /// `Q`, N.
    pub force: f64,
    /// `D`, m.
    pub penetration: f64,
    /// Side of the domain, m.
    pub side: f64,
    /// Elements per side.
    pub size: usize,
    /// Pressure, Pa; size² values.
    pub pressure: &'a [f64],
    /// Whether an element belongs to the relief; size² values.
    pub mask: &'a [bool],
}

type Drawn = Result<(), Box<dyn std::error::Error>>;
type Area<'b> = DrawingArea<BitMapBackend<'b>, Shift>;
type Chart<'a, 'b> =
    ChartContext<'a, BitMapBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Name of the file of a step in a results folder.
#[must_use]
pub fn file(step: usize) -> String {
    format!("pressure-{step:03}.png")
}

impl PressureMap<'_> {
    /// Draws the picture into a PNG file.
    ///
    /// # Errors
    ///
    /// [`Failure::Write`] if the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), Failure> {
        font::register();
        create_whole(path, |path| {
            self.draw(path)
                .map_err(|error| io::Error::other(error.to_string()))
        })
    }

    fn draw(&self, path: &Path) -> Drawn {
        let root = BitMapBackend::new(path, (WIDTH, HEIGHT)).into_drawing_area();
        root.fill(&WHITE)?;
        let (head, body) = root.split_vertically(TITLE);
        let (map, bar) = body.split_horizontally(LEFT + MAP);
        let largest = self.pressure.iter().copied().fold(0.0, f64::max);
        self.draw_head(&head, largest)?;
        self.draw_map(&map, largest)?;
        self.draw_bar(&bar, largest)?;
        self.draw_legend(&root)?;
        root.present()?;
        Ok(())
    }

    fn draw_head(&self, area: &Area<'_>, largest: f64) -> Drawn {
        let quantity = |value, unit| display::quantity(value, unit, self.units);
        let mark = if self.certified {
            ""
        } else {
            "NOT CONVERGED:  "
        };
        let numbers = format!(
            "{mark}Q = {},  D = {},  largest p = {}",
            quantity(self.force, Unit::Newton),
            quantity(self.penetration, Unit::Metre),
            quantity(largest, Unit::Pascal),
        );
        let left = i32::try_from(LEFT)?;
        area.draw(&Text::new(fitted(self.title), (left, 14), text(LARGE)))?;
        area.draw(&Text::new(numbers, (left, 50), text(MEDIUM)))?;
        Ok(())
    }

    fn draw_map(&self, area: &Area<'_>, largest: f64) -> Drawn {
        let window = Window::around_contact(self.pressure, self.size);
        let scale = Scale::of(self.farthest(&window), Unit::Metre, self.units);
        let edge = |i: usize| self.edge(i) / scale.divisor;
        let (x, y) = (
            edge(window.x.start)..edge(window.x.end),
            edge(window.y.start)..edge(window.y.end),
        );
        let length = x.end - x.start;
        let mut chart = ChartBuilder::on(area)
            .margin_left(RIM)
            .margin_bottom(RIM)
            .x_label_area_size(BOTTOM - RIM)
            .y_label_area_size(LEFT - RIM)
            .build_cartesian_2d(x, y)?;
        self.draw_elements(&chart, &window, scale.divisor, largest)?;
        self.draw_outline(&chart, &window, scale.divisor)?;
        chart
            .configure_mesh()
            .disable_mesh()
            .axis_style(colours::INK)
            .label_style(text(SMALL))
            .x_labels(7)
            .y_labels(7)
            .x_label_formatter(&|x| axis::label(*x, length))
            .y_label_formatter(&|y| axis::label(*y, length))
            .x_desc(axis::title("x", &scale.label))
            .y_desc(axis::title("y", &scale.label))
            .draw()?;
        Ok(())
    }

    /// The rectangles of the elements, runs of one colour along y in one piece.
    fn draw_elements(
        &self,
        chart: &Chart<'_, '_>,
        window: &Window,
        divisor: f64,
        largest: f64,
    ) -> Drawn {
        let edge = |i: usize| self.edge(i) / divisor;
        for i in window.x.clone() {
            let colour = |j: usize| self.colour(i * self.size + j, largest);
            let mut start = window.y.start;
            for j in window.y.clone() {
                if j + 1 == window.y.end || colour(j + 1) != colour(j) {
                    let corners = [(edge(i), edge(start)), (edge(i + 1), edge(j + 1))];
                    let rectangle = Rectangle::new(corners, colour(j).filled());
                    chart.plotting_area().draw(&rectangle)?;
                    start = j + 1;
                }
            }
        }
        Ok(())
    }

    /// The sides between an element in contact and one that is not.
    fn draw_outline(&self, chart: &Chart<'_, '_>, window: &Window, divisor: f64) -> Drawn {
        let edge = |i: usize| self.edge(i) / divisor;
        let touches = |i: usize, j: usize| self.pressure[i * self.size + j] > 0.0;
        let line = |from, to| PathElement::new([from, to], colours::INK.stroke_width(1));
        for i in window.x.clone() {
            for j in window.y.clone() {
                let (left, low) = (edge(i), edge(j));
                if i > window.x.start && touches(i, j) != touches(i - 1, j) {
                    chart
                        .plotting_area()
                        .draw(&line((left, low), (left, edge(j + 1))))?;
                }
                if j > window.y.start && touches(i, j) != touches(i, j - 1) {
                    chart
                        .plotting_area()
                        .draw(&line((left, low), (edge(i + 1), low)))?;
                }
            }
        }
        Ok(())
    }

    fn draw_bar(&self, area: &Area<'_>, largest: f64) -> Drawn {
        let scale = Scale::of(largest, Unit::Pascal, self.units);
        let top = if largest > 0.0 {
            largest / scale.divisor
        } else {
            1.0
        };
        let mut chart = ChartBuilder::on(area)
            .margin_left(GAP)
            .margin_bottom(BOTTOM)
            .margin_right(RIM)
            .right_y_label_area_size(BAR_LABELS - RIM)
            .build_cartesian_2d(0.0..1.0, 0.0..top)?;
        for shade in 0..SHADES {
            let at = |shade: u32| f64::from(shade) / f64::from(SHADES);
            let corners = [(0.0, at(shade) * top), (1.0, at(shade + 1) * top)];
            let colour = colours::of_fraction(at(shade));
            chart
                .plotting_area()
                .draw(&Rectangle::new(corners, colour.filled()))?;
        }
        chart
            .configure_mesh()
            .disable_mesh()
            .axis_style(colours::INK)
            .label_style(text(SMALL))
            .x_labels(0)
            .y_labels(7)
            .y_label_formatter(&|p| format!(" {}", axis::label(*p, top)))
            .y_desc(axis::title("pressure p", &scale.label))
            .draw()?;
        Ok(())
    }

    /// What grey means, below the bar.
    fn draw_legend(&self, area: &Area<'_>) -> Drawn {
        if !self.mask.contains(&true) {
            return Ok(());
        }
        let (left, top) = (
            i32::try_from(LEFT + MAP + GAP)?,
            i32::try_from(HEIGHT - BOTTOM / 2)?,
        );
        let swatch = [(left, top), (left + 16, top + 16)];
        area.draw(&Rectangle::new(swatch, colours::RELIEF.filled()))?;
        area.draw(&Text::new("free relief", (left + 24, top), text(TINY)))?;
        Ok(())
    }

    fn colour(&self, element: usize, largest: f64) -> RGBColor {
        match (self.pressure[element] > 0.0, self.mask[element]) {
            (true, _) => colours::of_fraction(self.pressure[element] / largest),
            (false, true) => colours::RELIEF,
            (false, false) => colours::BARE,
        }
    }

    /// Coordinate of the lower side of element `i`, m.
    fn edge(&self, i: usize) -> f64 {
        self.side * (i as f64 / self.size as f64 - 0.5)
    }

    /// The largest coordinate on the axes of a window, m.
    fn farthest(&self, window: &Window) -> f64 {
        let ends = [window.x.start, window.x.end, window.y.start, window.y.end];
        ends.map(|i| self.edge(i).abs())
            .into_iter()
            .fold(0.0, f64::max)
    }
}

fn text(height: u32) -> TextStyle<'static> {
    (font::FAMILY, height).into_font().color(&colours::INK)
}

/// The title cut to the width of the picture.
fn fitted(title: &str) -> String {
    // A letter is about half as wide as it is high.
    let room = 2 * (WIDTH - LEFT) / LARGE;
    if title.chars().count() <= room as usize {
        return title.to_owned();
    }
    let cut: String = title.chars().take(room as usize - 1).collect();
    format!("{}…", cut.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_drawn_even_of_nothing() {
        let folder = tempfile::tempdir().unwrap();
        for pressure in [vec![0.0; 16], vec![1.0; 16], vec![1e-300; 16]] {
            let path = folder.path().join(file(0));
            let map = PressureMap {
                title: &"a long title ".repeat(40),
                units: Units::Si,
                certified: false,
                force: 0.0,
                penetration: -1.0,
                side: 1e-6,
                size: 4,
                pressure: &pressure,
                mask: &[true; 16],
            };
            map.write(&path).unwrap();
            let bytes = std::fs::read(&path).unwrap();
            assert_eq!(&bytes[1..4], b"PNG");
        }
    }
}
