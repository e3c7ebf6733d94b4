//! The fields of one solved step: pressure, displacement and the cylinders under them.

use pellicle_contact::SampledModel;

use super::cases::{PERIOD, PaperCase, RADIUS, path};

/// N² values each, first index along x.
pub struct SolvedFields {
    /// Pressure `p`.
    pub pressure: Vec<f64>,
    /// Displacement `u` of the body's surface, positive into the body.
    pub displacement: Vec<f64>,
    /// Grid, relief and indenter.
    pub geometry: SampledModel,
}

impl SolvedFields {
    /// The fields of a case's step.
    pub fn of(case: PaperCase, step: usize, elements: usize) -> Self {
        let path = path(case, elements);
        let geometry = path.geometry();
        let surface = path.surface(&geometry, step).expect("a solved step");
        Self {
            pressure: path.steps[step].solution.pressure.clone(),
            displacement: surface.displacement,
            geometry,
        }
    }

    /// Elements per side, N.
    pub fn size(&self) -> usize {
        self.geometry.grid.size()
    }

    /// Centre of the element at `index`.
    pub fn point(&self, index: usize) -> [f64; 2] {
        [index / self.size(), index % self.size()].map(|i| self.geometry.grid.centre(i))
    }

    /// Distance of the element at `index` from the axis.
    pub fn radius(&self, index: usize) -> f64 {
        let [x, y] = self.point(index);
        x.hypot(y)
    }

    /// Whether the element at `index` lies on the relief.
    pub fn is_on_relief(&self, index: usize) -> bool {
        self.geometry.relief.mask()[index]
    }

    /// The elements in contact.
    pub fn contact(&self) -> impl Iterator<Item = usize> {
        (0..self.pressure.len()).filter(|&index| self.pressure[index] > 0.0)
    }

    /// Distance of the farthest of some elements from the axis.
    pub fn farthest(&self, elements: impl Iterator<Item = usize>) -> f64 {
        elements.map(|index| self.radius(index)).fold(0.0, f64::max)
    }
}

/// Column and row of the cylinder nearest to a point; the central one is `[0, 0]`.
#[expect(
    clippy::cast_possible_truncation,
    reason = "a domain holds few cylinders"
)]
pub fn nearest_cylinder(point: [f64; 2]) -> [i64; 2] {
    point.map(|x| (x / PERIOD).round() as i64)
}

/// Distance of a point from the axis of the nearest cylinder, in radii of the cylinder.
pub fn relative_distance(point: [f64; 2]) -> f64 {
    let [column, row] = nearest_cylinder(point);
    let [x, y] = point;
    (x - column as f64 * PERIOD).hypot(y - row as f64 * PERIOD) / RADIUS
}
