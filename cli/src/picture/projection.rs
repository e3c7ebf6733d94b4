//! A box seen from above one of its corners, without perspective, and triangles filled with colour.

use super::colours::Colour;
use super::raster::Raster;

/// Turn about the vertical, and height of the eye above the horizon.
const TURN: f64 = 0.61;
const ELEVATION: f64 = 0.50;

/// The view onto a box with the corners (−1, −1, 0) and (1, 1, 1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projection {
    /// Pixels to a unit along x and y.
    pub unit: f64,
    /// Pixels to the height of the box.
    pub height: f64,
    /// Where the middle of the box's floor is on the sheet.
    pub centre: (f64, f64),
}

impl Projection {
    /// Where on the sheet a point of the box is; y of the sheet runs downwards.
    #[must_use]
    pub fn at(&self, [x, y, z]: [f64; 3]) -> (f64, f64) {
        let (sin, cos) = TURN.sin_cos();
        let (right, away) = (x * cos - y * sin, x * sin + y * cos);
        let up = away * ELEVATION.sin() * self.unit + z * ELEVATION.cos() * self.height;
        (self.centre.0 + self.unit * right, self.centre.1 - up)
    }
}

/// Fills a triangle with one colour; what lies outside the raster is left out.
pub fn fill(raster: &mut Raster, corners: [(f64, f64); 3], colour: Colour) {
    let [low, high] = [f64::min as fn(f64, f64) -> f64, f64::max].map(|pick| {
        let [a, b, c] = corners.map(|corner| corner.1);
        pick(a, pick(b, c))
    });
    for j in pixels(low, high, raster.height()) {
        // The row is a line through the centres of its pixels.
        let Some((left, right)) = cut(corners, j as f64 + 0.5) else {
            continue;
        };
        for i in pixels(left, right, raster.width()) {
            raster.set(i, j, colour);
        }
    }
}

/// The pixels whose centres may lie between two coordinates, within the raster; one more at the end hides the seams.
fn pixels(from: f64, to: f64, count: usize) -> std::ops::Range<usize> {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to the raster"
    )]
    let clamped = |at: f64| at.clamp(0.0, count as f64) as usize;
    clamped((from - 0.5).ceil())..clamped((to + 0.5).ceil())
}

/// Where a horizontal line cuts a triangle.
fn cut(corners: [(f64, f64); 3], y: f64) -> Option<(f64, f64)> {
    let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
    for (from, to) in [(0, 1), (1, 2), (2, 0)].map(|(a, b)| (corners[a], corners[b])) {
        if (from.1 <= y) != (to.1 <= y) {
            let x = from.0 + (to.0 - from.0) * (y - from.1) / (to.1 - from.1);
            (left, right) = (left.min(x), right.max(x));
        }
    }
    (left <= right).then_some((left, right))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_behind_is_higher_on_the_sheet_and_what_is_high_too() {
        let view = Projection {
            unit: 100.0,
            height: 50.0,
            centre: (0.0, 0.0),
        };
        assert_eq!(view.at([0.0; 3]), (0.0, 0.0));
        assert!(view.at([1.0, 1.0, 0.0]).1 < view.at([-1.0, -1.0, 0.0]).1);
        assert!(view.at([0.0, 0.0, 1.0]).1 < 0.0);
        assert!(view.at([1.0, -1.0, 0.0]).0 > view.at([-1.0, 1.0, 0.0]).0);
    }

    #[test]
    fn a_triangle_covers_its_half_of_a_square() {
        let mut raster = Raster::new(100, 100);
        let colour = Colour(1, 2, 3);
        fill(
            &mut raster,
            [(10.0, 10.0), (90.0, 10.0), (10.0, 90.0)],
            colour,
        );
        let filled = raster.opaque_pixels();
        // Half of 80², and at most two pixels more in each of 80 rows.
        assert!((3200..3200 + 160).contains(&filled), "{filled}");
    }

    #[test]
    fn a_triangle_outside_or_without_area_is_no_error() {
        let mut raster = Raster::new(10, 10);
        fill(
            &mut raster,
            [(-50.0, -50.0), (-20.0, -30.0), (-40.0, -20.0)],
            Colour(0, 0, 0),
        );
        fill(
            &mut raster,
            [(f64::NAN, 1.0), (2.0, f64::NAN), (3.0, 3.0)],
            Colour(0, 0, 0),
        );
        assert_eq!(raster.opaque_pixels(), 0);
    }
}
