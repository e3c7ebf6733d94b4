//! Direct solution of the system of a small set.

use faer::{
    Mat, Side,
    linalg::solvers::{Llt, Solve as _},
};

use crate::problem::support::Support;

/// The Cholesky factor of `(K + η)_II`.
pub struct DirectFactor {
    members: Vec<usize>,
    factor: Llt<f64>,
    values: Mat<f64>,
}

impl DirectFactor {
    /// Factorises the system of the elements of `mask`; none if rounding makes it indefinite.
    pub fn new(support: &dyn Support, relief_compliance: &[f64], mask: &[bool]) -> Option<Self> {
        let members: Vec<usize> = (0..mask.len()).filter(|element| mask[*element]).collect();
        let matrix = Mat::from_fn(members.len(), members.len(), |a, b| {
            if a < b {
                // The factorisation uses only the lower triangle.
                return 0.0;
            }
            let elastic = support.coefficient([members[a], members[b]]);
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
