//! The system of a small set, solved directly.

use faer::{
    Mat, Side,
    linalg::solvers::{Llt, Solve as _},
};
use pellicle_influence::{Sector, SurfaceElasticity};

/// The Cholesky factor of `(K + η)_II`.
pub struct DirectFactor {
    members: Vec<usize>,
    factor: Llt<f64>,
    values: Mat<f64>,
}

impl DirectFactor {
    /// Of the elements of `mask` on a sector of `size` elements a row; none if rounding leaves the system indefinite.
    pub fn new(
        elasticity: &SurfaceElasticity,
        (size, sector): (usize, Sector),
        relief_compliance: &[f64],
        mask: &[bool],
    ) -> Option<Self> {
        let members: Vec<usize> = (0..mask.len()).filter(|element| mask[*element]).collect();
        let place = |member: usize| [members[member] / size, members[member] % size];
        let matrix = Mat::from_fn(members.len(), members.len(), |a, b| {
            if a < b {
                // The factor takes the lower triangle alone.
                return 0.0;
            }
            let (p, q) = (place(a), place(b));
            let along = |axis: usize| {
                let mirrored = sector.mirrored()[axis].then_some(p[axis] + q[axis] + 1);
                std::iter::once(p[axis].abs_diff(q[axis])).chain(mirrored)
            };
            let offsets = along(0).flat_map(|x| along(1).map(move |y| [x, y]));
            let elastic: f64 = offsets.map(|offset| elasticity.coefficient(offset)).sum();
            let spring = if a == b {
                relief_compliance[members[a]]
            } else {
                0.0
            };
            elastic + spring
        });
        let factor = Llt::new(matrix.as_ref(), Side::Lower).ok()?;
        let values = Mat::zeros(members.len(), 1);
        Some(Self {
            members,
            factor,
            values,
        })
    }

    /// `r ← (K + η)_II⁻¹ r`; values outside the set become 0.
    pub fn apply(&mut self, field: &mut [f64]) {
        for (a, member) in self.members.iter().enumerate() {
            self.values[(a, 0)] = field[*member];
        }
        self.factor.solve_in_place(&mut self.values);
        field.fill(0.0);
        for (a, member) in self.members.iter().enumerate() {
            field[*member] = self.values[(a, 0)];
        }
    }
}
