//! A box seen from above one of its corners, in parallel projection.

/// Turn about the vertical, and elevation of the eye above the horizon.
const TURN: f64 = 0.61;
const ELEVATION: f64 = 0.50;

/// The view of a box with the corners (−1, −1, 0) and (1, 1, 1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projection {
    /// Pixels per unit along x and y.
    pub unit: f64,
    /// Pixels for the height of the box.
    pub height: f64,
    /// Position on the sheet of the centre of the floor.
    pub centre: (f64, f64),
}

impl Projection {
    /// Returns the position on the sheet of a point of the box; y of the sheet runs downwards.
    #[must_use]
    pub fn at(&self, [x, y, z]: [f64; 3]) -> (f64, f64) {
        let (sin, cos) = TURN.sin_cos();
        let (right, away) = (x * cos - y * sin, x * sin + y * cos);
        (self.centre.0 + self.unit * right, self.row(away, z))
    }

    /// Returns the row on the sheet, counted downwards, of a point this far behind the middle and this high.
    #[must_use]
    pub fn row(&self, away: f64, z: f64) -> f64 {
        self.centre.1 - away * ELEVATION.sin() * self.unit - z * ELEVATION.cos() * self.height
    }

    /// Returns the line of sight through the points at this abscissa of the sheet.
    #[must_use]
    pub fn line_of_sight(&self, x: f64) -> LineOfSight {
        let (sin, cos) = TURN.sin_cos();
        let right = (x - self.centre.0) / self.unit;
        LineOfSight {
            origin: [right * cos, -right * sin],
            direction: [sin, cos],
        }
    }
}

/// A straight line of the plan whose points lie behind one another for the eye.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineOfSight {
    /// The point of the line nearest to the middle of the floor.
    origin: [f64; 2],
    /// The direction away from the eye; positive along both axes.
    direction: [f64; 2],
}

impl LineOfSight {
    /// Returns the distance behind the middle at which the line crosses an edge normal to the x (0) or the y axis (1).
    #[must_use]
    pub fn distance(&self, axis: usize, edge: f64) -> f64 {
        (edge - self.origin[axis]) / self.direction[axis]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_farther_back_or_higher_are_drawn_higher() {
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
    fn points_on_a_line_of_sight_project_to_one_place() {
        let view = Projection {
            unit: 100.0,
            height: 50.0,
            centre: (7.0, 9.0),
        };
        let (x, y) = view.at([0.3, -0.4, 0.2]);
        let line = view.line_of_sight(x);
        let [away, same] = [line.distance(0, 0.3), line.distance(1, -0.4)];
        // Rounding of numbers of order 1 and of order 10.
        assert!((away - same).abs() < 1e-14);
        assert!((view.row(away, 0.2) - y).abs() < 1e-12);
    }
}
