//! Steps of a linearised problem in the moving unknowns.

use faer::{Mat, Side, linalg::solvers::Solve as _};

use crate::{
    IdentifyError,
    metric::System,
    orthonormal_basis::{dot, norm},
};

/// A direction with an eigenvalue below this, for columns of unit length, is lost in the rounding of the matrix and
/// counts as undetermined by the data.
const UNDETERMINED: f64 = 1e-12;

/// `JᵀJ` and `Jᵀr` of the moving unknowns, each scaled by the length of its column (D. W. Marquardt, J. Soc. Indust.
/// Appl. Math. 11, 431 (1963)).
pub(crate) struct NormalEquations {
    moving: Vec<usize>,
    unknowns: usize,
    length: Vec<f64>,
    gram: Mat<f64>,
    /// Scaled gradient, the direction in which χ² falls.
    descent: Vec<f64>,
}

impl NormalEquations {
    pub fn new(system: &System, moving: &[usize]) -> Self {
        let column = |k: usize| &system.jacobian[moving[k]];
        // A column of zeros gets length one; its unknown never moves.
        let length: Vec<f64> = (0..moving.len())
            .map(|k| norm(column(k)))
            .map(|length| if length > 0.0 { length } else { 1.0 })
            .collect();
        let gram = Mat::from_fn(moving.len(), moving.len(), |i, k| {
            dot(column(i), column(k)) / (length[i] * length[k])
        });
        let descent = (0..moving.len())
            .map(|k| dot(column(k), &system.residual) / length[k])
            .collect();
        Self {
            moving: moving.to_vec(),
            unknowns: system.jacobian.len(),
            length,
            gram,
            descent,
        }
    }

    /// The step of Levenberg and Marquardt, `(JᵀJ + λ D²) δ = Jᵀr`, over all unknowns.
    pub fn damped_step(&self, damping: f64) -> Result<Vec<f64>, IdentifyError> {
        let size = self.moving.len();
        if size == 0 {
            return Ok(vec![0.0; self.unknowns]);
        }
        let mut matrix = self.gram.clone();
        for k in 0..size {
            matrix[(k, k)] += damping;
        }
        let factor = matrix
            .llt(Side::Lower)
            .map_err(|_| IdentifyError::Decomposition { size })?;
        let solution = factor.solve(Mat::from_fn(size, 1, |k, _| self.descent[k]));
        let mut step = vec![0.0; self.unknowns];
        for (k, &j) in self.moving.iter().enumerate() {
            step[j] = solution[(k, 0)] / self.length[k];
        }
        Ok(step)
    }

    /// The step `(JᵀJ)⁺ Jᵀr` to the minimum of χ² of the linear problem; the shortest one if it is not unique.
    pub fn full_step(&self) -> Result<Vec<f64>, IdentifyError> {
        let mut step = vec![0.0; self.unknowns];
        let size = self.moving.len();
        if size == 0 {
            return Ok(step);
        }
        let eigen = self
            .gram
            .self_adjoint_eigen(Side::Lower)
            .map_err(|_| IdentifyError::Decomposition { size })?;
        for k in (0..size).filter(|&k| eigen.S()[k] > UNDETERMINED) {
            let along: f64 = (0..size).map(|i| eigen.U()[(i, k)] * self.descent[i]).sum();
            for (i, &j) in self.moving.iter().enumerate() {
                step[j] += along / eigen.S()[k] * eigen.U()[(i, k)] / self.length[i];
            }
        }
        Ok(step)
    }

    /// The decrease of χ² to its minimum in the linear problem, `rᵀJ (JᵀJ)⁺ Jᵀr`.
    pub fn possible_decrease(&self) -> Result<f64, IdentifyError> {
        let step = self.full_step()?;
        Ok(self
            .moving
            .iter()
            .enumerate()
            .map(|(k, &j)| step[j] * self.length[k] * self.descent[k])
            .sum())
    }
}

impl System {
    /// The residual of the linear problem after a step.
    pub fn after(&self, step: &[f64]) -> Vec<f64> {
        let mut rest = self.residual.clone();
        for (column, &s) in self.jacobian.iter().zip(step) {
            for (r, g) in rest.iter_mut().zip(column) {
                *r -= s * g;
            }
        }
        rest
    }

    /// The linear problem at the end of a step.
    pub fn shifted(&self, step: &[f64]) -> System {
        let residual = self.after(step);
        System {
            chi_squared: dot(&residual, &residual),
            residual,
            ..self.clone()
        }
    }

    /// The decrease of χ² of the linear problem along a step.
    pub fn decrease(&self, step: &[f64]) -> f64 {
        let rest = self.after(step);
        self.chi_squared - dot(&rest, &rest)
    }
}
