//! How much of a misfit one more linear nuisance would explain: a hint at its cause.

use super::Fitting;
use crate::{
    Fit, FitOptions, IdentifyError, Prediction, Problem,
    curve::check_length,
    metric::Metric,
    orthonormal_basis::{OrthonormalBasis, dot},
    predictor::Evaluation,
};

/// For each column, the fraction of a fit's χ² that a nuisance proportional to it would remove, with the unknowns and
/// the other nuisances adjusted to it, in the linearised problem.
///
/// `at_fit` is the prediction at the fit's values and zeros; each column has one value for each point.
///
/// # Errors
///
/// [`IdentifyError::Length`] where a list does not have one number for each point; [`IdentifyError::Decomposition`] as
/// for [`identify`](super::identify).
pub fn explained(
    problem: &Problem,
    fit: &Fit,
    at_fit: Prediction,
    columns: &[Vec<f64>],
) -> Result<Vec<f64>, IdentifyError> {
    check_length("prediction", &at_fit.value, problem.points())?;
    for column in columns {
        check_length("column of a possible cause", column, problem.points())?;
    }
    let parameters: Vec<f64> = fit.estimates.iter().map(|of| of.value).collect();
    let at = Evaluation::of(problem.unknowns(), &parameters, at_fit);
    let metric = Metric::at(problem, &fit.noise, &at);
    let options = FitOptions::default();
    let determined = Fitting::new(problem, &options, Vec::new())?.determined;
    let system = metric.system(&at);
    let unknowns = OrthonormalBasis::of(determined.iter().map(|&j| system.jacobian[j].clone()));
    let mut residual = system.residual;
    unknowns.remove_from(&mut residual);
    let whole = dot(&residual, &residual);
    let fraction = |column: &Vec<f64>| {
        let mut column = metric.reduce(column.clone());
        unknowns.remove_from(&mut column);
        let along = dot(&column, &residual);
        let fraction = along * along / (dot(&column, &column) * whole);
        if fraction.is_finite() { fraction } else { 0.0 }
    };
    Ok(columns.iter().map(fraction).collect())
}
