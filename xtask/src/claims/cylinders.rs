//! Where the cylinders of the paper's relief stand: on a square lattice, one of them on the axis.

/// Radius and period of the cylinders.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cylinders {
    /// Radius of a cylinder.
    pub(super) radius: f64,
    /// Distance between the axes of neighbours.
    pub(super) period: f64,
}

impl Cylinders {
    /// Column and row of the cylinder nearest to a point; the central one is `[0, 0]`.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "a domain holds far fewer cylinders than i64 counts"
    )]
    pub(super) fn nearest(self, point: [f64; 2]) -> [i64; 2] {
        point.map(|x| (x / self.period).round() as i64)
    }

    /// Distance of a point from the axis of the nearest cylinder, in radii of the cylinder.
    pub(super) fn relative_distance(self, point: [f64; 2]) -> f64 {
        let [column, row] = self.nearest(point);
        let [x, y] = point;
        (x - column as f64 * self.period).hypot(y - row as f64 * self.period) / self.radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CYLINDERS: Cylinders = Cylinders {
        radius: 0.25,
        period: 1.0,
    };

    #[test]
    fn a_point_belongs_to_the_nearest_cylinder() {
        assert_eq!(CYLINDERS.nearest([0.2, -0.1]), [0, 0]);
        assert_eq!(CYLINDERS.nearest([0.8, -2.1]), [1, -2]);
    }

    #[test]
    fn distances_are_in_radii() {
        // Exact in binary.
        assert!((CYLINDERS.relative_distance([1.25, 2.0]) - 1.0).abs() < 1e-15);
        assert!(CYLINDERS.relative_distance([0.0, 0.0]).abs() < 1e-15);
    }
}
