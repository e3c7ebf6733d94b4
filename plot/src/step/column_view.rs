//! An oblique view of a field of columns, by the floating-horizon algorithm.
//!
//! The pixels of one vertical line of the sheet lie over one straight line of the plan. The algorithm follows that line
//! away from the eye. Each column shows the part of its side and its top that rises above all columns before it, so
//! every pixel is coloured once.

use crate::sheet::colours::Colour;
use crate::sheet::raster::Raster;
use crate::sheet::svg::Rect;
use crate::step::projection::Projection;

/// Light on the sides of a column that face along x and along y; on its top it is 1.
const LIT: [f64; 2] = [0.74, 0.88];

/// Points along each side of a pixel; the pixel shows their mean.
const FINENESS: usize = 2;

/// Columns on a square of cells.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnField {
    /// Cells per side.
    pub cells: usize,
    /// The first and last edge of the cells along x and along y, in the box.
    pub ends: [[f64; 2]; 2],
    /// Height and colour of each column; the second index runs along y.
    pub tops: Vec<(f64, Colour)>,
}

/// Draws the columns within a rectangle of the sheet, on a transparent background.
#[must_use]
pub fn draw(columns: &ColumnField, view: &Projection, place: Rect) -> Raster {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the size of a picture"
    )]
    let [width, height] = [place.width, place.height].map(|side| side as usize);
    let mut raster = Raster::transparent(width, height);
    let mut lines = vec![vec![None; FINENESS * height]; FINENESS];
    for i in 0..width {
        for (part, line) in lines.iter_mut().enumerate() {
            let across = (part as f64 + 0.5) / FINENESS as f64;
            look(columns, view, place, i as f64 + across, line);
        }
        for j in 0..height {
            let points = lines
                .iter()
                .flat_map(|line| &line[FINENESS * j..FINENESS * (j + 1)]);
            raster.set(i, j, mean(points));
        }
    }
    raster
}

/// Colours the points of the vertical line `across` pixels from the left of the rectangle.
fn look(
    columns: &ColumnField,
    view: &Projection,
    place: Rect,
    across: f64,
    line: &mut [Option<Colour>],
) {
    line.fill(None);
    let line_of_sight = view.line_of_sight(place.left + across);
    // Distances at which the line enters and leaves the field along each axis, and the distance between cells.
    let ends =
        |end: usize| [0, 1].map(|axis| line_of_sight.distance(axis, columns.ends[axis][end]));
    let [entered, left] = [0, 1].map(ends);
    let steps = [0, 1].map(|axis: usize| (left[axis] - entered[axis]) / columns.cells as f64);
    let mut distance = entered[0].max(entered[1]);
    let leaving = left[0].min(left[1]);
    // The axis normal to the side that faces the eye.
    let mut facing = usize::from(entered[1] > entered[0]);
    let mut cell = [0, 1].map(|axis: usize| {
        let passed = (distance - entered[axis]) / steps[axis];
        truncated(passed).min(columns.cells.saturating_sub(1))
    });
    let row =
        |distance: f64, height: f64| FINENESS as f64 * (view.row(distance, height) - place.top);
    let mut horizon = Horizon::at(row(distance, 0.0), line);
    while distance < leaving && cell.iter().all(|index| *index < columns.cells) {
        let (height, colour) = columns.tops[cell[0] * columns.cells + cell[1]];
        let next = [0, 1].map(|axis: usize| entered[axis] + (cell[axis] + 1) as f64 * steps[axis]);
        horizon.raise(row(distance, height), || colour.lit(LIT[facing]));
        facing = usize::from(next[1] < next[0]);
        distance = next[facing];
        horizon.raise(row(distance, height), || colour);
        cell[facing] += 1;
    }
}

/// The upper end of the coloured part of a line.
struct Horizon<'a> {
    line: &'a mut [Option<Colour>],
    /// The points from here on are already coloured, or in front of the field.
    done_from: usize,
}

impl<'a> Horizon<'a> {
    fn at(row: f64, line: &'a mut [Option<Colour>]) -> Self {
        let done_from = first_below(row).min(line.len());
        Self { line, done_from }
    }

    /// Colours the points between a row and the horizon, if the row is above it.
    fn raise(&mut self, row: f64, colour: impl FnOnce() -> Colour) {
        let first = first_below(row);
        if first < self.done_from {
            self.line[first..self.done_from].fill(Some(colour()));
            self.done_from = first;
        }
    }
}

/// The first point with its middle below a row.
fn first_below(row: f64) -> usize {
    truncated(row + 0.5)
}

/// The whole part of a number; 0 if it is negative or NaN.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the conversion saturates"
)]
fn truncated(number: f64) -> usize {
    number as usize
}

