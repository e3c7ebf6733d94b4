//! The misfit under one covariance of the noise, with the linear nuisances eliminated.
//!
//! For residuals `r = W (y − f(θ))` and whitened columns `B` of the nuisances, the smallest misfit over their
//! coefficients is that of `P r`, `P = I − B (BᵀB)⁻¹ Bᵀ`. Since `B` does not depend on θ, the Jacobian of `P r` is
//! exactly `P` times that of `r`: G. H. Golub and V. Pereyra, SIAM J. Numer. Anal. 10, 413 (1973). One of their two
//! terms is zero here, which makes the simplification of L. Kaufman, BIT 15, 49 (1975), exact. A prior is one more row.
//!
//! The column of a zero of the abscissa is minus the model's slope, which depends on θ. As each evaluation is made from
//! an origin near that zero (predictor.rs), its coefficient is small, and with it the term that Kaufman leaves out.

use crate::{
    NoiseLevels, Problem, noise::whitener::Whitener, orthonormal_basis::OrthonormalBasis,
    orthonormal_basis::dot, predictor::Evaluation,
};

/// A covariance of the noise, and the nuisances whitened by it.
#[derive(Debug, Clone)]
pub(crate) struct Metric<'a> {
    problem: &'a Problem,
    whitener: Whitener,
    nuisances: OrthonormalBasis,
    /// The slopes of the model in the columns of `nuisances`.
    slope: Vec<f64>,
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
        let whitener = Whitener::new(levels, [value, slope], problem.errors(), problem.spans());
        let nuisances = OrthonormalBasis::of(nuisance_columns(problem, &whitener, slope));
        Self {
            problem,
            whitener,
            nuisances,
            slope: slope.to_vec(),
        }
    }

    /// White noise of guessed or given size, at the observed values, so that all searches use the same measure.
    pub fn provisional(problem: &'a Problem, first: &Evaluation) -> Self {
        let levels = problem.first_levels();
        Self::new(problem, &levels, problem.observed(), &first.slope)
    }

    /// The covariance at an evaluation. Relative noise scales with the reading measured from its zero: the model's
    /// value plus what the frame compliance and a drift add, but not a shift. These nuisances are found first,
    /// under the noise at the model's values alone.
    pub fn at(problem: &'a Problem, levels: &NoiseLevels, at: &Evaluation) -> Self {
        let of_model = Self::new(problem, levels, &at.value, &at.slope);
        if levels.relative == 0.0 || problem.columns().iter().all(|column| column.is_zero) {
            return of_model;
        }
        let mut value = at.value.clone();
        let coefficients = of_model.system(at).coefficients;
        let columns = problem.columns().iter().zip(coefficients);
        for (column, c) in columns.filter(|(column, _)| !column.is_zero) {
            for (value, shape) in value.iter_mut().zip(&column.values) {
                *value += c * shape;
            }
        }
        Self::new(problem, levels, &value, &at.slope)
    }

    /// The problem linearised at a point.
    pub fn system(&self, at: &Evaluation) -> System {
        let (mut residual, mut jacobian) = self.rows(at);
        let of_slopes;
        let nuisances = if self.problem.has_abscissa_zeros() {
            let columns = nuisance_columns(self.problem, &self.whitener, &at.slope);
            of_slopes = OrthonormalBasis::of(columns);
            &of_slopes
        } else {
            &self.nuisances
        };
        let components = nuisances.remove_from(&mut residual);
        for column in &mut jacobian {
            nuisances.remove_from(column);
        }
        System {
            chi_squared: dot(&residual, &residual),
            coefficients: nuisances.coefficients(&components),
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
        residual.extend(problem.columns().iter().filter_map(|column| {
            let [mean, sd] = column.prior?;
            Some((mean - column.origin(&at.origins)) / sd)
        }));
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

    /// Reduces a column over the points to the part that no nuisance explains.
    pub fn reduce(&self, mut column: Vec<f64>) -> Vec<f64> {
        self.whitener.whiten(&mut column);
        column.resize(rows(self.problem), 0.0);
        self.nuisances.remove_from(&mut column);
        column
    }

    /// The whitened columns of the nuisances.
    pub fn nuisance_columns(&self) -> Vec<Vec<f64>> {
        nuisance_columns(self.problem, &self.whitener, &self.slope)
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

/// Number of points plus priors of nuisances.
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

fn nuisance_columns(problem: &Problem, whitener: &Whitener, slope: &[f64]) -> Vec<Vec<f64>> {
    let mut row = problem.points();
    problem
        .columns()
        .iter()
        .map(|nuisance| {
            let mut column = nuisance.with_slopes(slope);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Curve, LinearNuisance, Noise, Prior, Unknown};

    /// `y = a q^b` on two curves with shifts, a frame compliance of known size, and a prior on `b`.
    fn problem() -> Problem {
        let curve = |from: f64| {
            let q: Vec<f64> = (1..=12).map(|i| from * f64::from(i)).collect();
            let y = q
                .iter()
                .map(|q| 1.9 * q.powf(0.7) + 0.1 * q.sin())
                .collect();
            Curve::new(q, y).unwrap()
        };
        let prior = Prior::Lognormal {
            median: 0.6,
            factor: 1.2,
        };
        let unknowns = vec![
            Unknown::positive("a", [0.1, 10.0]).unwrap(),
            Unknown::signed("b", [0.1, 2.0])
                .unwrap()
                .with_prior(prior)
                .unwrap(),
        ];
        let frame = LinearNuisance::frame_compliance()
            .with_normal_prior(0.02, 0.01)
            .unwrap();
        let nuisances = [LinearNuisance::shift(), frame];
        Problem::new(
            vec![curve(0.2), curve(1.0)],
            unknowns,
            &nuisances,
            Noise::white(0.1),
        )
        .unwrap()
    }

    fn evaluation(problem: &Problem, position: [f64; 2]) -> Evaluation {
        let parameters: Vec<f64> = problem
            .unknowns()
            .iter()
            .zip(position)
            .map(|(u, x)| u.value(x))
            .collect();
        let (a, b) = (parameters[0], parameters[1]);
        let scale = [0, 1].map(|j| problem.unknowns()[j].value_slope(parameters[j]));
        let q = problem.abscissa();
        let column = |f: &dyn Fn(f64) -> f64| q.iter().map(|q| f(*q)).collect::<Vec<f64>>();
        Evaluation {
            position: position.to_vec(),
            value: column(&|q| a * q.powf(b)),
            slope: column(&|q| a * b * q.powf(b - 1.0)),
            jacobian: vec![
                column(&|q| scale[0] * q.powf(b)),
                column(&|q| scale[1] * a * q.powf(b) * q.ln()),
            ],
            parameters,
            origins: Vec::new(),
        }
    }

    #[test]
    fn the_jacobian_is_the_derivative_of_the_residual_with_the_nuisances_eliminated() {
        let problem = problem();
        let levels = problem.noise().first_guess(1.0, 1.0);
        let levels = NoiseLevels {
            persistence: 0.6,
            white_fraction: 0.3,
            ..levels
        };
        let centre = [0.5, 1.5];
        let at = evaluation(&problem, centre);
        let metric = Metric::at(&problem, &levels, &at);
        let system = metric.system(&at);
        let step = 1e-5;
        for j in 0..2 {
            let shifted = |sign: f64| {
                let mut position = centre;
                position[j] += sign * step;
                metric.system(&evaluation(&problem, position)).residual
            };
            let (up, down) = (shifted(1.0), shifted(-1.0));
            for (i, derivative) in system.jacobian[j].iter().enumerate() {
                let quotient = -(up[i] - down[i]) / (2.0 * step);
                // A central difference has an error of step² times numbers up to 10³, and of rounding over step.
                assert!(
                    (derivative - quotient).abs() < 1e-6,
                    "{j} {i}: {derivative} {quotient}"
                );
            }
        }
    }

    #[test]
    fn no_nuisance_coefficients_fit_better_than_the_eliminated_ones() {
        let problem = problem();
        let at = evaluation(&problem, [0.5, 1.5]);
        let metric = Metric::at(&problem, &problem.noise().first_guess(1.0, 1.0), &at);
        let system = metric.system(&at);
        let (rows, _) = metric.rows(&at);
        let columns = metric.nuisance_columns();
        let misfit = |coefficients: &[f64]| {
            let mut rest = rows.clone();
            for (column, c) in columns.iter().zip(coefficients) {
                rest.iter_mut().zip(column).for_each(|(r, b)| *r -= c * b);
            }
            dot(&rest, &rest)
        };
        let least = misfit(&system.coefficients);
        // Rounding of a sum of some thirty squares.
        assert!((least / system.chi_squared - 1.0).abs() < 1e-12);
        for k in 0..columns.len() {
            for change in [-1e-3, 1e-3] {
                let mut other = system.coefficients.clone();
                other[k] += change;
                assert!(misfit(&other) > least);
            }
        }
    }
}
