//! Where a repeated pattern lies on the surface: its offset from the indenter's axis, and its rotation.

use std::f64::consts::FRAC_PI_2;

use crate::error::{Quantity, TextureError, finite};

/// A rotation that differs from whole quarter turns by less is taken for them: some roundings of an angle given in
/// degrees. The sine and cosine are then exact, so that a turned pattern is as symmetric as it was.
const QUARTER_TURN_TO: f64 = 1e-14;

/// Position and direction of a pattern in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Placement {
    offset: [f64; 2],
    rotation: f64,
    /// Cosine and sine of the rotation.
    direction: [f64; 2],
}

impl Placement {
    /// Puts the pattern's origin at `offset` (m) and turns it by `rotation` (radians) from x to y about it.
    pub(crate) fn new(offset: [f64; 2], rotation: f64) -> Result<Self, TextureError> {
        for coordinate in offset {
            finite(Quantity::Offset, coordinate)?;
        }
        finite(Quantity::Rotation, rotation)?;
        let direction = match quarter_turns(rotation) {
            Some(0) => [1.0, 0.0],
            Some(1) => [0.0, 1.0],
            Some(2) => [-1.0, 0.0],
            Some(_) => [0.0, -1.0],
            None => [rotation.cos(), rotation.sin()],
        };
        Ok(Self {
            offset,
            rotation,
            direction,
        })
    }

    /// Position of the pattern's origin, m.
    pub(crate) fn offset(&self) -> [f64; 2] {
        self.offset
    }

    /// Rotation from x to y, radians.
    pub(crate) fn rotation(&self) -> f64 {
        self.rotation
    }

    /// The coordinates of a point (m) along the axes of the pattern.
    pub(crate) fn local(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        self.turned_back([x - self.offset[0], y - self.offset[1]])
    }

    /// The components of a vector along the axes of the pattern.
    pub(crate) fn turned_back(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [cosine, sine] = self.direction;
        [cosine * x + sine * y, cosine * y - sine * x]
    }

    /// Whether a pattern that is symmetric about the lines through the corners and the middles of a rectangular cell
    /// with these sides (m, infinite where it is uniform) is symmetric in x and y: it is turned by whole quarter turns,
    /// and its offset is a multiple of half the cell along both axes.
    pub(crate) fn is_mirrored(&self, cell: [f64; 2]) -> bool {
        let [along_x, along_y] = match quarter_turns(self.rotation) {
            Some(turns) if turns % 2 == 0 => cell,
            Some(_) => [cell[1], cell[0]],
            None => return false,
        };
        let is_half =
            |offset: f64, side: f64| side.is_infinite() || (2.0 * offset / side).fract() == 0.0;
        is_half(self.offset[0], along_x) && is_half(self.offset[1], along_y)
    }
}

/// The whole quarter turns of a rotation, 0 to 3; none if it is none.
fn quarter_turns(rotation: f64) -> Option<u8> {
    let turns = rotation / FRAC_PI_2;
    let whole = turns.round();
    if (turns - whole).abs() > QUARTER_TURN_TO * whole.abs() {
        return None;
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a whole number from 0 to 3"
    )]
    Some(whole.rem_euclid(4.0) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_quarter_turns_are_exact() {
        for (degrees, wanted) in [
            (0.0, [3.0, 4.0]),
            (90.0, [4.0, -3.0]),
            (-180.0, [-3.0, -4.0]),
            (270.0, [-4.0, 3.0]),
            (450.0, [4.0, -3.0]),
        ] {
            let placed = Placement::new([1.0, -2.0], f64::to_radians(degrees)).unwrap();
            assert_eq!(placed.local([4.0, 2.0]), wanted, "{degrees}");
        }
    }

    #[test]
    fn the_pattern_turns_from_x_to_y_about_its_origin() {
        let placed = Placement::new([1.0, 0.0], f64::to_radians(30.0)).unwrap();
        let [u, v] = placed.local([1.0 + 0.75_f64.sqrt(), 0.5]);
        assert!((u - 1.0).abs() < 1e-15 && v.abs() < 1e-15, "{u}, {v}");
    }

    #[test]
    fn a_pattern_is_mirrored_at_half_cells_and_quarter_turns() {
        let is_mirrored = |offset, degrees: f64| {
            let placed = Placement::new(offset, degrees.to_radians()).unwrap();
            placed.is_mirrored([1.0, 3.0])
        };
        assert!(is_mirrored([0.5, -3.0], 0.0) && is_mirrored([1.5, 0.5], 90.0));
        assert!(!is_mirrored([1.5, 0.5], 180.0) && !is_mirrored([0.0, 0.0], 45.0));
        let line = Placement::new([0.5, 0.3], 0.0).unwrap();
        assert!(line.is_mirrored([1.0, f64::INFINITY]));
    }

    #[test]
    fn a_rotation_is_finite() {
        assert!(Placement::new([0.0; 2], f64::NAN).is_err());
        assert!(Placement::new([f64::INFINITY, 0.0], 0.0).is_err());
    }
}
