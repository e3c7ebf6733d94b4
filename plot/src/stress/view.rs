//! The numbers of the pictures of stresses: a section below a line on the surface, and the tractions on the interfaces.

/// The stresses of one loading step shown in the pictures.
#[derive(Debug, Clone, PartialEq)]
pub struct StressView {
    /// The section.
    pub section: StressSection,
    /// The coordinates of the points on interfaces along x, and along y, m.
    pub centres: Vec<f64>,
    /// The interfaces that the planes reach, from the surface down.
    pub interfaces: Vec<InterfaceTractions>,
}

/// Stresses on the plane below a line on the surface.
#[derive(Debug, Clone, PartialEq)]
pub struct StressSection {
    /// The line.
    pub line: SurfaceLine,
    /// Increasing coordinates along the line, m; 0 is nearest to the axis.
    pub along: Vec<f64>,
    /// The depths, m; that of an interface occurs twice.
    pub depths: Vec<f64>,
    /// The body of each depth, counted from 0 at the surface.
    pub bodies: Vec<usize>,
    /// Von Mises' stress, Pa: the values along the line for each depth.
    pub von_mises: Vec<f64>,
    /// The largest principal stress, Pa, likewise.
    pub max_principal: Vec<f64>,
}

/// A straight line on the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceLine {
    /// A point on it, m.
    pub through: [f64; 2],
    /// Its direction, rad, from +x to +y.
    pub direction: f64,
}

/// The tractions on one interface, a row for each coordinate along x.
#[derive(Debug, Clone, PartialEq)]
pub struct InterfaceTractions {
    /// Its index, from 0 at the surface.
    pub index: usize,
    /// Depth, m.
    pub depth: f64,
    /// `τ = |(σ_xz, σ_yz)|`, Pa.
    pub shear: Vec<f64>,
    /// `σ_zz`, Pa, tension positive.
    pub normal: Vec<f64>,
}

impl StressSection {
    /// The coordinates along the line at which the section begins and ends, m.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        match (self.along.first(), self.along.last()) {
            (Some(first), Some(last)) => [*first, *last],
            _ => [0.0; 2],
        }
    }

    /// The depths at which its bodies begin, and at which the last one ends, m. A body with a single plane is skipped.
    #[must_use]
    pub fn depths_of_bodies(&self) -> Vec<f64> {
        let planes = self.bodies.chunk_by(|one, other| one == other);
        let mut depths = Vec::new();
        let mut first = 0;
        for planes in planes {
            let last = first + planes.len() - 1;
            if self.depths[last] > self.depths[first] {
                depths.pop();
                depths.extend([self.depths[first], self.depths[last]]);
            }
            first = last + 1;
        }
        depths
    }
}

/// Components of a direction smaller than this are taken as 0.
const ALIGNED: f64 = 1e-9;

impl SurfaceLine {
    fn unit(&self) -> [f64; 2] {
        let (sin, cos) = self.direction.sin_cos();
        [cos, sin].map(|part: f64| if part.abs() < ALIGNED { 0.0 } else { part })
    }

    /// The point at a coordinate along the line, m.
    #[must_use]
    pub fn at(&self, along: f64) -> [f64; 2] {
        let [x, y] = self.through;
        let [cos, sin] = self.unit();
        let shift = along - self.along([x, y]);
        [x + shift * cos, y + shift * sin]
    }

    /// The coordinate along the line of the projection of a point onto it, m.
    #[must_use]
    pub fn along(&self, [x, y]: [f64; 2]) -> f64 {
        let [cos, sin] = self.unit();
        x * cos + y * sin
    }

    /// The distance of a point from the line, m.
    #[must_use]
    pub fn distance(&self, point: [f64; 2]) -> f64 {
        let foot = self.at(self.along(point));
        (foot[0] - point[0]).hypot(foot[1] - point[1])
    }

    /// The coordinates between which the line lies within the square from `low` to `high` (m) in x and y.
    #[must_use]
    pub fn within(&self, low: f64, high: f64) -> [f64; 2] {
        let foot = self.at(0.0);
        let mut ends = [f64::NEG_INFINITY, f64::INFINITY];
        for (from, part) in foot.into_iter().zip(self.unit()) {
            if part != 0.0 {
                let [one, other] = [low, high].map(|side| (side - from) / part);
                ends = [ends[0].max(one.min(other)), ends[1].min(one.max(other))];
            }
        }
        ends
    }
}