/// Red, green, blue and opacity of a pixel: the mean colour of its coloured points, and their share.
fn mean<'a>(points: impl Iterator<Item = &'a Option<Colour>>) -> [u8; 4] {
    let (mut sums, mut opaque) = ([0_u32; 3], 0);
    for Colour(red, green, blue) in points.flatten() {
        for (sum, channel) in sums.iter_mut().zip([red, green, blue]) {
            *sum += u32::from(*channel);
        }
        opaque += 1;
    }
    let byte = |value: u32| u8::try_from(value).unwrap_or(u8::MAX);
    let [red, green, blue] = sums.map(|sum| byte(sum / opaque.max(1)));
    let points = u32::try_from(FINENESS * FINENESS).unwrap_or(u32::MAX);
    [red, green, blue, byte(255 * opaque / points)]
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIEW: Projection = Projection {
        unit: 40.0,
        height: 60.0,
        centre: (75.0, 90.0),
    };
    const PLACE: Rect = Rect {
        left: 10.0,
        top: 10.0,
        width: 130.0,
        height: 120.0,
    };

    fn columns(cells: usize, height: impl Fn(usize, usize) -> f64) -> ColumnField {
        // Each column has its own colour: red by the row, green by the column.
        let byte = |i: usize| u8::try_from(20 * i).unwrap();
        let column = |e: usize| {
            let (i, j) = (e / cells, e % cells);
            (height(i, j), Colour(byte(i), byte(j), 200))
        };
        ColumnField {
            cells,
            ends: [[-1.0, 0.8], [-0.9, 1.0]],
            tops: (0..cells * cells).map(column).collect(),
        }
    }

    /// Finds by small steps the first column that a ray from the eye through a point of the sheet meets.
    fn met(columns: &ColumnField, (left, top): (f64, f64)) -> Option<Colour> {
        let (cos, sin) = {
            // The turn of the view, from the position of a point on the x axis.
            let (x, _) = VIEW.at([1.0, 0.0, 0.0]);
            let cos = (x - VIEW.centre.0) / VIEW.unit;
            (cos, (1.0 - cos * cos).sqrt())
        };
        let right = (left - VIEW.centre.0) / VIEW.unit;
        (-20_000..20_000).find_map(|step| {
            let away = f64::from(step) * 1e-4;
            let place = [right * cos + away * sin, away * cos - right * sin];
            let [i, j] = [0, 1].map(|axis: usize| {
                let [from, to] = columns.ends[axis];
                (place[axis] - from) / (to - from) * columns.cells as f64
            });
            let inside = |index: f64| index >= 0.0 && index < columns.cells as f64;
            let (height, colour) = (inside(i) && inside(j))
                .then(|| columns.tops[truncated(i) * columns.cells + truncated(j)])?;
            // The ray is between the floor, up to one step, and the top of the column at this place.
            let [low, high] = [0.0, height].map(|z| VIEW.at([place[0], place[1], z]).1);
            (high <= top && top <= low + 0.01).then_some(colour)
        })
    }

    #[test]
    fn every_point_shows_the_first_surface_on_its_ray() {
        let cells = 9;
        let field = columns(cells, |i, j| ((5 * i + 3 * j) % 7) as f64 / 7.0);
        let height = truncated(PLACE.height);
        let (mut seen, mut wrong) = (0, 0);
        for i in (1..130).step_by(3) {
            let mut line = vec![None; FINENESS * height];
            let across = f64::from(i) + 0.37;
            look(&field, &VIEW, PLACE, across, &mut line);
            for (j, found) in line.iter().enumerate().step_by(5) {
                let top = PLACE.top + (j as f64 + 0.5) / FINENESS as f64;
                let expected = met(&field, (PLACE.left + across, top));
                seen += usize::from(expected.is_some());
                // The sides are darker.
                let shades = expected.map(|c| [c, c.lit(LIT[0]), c.lit(LIT[1])]);
                let is_shown = match (found, shades) {
                    (Some(found), Some(shades)) => shades.contains(found),
                    (found, shades) => found.is_none() && shades.is_none(),
                };
                wrong += usize::from(!is_shown);
            }
        }
        // The steps of the ray occasionally miss an edge by a fiftieth of a pixel.
        assert!(seen > 500 && wrong <= 3, "{wrong} of {seen}");
    }

    #[test]
    fn each_face_of_a_column_has_its_own_shade() {
        let colour = Colour(100, 150, 200);
        let column = ColumnField {
            cells: 1,
            ends: [[-0.5, 0.5]; 2],
            tops: vec![(1.0, colour)],
        };
        let shown = |point: [f64; 3]| {
            let (left, top) = VIEW.at(point);
            let mut line = vec![None; FINENESS * truncated(PLACE.height)];
            look(&column, &VIEW, PLACE, left - PLACE.left, &mut line);
            line[truncated(FINENESS as f64 * (top - PLACE.top))]
        };
        assert_eq!(shown([0.0, 0.0, 1.0]), Some(colour));
        assert_eq!(shown([-0.5, 0.0, 0.5]), Some(colour.lit(LIT[0])));
        assert_eq!(shown([0.0, -0.5, 0.5]), Some(colour.lit(LIT[1])));
        assert_eq!(shown([0.5, 0.5, 1.3]), None);
        assert_eq!(shown([-0.6, -0.6, 0.0]), None);
    }

    #[test]
    fn a_flat_field_covers_its_area() {
        let raster = draw(&columns(5, |_, _| 0.0), &VIEW, PLACE);
        let area: f64 = raster.opacities().map(|o| f64::from(o) / 255.0).sum();
        let corner = |x, y| VIEW.at([x, y, 0.0]);
        let (a, b, c) = (corner(-1.0, -0.9), corner(0.8, -0.9), corner(-1.0, 1.0));
        let expected = ((b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)).abs();
        // Points on a grid of half pixels, along a circumference of about 300.
        assert!(
            (area - expected).abs() < 0.01 * expected,
            "{area} {expected}"
        );
    }

    #[test]
    fn a_pixel_is_the_mean_of_its_points() {
        let points = [
            Some(Colour(100, 0, 10)),
            None,
            None,
            Some(Colour(200, 0, 20)),
        ];
        assert_eq!(mean(points.iter()), [150, 0, 15, 127]);
        assert_eq!(mean([None; 4].iter()), [0; 4]);
    }

    #[test]
    fn a_field_outside_the_view_is_not_drawn() {
        let elsewhere = Rect {
            left: 900.0,
            ..PLACE
        };
        let raster = draw(&columns(3, |_, _| 1.0), &VIEW, elsewhere);
        assert!(raster.opacities().all(|opacity| opacity == 0));
    }
}
