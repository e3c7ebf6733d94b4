//! The fields under the centres of elements at one depth, by sums over the loaded elements.
//!
//! The fields of one element are tabulated at the offsets of a quarter of a grid, once for each depth. A state is then
//! a sum of products, with no more work than the loaded elements: for a few places less than a plane by FFT.

use super::element::ElementFields;
use super::element_table::ElementTable;
use super::plane_fields::{UNDER_PRESSURE, under_traction};
use super::state::{FIELDS, SubsurfaceState, SurfaceLoad};
use crate::transform::Parity;

/// The fields of one element at the centres of those around it, and the sums under a pressure and friction.
pub struct CentreFields {
    offsets: usize,
    /// Factors of a traction along x and y per pressure.
    friction: [f64; 2],
    normal: ElementTable,
    tangential: Option<ElementTable>,
    is_held: bool,
}

impl CentreFields {
    /// Room for offsets below `offsets` along x and y, and a traction of `friction` times the pressure along x and y.
    #[must_use]
    pub fn new(offsets: usize, friction: [f64; 2]) -> Self {
        let slides = friction.iter().any(|factor| *factor != 0.0);
        Self {
            offsets,
            friction,
            normal: ElementTable::new(offsets),
            tangential: slides.then(|| ElementTable::new(offsets)),
            is_held: true,
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
        }
        self.is_held = fields.is_bounded(0);
    }

    /// The state under the centre of the element at `place`, counted from the first of a square of `size` × `size`
    /// loaded elements, under their pressures (Pa), row after row along x.
    ///
    /// `u_x` and `u_y` are NaN where they are unbounded.
    ///
    /// # Panics
    /// If an element with pressure is farther than the offsets.
    #[must_use]
    pub fn at(&self, pressure: &[f64], size: usize, place: [isize; 2]) -> SubsurfaceState {
        let mut sums = [[0.0; FIELDS]; 3];
        for (row, pressures) in pressure.chunks_exact(size).enumerate() {
            let m = place[0] - row.cast_signed();
            let Some(first) = pressures.iter().position(|p| *p > 0.0) else {
                continue;
            };
            for (column, p) in pressures.iter().enumerate().skip(first) {
                if *p <= 0.0 {
                    continue;
                }
                let n = place[1] - column.cast_signed();
                let at = [m.unsigned_abs(), n.unsigned_abs()];
                let sign = [m < 0, n < 0].map(|mirrored| if mirrored { -1.0 } else { 1.0 });
                let signed = |[x, y]: [Parity; 2]| x.sign(sign[0]) * y.sign(sign[1]);
                for field in 0..FIELDS {
                    sums[0][field] += p
                        * signed(UNDER_PRESSURE[field])
                        * self.normal.field(field)[at[0] * self.offsets + at[1]];
                    let Some(tangential) = &self.tangential else {
                        continue;
                    };
                    let values = tangential.field(field);
                    let [x, y] = under_traction(field);
                    sums[1][field] += p * signed([x, y]) * values[at[0] * self.offsets + at[1]];
                    // Seen in axes that have changed places.
                    sums[2][field] += p * signed([y, x]) * values[at[1] * self.offsets + at[0]];
                }
            }
        }
        let [normal, along_x, along_y] = sums.map(SubsurfaceState::from_fields);
        let mut state = normal;
        if self.tangential.is_some() {
            state += along_x * self.friction[0] + along_y.transposed() * self.friction[1];
            if !self.is_held {
                state.displacement[..2].fill(f64::NAN);
            }
        }
        state
    }
}
