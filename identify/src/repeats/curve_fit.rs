//! One of several repeats, linearised about its own point: its own estimates, and its contribution to the common
//! ones.

use faer::Mat;

use super::{common_departure::DepartureShare, mixed_model::CurveEquations};
use crate::{
    NoiseLevels, Problem,
    departure::{HIGHEST_COMMON_DEGREE, smooth_columns},
    goodness::lower_half_score,
    metric::Metric,
    orthonormal_basis::{OrthonormalBasis, dot},
    predictor::Evaluation,
};

/// One curve's share of a problem: its points, its own nuisances, and the columns it shares with the others.
pub(super) struct Share {
    pub index: usize,
    pub problem: Problem,
    /// The columns of the common linear nuisances: the contribution of one unit to each point.
    pub common: Vec<Vec<f64>>,
    /// The smallest and largest abscissa of all curves.
    pub range: [f64; 2],
}

/// A curve fitted alone.
#[derive(Debug, Clone)]
pub(super) struct CurveFit {
    pub index: usize,
    /// Its normal equations for the common columns: determined unknowns, then common nuisances.
    pub equations: CurveEquations,
    /// Its own values of the determined unknowns less the common ones, in their coordinates.
    pub own: Vec<f64>,
    /// Their variances; infinite where this curve alone does not determine the unknown.
    pub own_variance: Vec<f64>,
    /// Values and standard errors of its own nuisances.
    pub nuisances: Vec<[f64; 2]>,
    /// Observable of its own fit.
    pub model: Vec<f64>,
    /// Whitened residuals of its own fit, priors after the points.
    pub whitened: Vec<f64>,
    pub degrees: f64,
    /// Score of the lower half of its abscissae against the whole, and its degrees of freedom.
    pub lower_half: [f64; 2],
    /// Its smooth departures from its own fit.
    pub departure: DepartureShare,
}

impl Share {
    /// Fits the curve alone from its own parameters, which lie beside the common ones by this offset, with the common
    /// nuisances at the given values.
    pub fn fit(
        &self,
        (at, offset): (&Evaluation, &[f64]),
        determined: &[usize],
        nuisances: &[f64],
        levels: &NoiseLevels,
    ) -> CurveFit {
        let mut at = at.clone();
        for (column, c) in self.common.iter().zip(nuisances) {
            add(&mut at.value, *c, column);
        }
        let metric = Metric::at(&self.problem, levels, &at);
        let system = metric.system(&at);
        let mut columns: Vec<Vec<f64>> = determined
            .iter()
            .map(|&j| system.jacobian[j].clone())
            .collect();
        columns.extend(
            self.common
                .iter()
                .map(|column| metric.reduce(column.clone())),
        );
        // What the common parameters leave: r + J u.
        let mut residual = system.residual;
        for (column, u) in columns.iter().zip(offset) {
            add(&mut residual, *u, column);
        }
        let size = columns.len();
        let equations = CurveEquations {
            gram: Mat::from_fn(size, size, |i, k| dot(&columns[i], &columns[k])),
            pull: Mat::from_fn(size, 1, |i, _| dot(&columns[i], &residual)),
        };

        // All of its own columns together, for its own corrections, nuisances and residuals.
        let (mut whitened, jacobian) = metric.rows(&at);
        let mut own_columns = metric.nuisance_columns();
        let first = own_columns.len();
        own_columns.extend(determined.iter().map(|&j| jacobian[j].clone()));
        let whole = OrthonormalBasis::of(own_columns);
        let components = whole.remove_from(&mut whitened);
        let values = whole.coefficients(&components);
        let covariance = whole.inverse_gram();
        let steps = &values[first..];
        let mut model = at.value.clone();
        for (column, c) in self.problem.columns().iter().zip(&values) {
            add(&mut model, *c, &column.with_slopes(&at.slope));
        }
        for (&j, step) in determined.iter().zip(steps) {
            add(&mut model, *step, &at.jacobian[j]);
        }
        CurveFit {
            index: self.index,
            equations,
            own_variance: (first..values.len()).map(|k| covariance[k][k]).collect(),
            nuisances: (self.problem.columns().iter().zip(&values).enumerate())
                .map(|(k, (column, value))| {
                    let value = value + column.origin(&at.origins);
                    [value, covariance[k][k].sqrt()]
                })
                .collect(),
            own: steps.iter().zip(offset).map(|(s, u)| s + u).collect(),
            model,
            degrees: whitened.len().saturating_sub(whole.rank()).max(1) as f64,
            lower_half: lower_half_score(&self.problem, &metric, &at, determined),
            departure: self.departure(&metric, &at, &whole, &whitened),
            whitened,
        }
    }

    /// The smooth departures beside the columns of its own fit and those it shares with others, and the residual's part
    /// along them.
    fn departure(
        &self,
        metric: &Metric,
        at: &Evaluation,
        own: &OrthonormalBasis,
        residual: &[f64],
    ) -> DepartureShare {
        let mut fitted = own.clone();
        for column in &self.common {
            fitted.push(metric.reduce(column.clone()));
        }
        let mut residual = residual.to_vec();
        fitted.remove_from(&mut residual);
        let abscissa = self.problem.abscissa();
        let columns = smooth_columns(&abscissa, &at.value, self.range, HIGHEST_COMMON_DEGREE);
        let (squares, columns): (Vec<f64>, Vec<Vec<f64>>) = columns
            .into_iter()
            .map(|column| {
                let mut column = metric.reduce(column);
                let square = dot(&column, &column);
                fitted.remove_from(&mut column);
                (square, column)
            })
            .unzip();
        let size = columns.len();
        DepartureShare {
            equations: CurveEquations {
                gram: Mat::from_fn(size, size, |i, k| dot(&columns[i], &columns[k])),
                pull: Mat::from_fn(size, 1, |i, _| dot(&columns[i], &residual)),
            },
            squares,
        }
    }
}

impl CurveFit {
    /// The root mean square of its whitened residuals.
    pub fn roughness(&self) -> f64 {
        (dot(&self.whitened, &self.whitened) / self.degrees).sqrt()
    }

    /// The root mean square of its observable.
    pub fn size(&self) -> f64 {
        (dot(&self.model, &self.model) / self.model.len() as f64).sqrt()
    }
}

fn add(sum: &mut [f64], factor: f64, column: &[f64]) {
    for (s, c) in sum.iter_mut().zip(column) {
        *s += factor * c;
    }
}
