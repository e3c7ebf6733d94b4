//! The effect on the estimates of a number that is taken as exact.
//!
//! Intervals account for the noise alone. If a number `f` of the model is really `f (1 + ε)`, the best fit moves too.
//! With the whitened derivatives `J = ∂y/∂x` with respect to the unknowns' coordinates and `F = ∂y/∂ln f`, nuisances
//! eliminated and priors among the rows, the minimum of the linearised problem moves by
//!
//! ```text
//! dx/d ln f = −(JᵀJ)⁻¹ Jᵀ F
//! ```
//!
//! which in logarithms of the unknowns is an exponent: `θ ∝ f^a` near the fit.

use super::Fitting;
use crate::{
    Fit, FitOptions, FitWarning, IdentifyError, Prediction, Problem, curve::check_length,
    metric::Metric, orthonormal_basis::OrthonormalBasis, predictor::Evaluation,
};

/// Computes the exponents `a_j = d ln θ_j/d ln f` of each unknown of a fit for each number `f` that its model takes as
/// exact.
///
/// Returns one list per number, in their order, with `None` for an unknown that is not identifiable, lies at a bound of
/// its range, or is zero. `at_fit` is the prediction at the fit's values, and `changes` are the derivatives `∂y/∂ln f`
/// at all points. Repeats are pooled, as if they did not scatter.
///
/// # Errors
///
/// [`IdentifyError::Length`] where a list does not have one number for each point; [`IdentifyError::Decomposition`] as
/// for [`identify`](super::identify).
pub fn exponents(
    problem: &Problem,
    fit: &Fit,
    at_fit: Prediction,
    changes: &[Vec<f64>],
) -> Result<Vec<Vec<Option<f64>>>, IdentifyError> {
    for change in changes {
        check_length("derivative by a fixed number", change, problem.points())?;
    }
    check_length("prediction", &at_fit.value, problem.points())?;
    let unknowns = problem.unknowns();
    let parameters: Vec<f64> = fit.estimates.iter().map(|of| of.value).collect();
    let at = Evaluation::of(unknowns, &parameters, at_fit);
    let metric = Metric::at(problem, &fit.noise, &at);
    let options = FitOptions::default();
    let Fitting {
        mut determined,
        null_space,
        ..
    } = Fitting::new(problem, &options, Vec::new())?;
    determined.retain(|&j| !fit.warnings.contains(&FitWarning::AtBound(j)));
    let jacobian = metric.system(&at).jacobian;
    let basis = OrthonormalBasis::of(determined.iter().map(|&j| jacobian[j].clone()));
    let of_change = |change: &Vec<f64>| {
        let mut rows = metric.reduce(change.clone());
        let components = basis.remove_from(&mut rows);
        let mut exponents = vec![None; unknowns.len()];
        for (&j, moved) in determined.iter().zip(basis.coefficients(&components)) {
            // d ln θ = (dθ/dx) dx/θ
            let exponent = -moved * unknowns[j].value_slope(parameters[j]) / parameters[j];
            let is_determined = exponent.is_finite() && !null_space.moves(j);
            exponents[j] = is_determined.then_some(exponent);
        }
        exponents
    };
    Ok(changes.iter().map(of_change).collect())
}
