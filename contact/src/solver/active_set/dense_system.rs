//! The linear system of the elements in contact, as a dense matrix.
//!
//! On the working set `I`: `(K + η)_II p = D 1 − g0`, and `Σ p = Q/(4a²)` where the force is prescribed. Two solves
//! with one Cholesky factor, `a = A⁻¹ 1` and `b = A⁻¹ g0`, give `p = D a − b` with `D = (Σ p + Σ b)/Σ a`.

use faer::{
    Mat, Side,
    linalg::solvers::{Llt, Solve as _},
};

use crate::{ContactError, DiscreteProblem, Iterate, Load};

/// A pressure or gap counts as infeasible beyond this fraction of its scale: the rounding of a dense solve with a
/// condition number of at most about 10⁴.
const ROUNDING: f64 = 1e-12;

/// The whole problem with all its coefficients.
pub struct DenseSystem {
    size: usize,
    load: Load,
    loaded_area: f64,
    /// Coefficient by offset, `k(m, n)` at `m N + n`.
    coefficients: Vec<f64>,
    relief_compliance: Vec<f64>,
    initial_gap: Vec<f64>,
}

/// The solution of the linear system on one set, and the elements that violate the inequalities.
pub struct SetSolution {
    /// Pressure; negative on elements that do not belong in the set. N² values.
    pub pressure: Vec<f64>,
    /// Gap; N² values.
    pub gap: Vec<f64>,
    /// Members that pull and other elements that overlap.
    pub infeasible: Vec<usize>,
    /// Contact stiffness `dQ/dD = 4a² Σ a` of the set, in N/m.
    pub stiffness: f64,
    /// Penetration, in m.
    pub penetration: f64,
}

impl DenseSystem {
    /// Obtains all coefficients from one product: `K` is translation invariant, so a unit pressure on the first element
    /// gives the coefficient of every offset.
    pub fn new(problem: &mut DiscreteProblem, load: Load) -> Self {
        let mut unit = vec![0.0; problem.elements()];
        unit[0] = 1.0;
        let mut coefficients = vec![0.0; problem.elements()];
        problem.operator_mut().apply_into(&unit, &mut coefficients);
        Self {
            size: problem.size(),
            load,
            loaded_area: problem.loaded_area(),
            coefficients,
            relief_compliance: problem.springs().at_rest().to_vec(),
            initial_gap: problem.initial_gap().to_vec(),
        }
    }

    /// Elements per side.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Replaces the springs' compliance and the initial gap.
    pub fn take_springs(&mut self, compliance: &[f64], initial_gap: Vec<f64>) {
        self.relief_compliance.copy_from_slice(compliance);
        self.initial_gap = initial_gap;
    }

    pub fn elements(&self) -> usize {
        self.initial_gap.len()
    }

    pub fn load(&self) -> Load {
        self.load
    }

    pub fn initial_gap(&self) -> &[f64] {
        &self.initial_gap
    }

    /// The prescribed `Σ p`, if the load is a force.
    pub fn total(&self) -> Option<f64> {
        match self.load {
            Load::Force(force) => Some(force / self.loaded_area),
            Load::Penetration(_) => None,
        }
    }

    /// Coefficient between two elements.
    fn coefficient(&self, e: usize, f: usize) -> f64 {
        let (m, n) = (
            (e / self.size).abs_diff(f / self.size),
            (e % self.size).abs_diff(f % self.size),
        );
        self.coefficients[m * self.size + n]
    }

    /// Solves on the set of `members`.
    ///
    /// # Errors
    /// [`ContactError::NotPositiveDefinite`].
    pub fn solve_on(&self, members: &[usize]) -> Result<SetSolution, ContactError> {
        let count = members.len();
        let matrix = Mat::from_fn(count, count, |i, j| {
            let spring = if i == j {
                self.relief_compliance[members[i]]
            } else {
                0.0
            };
            self.coefficient(members[i], members[j]) + spring
        });
        let factor = Llt::new(matrix.as_ref(), Side::Lower)
            .map_err(|_| ContactError::NotPositiveDefinite { elements: count })?;
        let sides = Mat::from_fn(count, 2, |i, j| {
            if j == 0 {
                1.0
            } else {
                self.initial_gap[members[i]]
            }
        });
        let solved = factor.solve(&sides);
        let column = |j: usize| (0..count).map(|i| solved[(i, j)]).sum::<f64>();
        let penetration = match self.load {
            Load::Penetration(penetration) => penetration,
            // D = (Σ p + Σ b)/Σ a
            Load::Force(force) => (force / self.loaded_area + column(1)) / column(0),
        };
        let mut pressure = vec![0.0; self.elements()];
        for (i, member) in members.iter().enumerate() {
            pressure[*member] = penetration * solved[(i, 0)] - solved[(i, 1)];
        }
        let mut trial = self.trial(members, pressure, penetration);
        trial.stiffness = self.loaded_area * column(0);
        Ok(trial)
    }

    /// Computes the gap everywhere and the infeasible elements of a solution on `members`.
    fn trial(&self, members: &[usize], pressure: Vec<f64>, penetration: f64) -> SetSolution {
        let displacement = |e: usize| {
            members
                .iter()
                .map(|m| self.coefficient(e, *m) * pressure[*m])
                .sum::<f64>()
        };
        let mut gap: Vec<f64> = (0..self.elements())
            .map(|e| displacement(e) + self.initial_gap[e] - penetration)
            .collect();
        members
            .iter()
            .for_each(|m| gap[*m] += self.relief_compliance[*m] * pressure[*m]);
        let scale = pressure
            .iter()
            .fold(0.0_f64, |largest, p| largest.max(p.abs()));
        let pulls = |e: &usize| pressure[*e] < -ROUNDING * scale;
        let mut infeasible: Vec<usize> = members.iter().copied().filter(pulls).collect();
        let mut outside = vec![true; self.elements()];
        members.iter().for_each(|m| outside[*m] = false);
        infeasible.extend(
            (0..self.elements()).filter(|e| outside[*e] && gap[*e] < -ROUNDING * penetration.abs()),
        );
        SetSolution {
            pressure,
            gap,
            infeasible,
            stiffness: 0.0,
            penetration,
        }
    }
}

impl SetSolution {
    /// Largest overlap relative to the penetration, or largest tension relative to the largest pressure if that is
    /// greater.
    pub fn residual(&self) -> f64 {
        let overlap = self.gap.iter().fold(0.0_f64, |o, g| o.max(-g)) / self.penetration.abs();
        let largest = self.pressure.iter().fold(0.0_f64, |l, p| l.max(p.abs()));
        let pull = self.pressure.iter().fold(0.0_f64, |o, p| o.max(-p)) / largest;
        [overlap, pull]
            .into_iter()
            .filter(|part| part.is_finite())
            .fold(0.0, f64::max)
    }

    /// Converts to an iterate, with negative rounding residues set to 0; the coefficients took one product.
    pub fn into_iterate(self, residuals: Vec<f64>) -> Iterate {
        Iterate {
            iterations: residuals.len(),
            operator_applications: 1,
            residuals,
            contact_stiffness: (self.stiffness > 0.0).then_some(self.stiffness),
            stiffness_applications: 0,
            penetration: f64::INFINITY,
            reached_border: false,
            pressure: self.pressure.into_iter().map(|p| p.max(0.0)).collect(),
        }
    }
}
