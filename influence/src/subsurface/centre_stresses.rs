//! The stresses under the centres of elements at one depth, by sums over the loaded elements.
//!
//! The fields of one element are tabulated at the offsets of a quarter of a grid, once for each depth. A stress is then
//! a sum of products, with no more work than the loaded elements: for a few places less than a plane by FFT.

use super::element::ElementFields;
use super::element_table::ElementTable;
use super::plane_fields::{UNDER_PRESSURE, transposed, under_traction};
use super::state::{FIELDS, SubsurfaceState, SurfaceLoad};
use crate::transform::Parity;

/// Fields before the stresses.
const DISPLACEMENTS: usize = 3;
/// Sums made side by side.
const LANES: usize = 8;

/// The stresses of one element at the centres of those around it, and their sums under a pressure and friction.
pub struct CentreStresses {
    offsets: usize,
    /// Factors of a traction along x and y per pressure.
    friction: [f64; 2],
    normal: ElementTable,
    tangential: Option<ElementTable>,
    /// The fields under the traction in axes that have changed places.
    transposed: Vec<Vec<f64>>,
}

impl CentreStresses {
    /// Room for offsets below `offsets` along x and y, and a traction of `friction` times the pressure along x and y.
    #[must_use]
    pub fn new(offsets: usize, friction: [f64; 2]) -> Self {
        let slides = friction.iter().any(|factor| *factor != 0.0);
        Self {
            offsets,
            friction,
            normal: ElementTable::new(offsets),
            tangential: slides.then(|| ElementTable::new(offsets)),
            transposed: Vec::new(),
        }
    }

    /// Offsets along x and y.
    #[must_use]
    pub fn offsets(&self) -> usize {
        self.offsets
    }

    /// Distance (m) for which the fields of an element of side `element_side` (m) must be made.
    #[must_use]
    pub fn reach(&self, element_side: f64) -> f64 {
        std::f64::consts::SQRT_2 * element_side * self.offsets as f64
    }

    /// Tabulates the fields of an element at its depth, in place of those before.
    pub fn fill(&mut self, fields: &ElementFields) {
        self.normal.fill(fields, SurfaceLoad::Pressure);
        if let Some(tangential) = &mut self.tangential {
            tangential.fill(fields, SurfaceLoad::Traction);
            let stresses = DISPLACEMENTS..FIELDS;
            self.transposed = if self.friction[1] == 0.0 {
                Vec::new()
            } else {
                stresses
                    .map(|field| transposed(tangential.field(field), self.offsets))
                    .collect()
            };
        }
    }

    /// The stress under the centre of the element at `place`, counted from the first of a square of `size` × `size`
    /// loaded elements, under their pressures (Pa), row after row along x; without displacements.
    ///
    /// # Panics
    /// If an element with pressure is farther than the offsets.
    #[must_use]
    pub fn at(&self, pressure: &[f64], size: usize, place: [isize; 2]) -> SubsurfaceState {
        let mut sums = [[0.0; FIELDS]; 3];
        for (row, pressures) in pressure.chunks_exact(size).enumerate() {
            let Some(first) = pressures.iter().position(|p| *p > 0.0) else {
                continue;
            };
            let end = pressures.iter().rposition(|p| *p > 0.0).unwrap_or(first) + 1;
            let m = place[0] - row.cast_signed();
            let line = Line {
                pressures: &pressures[first..end],
                place: place[1] - first.cast_signed(),
                mirror: if m < 0 { -1.0 } else { 1.0 },
                row: m.unsigned_abs() * self.offsets..(m.unsigned_abs() + 1) * self.offsets,
            };
            for field in DISPLACEMENTS..FIELDS {
                sums[0][field] += line.sum(self.normal.field(field), UNDER_PRESSURE[field]);
                let Some(tangential) = &self.tangential else {
                    continue;
                };
                let [x, y] = under_traction(field);
                sums[1][field] += line.sum(tangential.field(field), [x, y]);
                if let Some(values) = self.transposed.get(field - DISPLACEMENTS) {
                    sums[2][field] += line.sum(values, [y, x]);
                }
            }
        }
        let [normal, along_x, along_y] = sums.map(SubsurfaceState::from_fields);
        normal + along_x * self.friction[0] + along_y.transposed() * self.friction[1]
    }
}

/// A row of loaded elements as seen from a place.
struct Line<'a> {
    pressures: &'a [f64],
    /// Of the place, counted from the first of them.
    place: isize,
    /// −1 where the place lies before the row along x.
    mirror: f64,
    /// The row of the tables.
    row: std::ops::Range<usize>,
}

impl Line<'_> {
    /// The sum of a field of these parities.
    fn sum(&self, table: &[f64], [x, y]: [Parity; 2]) -> f64 {
        let values = &table[self.row.clone()];
        let (place, count) = (self.place, self.pressures.len());
        // Elements up to the place are seen at falling offsets, those after it at rising ones.
        let split = (place + 1).clamp(0, count.cast_signed()).unsigned_abs();
        let (before, after) = self.pressures.split_at(split);
        let falling = (place + 1 - split.cast_signed()).unsigned_abs();
        let rising = (split.cast_signed() - place).unsigned_abs();
        let mut sum = 0.0;
        if !before.is_empty() {
            sum += dot_reversed(before, &values[falling..falling + before.len()]);
        }
        if !after.is_empty() {
            sum += y.sign(-1.0) * dot(after, &values[rising..rising + after.len()]);
        }
        x.sign(self.mirror) * sum
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (a, b) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest = a.remainder().iter().zip(b.remainder());
    let rest: f64 = rest.map(|(a, b)| a * b).sum();
    for (a, b) in a.zip(b) {
        for lane in 0..LANES {
            lanes[lane] += a[lane] * b[lane];
        }
    }
    lanes.iter().sum::<f64>() + rest
}

/// The product of one list with the other from its end on.
fn dot_reversed(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (a, b) = (a.chunks_exact(LANES), b.rchunks_exact(LANES));
    let rest = a.remainder().iter().zip(b.remainder().iter().rev());
    let rest: f64 = rest.map(|(a, b)| a * b).sum();
    for (a, b) in a.zip(b) {
        for lane in 0..LANES {
            lanes[lane] += a[lane] * b[LANES - 1 - lane];
        }
    }
    lanes.iter().sum::<f64>() + rest
}
