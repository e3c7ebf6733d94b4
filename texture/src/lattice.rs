//! The two planar lattices on which round features stand: cylinders and dimples.
//!
//! Both are described by a rectangular cell: it has one centre at its corner and, for the hexagonal lattice, another in
//! its middle. The nearest point of a rectangular lattice is found exactly by rounding each coordinate, so the nearest
//! centre is the nearer of at most two candidates.

use std::f64::consts::PI;

/// Arrangement of round features in the plane; the period T is the distance between neighbouring centres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Lattice {
    /// Centres at `T (m, n)`: four neighbours each.
    #[default]
    Square,
    /// Centres at `T (m + n/2, n √3/2)`: six neighbours each, two of them along x.
    Hexagonal,
}

impl Lattice {
    /// Sides along x and y of the rectangular cell, in the unit of `period`: `T × T`, or `T × √3 T` with two centres.
    #[must_use]
    pub fn cell(self, period: f64) -> [f64; 2] {
        match self {
            Self::Square => [period, period],
            Self::Hexagonal => [period, 3.0_f64.sqrt() * period],
        }
    }

    /// Distance from `point` to the nearest centre of the lattice that has one centre on the origin, in the unit of
    /// `period`.
    ///
    /// Exact up to rounding for points anywhere in the plane.
    #[must_use]
    pub fn distance_to_centre(self, period: f64, point: [f64; 2]) -> f64 {
        let cell = self.cell(period);
        let [x, y] = point;
        let to_corner = distance_to_corner(cell, [x, y]);
        match self {
            Self::Square => to_corner,
            Self::Hexagonal => to_corner.min(distance_to_corner(
                cell,
                [x - 0.5 * cell[0], y - 0.5 * cell[1]],
            )),
        }
    }

    /// Fraction of the plane covered by non-overlapping discs of the given radius, in closed form.
    #[must_use]
    pub fn area_fraction(self, radius: f64, period: f64) -> f64 {
        let disc = PI * (radius / period).powi(2);
        match self {
            // π r²/T²
            Self::Square => disc,
            // 2π r²/(√3 T²)
            Self::Hexagonal => 2.0 * disc / 3.0_f64.sqrt(),
        }
    }

    /// The period (m) at which discs of a radius (m) cover this fraction of the plane:
    /// `T = r √(π/φ)` (square) or `r √(2π/(√3 φ))` (hexagonal).
    #[must_use]
    pub fn period_of(self, radius: f64, area_fraction: f64) -> f64 {
        let cell = match self {
            Self::Square => 1.0,
            Self::Hexagonal => 0.75_f64.sqrt(),
        };
        radius * (PI / (cell * area_fraction)).sqrt()
    }

    /// The fraction of the plane that touching discs cover: `π/4` (square) or `π/√12` (hexagonal).
    #[must_use]
    pub fn largest_area_fraction(self) -> f64 {
        self.area_fraction(0.5, 1.0)
    }
}

/// Distance from a point to the nearest corner of the rectangular lattice with the given cell.
fn distance_to_corner(cell: [f64; 2], point: [f64; 2]) -> f64 {
    let [dx, dy] = [0, 1].map(|axis| point[axis] - cell[axis] * (point[axis] / cell[axis]).round());
    (dx * dx + dy * dy).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Smallest distance to any of the centres with indices up to 12, by the definition.
    fn by_enumeration(lattice: Lattice, period: f64, [x, y]: [f64; 2]) -> f64 {
        let mut nearest = f64::INFINITY;
        for m in -12..=12 {
            for n in -12..=12 {
                let [m, n] = [f64::from(m), f64::from(n)];
                let centre = match lattice {
                    Lattice::Square => [m, n],
                    Lattice::Hexagonal => [m + 0.5 * n, 0.75_f64.sqrt() * n],
                };
                nearest = nearest.min((x - period * centre[0]).hypot(y - period * centre[1]));
            }
        }
        nearest
    }

    proptest! {
        #[test]
        fn distance_agrees_with_enumeration(x in -4.0..4.0, y in -4.0..4.0, period in 0.8..2.0) {
            for lattice in [Lattice::Square, Lattice::Hexagonal] {
                let found = lattice.distance_to_centre(period, [x, y]);
                // Rounding of coordinates up to 30 is 4e-15.
                prop_assert!((found - by_enumeration(lattice, period, [x, y])).abs() < 2e-14);
            }
        }
    }

    #[test]
    fn neighbours_stand_one_period_apart() {
        // The points halfway to the six neighbours of the origin are T/2 from two centres and no nearer to any other.
        for k in 0..6 {
            let (sine, cosine) = (PI / 3.0 * f64::from(k)).sin_cos();
            let half = Lattice::Hexagonal.distance_to_centre(2.0, [cosine, sine]);
            assert!((half - 1.0).abs() < 1e-15, "rounding of the angle: {half}");
        }
        assert_eq!(Lattice::Square.distance_to_centre(2.0, [1.0, 0.0]), 1.0);
    }

    #[test]
    fn the_period_of_an_area_fraction_gives_it_back() {
        for lattice in [Lattice::Square, Lattice::Hexagonal] {
            for fraction in [0.01, 0.3, lattice.largest_area_fraction()] {
                let period = lattice.period_of(2.0, fraction);
                let found = lattice.area_fraction(2.0, period);
                assert!((found / fraction - 1.0).abs() < 1e-14, "{found}");
            }
            let touching = lattice.period_of(2.0, lattice.largest_area_fraction());
            assert!((touching - 4.0).abs() < 1e-14, "{touching}");
        }
    }

    #[test]
    fn touching_discs_cover_the_known_packing_densities() {
        // π/4 and π/√12, the densities of the square and of the densest packing of equal discs.
        assert!((Lattice::Square.area_fraction(0.5, 1.0) - PI / 4.0).abs() < 1e-15);
        assert!((Lattice::Hexagonal.area_fraction(0.5, 1.0) - PI / 12.0_f64.sqrt()).abs() < 1e-15);
    }
}
