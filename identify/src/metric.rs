//! The misfit under one covariance of the noise, with the linear nuisances eliminated.
//!
//! For residuals `r = W (y − f(θ))` and whitened columns `B` of the nuisances, the least misfit over their coefficients
//! is that of `P r`, `P = I − B (BᵀB)⁻¹ Bᵀ`. As `B` does not depend on θ, the Jacobian of `P r` is exactly `P` times
//! that of `r`: G. H. Golub and V. Pereyra, SIAM J. Numer. Anal. 10, 413 (1973), of whose two terms one is zero here,
//! which makes the simplification of L. Kaufman, BIT 15, 49 (1975), exact. A prior is one more row.

use crate::{
    NoiseLevels, Problem, noise::whitener::Whitener, predictor::Evaluation, projection::Projection,
    projection::dot,
};

/// A covariance of the noise and the nuisances under it.
#[derive(Debug, Clone)]
pub(crate) struct Metric<'a> {
    problem: &'a Problem,
    whitener: Whitener,
    nuisances: Projection,
}

/// The linearised problem at one point: `χ²(x + δ) ≈ ‖residual − jacobian δ‖²`.
#[derive(Debug, Clone)]
pub(crate) struct System {
    /// Rows: points, then priors of nuisances, then priors of unknowns.
    pub residual: Vec<f64>,
    /// One column for each unknown.
    pub jacobian: Vec<Vec<f64>>,
    /// `χ²`, priors included.
    pub chi_squared: f64,
    /// Coefficients of the linear nuisances at the point.
    pub coefficients: Vec<f64>,
}

impl<'a> Metric<'a> {
    /// The covariance at the model's values and slopes.
    pub fn new(problem: &'a Problem, levels: &NoiseLevels, value: &[f64], slope: &[f64]) -> Self {
        let whitener = Whitener::new(levels, value, slope, problem.spans());
        let nuisances = Projection::of(nuisance_columns(problem, &whitener));
        Self {
            problem,
            whitener,
            nuisances,
        }
    }

    /// The covariance at an evaluation.
    pub fn at(problem: &'a Problem, levels: &NoiseLevels, at: &Evaluation) -> Self {
        Self::new(problem, levels, &at.value, &at.slope)
    }

    /// The problem linearised at a point.
    pub fn system(&self, at: &Evaluation) -> System {
        let (mut residual, mut jacobian) = self.rows(at);
        let components = self.nuisances.remove_from(&mut residual);
        for column in &mut jacobian {
            self.nuisances.remove_from(column);
        }
        System {
            chi_squared: dot(&residual, &residual),
            coefficients: self.nuisances.coefficients(&components),
            residual,
            jacobian,
        }
    }

    /// Residual and Jacobian before the nuisances are eliminated.
    pub fn rows(&self, at: &Evaluation) -> (Vec<f64>, Vec<Vec<f64>>) {
        let problem = self.problem;
        let observed = problem.observed();
        let mut residual: Vec<f64> = observed.iter().zip(&at.value).map(|(y, f)| y - f).collect();
        self.whitener.whiten(&mut residual);
        residual.extend(
            problem
                .columns()
                .iter()
                .filter_map(|c| c.prior)
                .map(|[m, sd]| m / sd),
        );
        let mut jacobian = at.jacobian.clone();
        for column in &mut jacobian {
            self.whitener.whiten(column);
            column.resize(residual.len(), 0.0);
        }
        for (j, unknown) in problem.unknowns().iter().enumerate() {
            let Some(prior) = unknown.prior() else {
                continue;
            };
            let value = at.parameters[j];
            residual.push(-prior.deviation(value));
            for (k, column) in jacobian.iter_mut().enumerate() {
                let slope = prior.deviation_slope(value) * unknown.value_slope(value);
                column.push(if k == j { slope } else { 0.0 });
            }
        }
        (residual, jacobian)
    }

    /// Leaves of a column over the points what no nuisance explains.
    pub fn reduce(&self, mut column: Vec<f64>) -> Vec<f64> {
        self.whitener.whiten(&mut column);
        column.resize(rows(self.problem), 0.0);
        self.nuisances.remove_from(&mut column);
        column
    }

    /// The whitened columns of the nuisances.
    pub fn nuisance_columns(&self) -> Vec<Vec<f64>> {
        nuisance_columns(self.problem, &self.whitener)
    }

    /// `ln det V`.
    pub fn log_determinant(&self) -> f64 {
        self.whitener.log_determinant()
    }

    /// Number of independent nuisances.
    pub fn nuisance_rank(&self) -> usize {
        self.nuisances.rank()
    }
}

/// Points and priors.
fn rows(problem: &Problem) -> usize {
    problem.points()
        + problem
            .columns()
            .iter()
            .filter(|c| c.prior.is_some())
            .count()
        + problem
            .unknowns()
            .iter()
            .filter(|u| u.prior().is_some())
            .count()
}

fn nuisance_columns(problem: &Problem, whitener: &Whitener) -> Vec<Vec<f64>> {
    let mut row = problem.points();
    problem
        .columns()
        .iter()
        .map(|nuisance| {
            let mut column = nuisance.values.clone();
            whitener.whiten(&mut column);
            column.resize(rows(problem), 0.0);
            if let Some([_, sd]) = nuisance.prior {
                column[row] = 1.0 / sd;
                row += 1;
            }
            column
        })
        .collect()
}
