//! The derivatives of a solved path with respect to the parameters of its case, as a summary gives them.

use pellicle_contact::{LoadingPath, Model, Sensitivity};

use crate::case::Case;
use crate::case::parameter::CaseParameter;
use crate::error::Error;
use crate::summary::SensitivitySummary;

/// Returns the derivatives of every step; none if the case does not request them.
///
/// # Errors
///
/// [`Error`] if the coefficients of a derivative cannot be computed.
pub fn find(
    case: &Case,
    model: &Model,
    path: &LoadingPath,
) -> Result<Option<Vec<Vec<SensitivitySummary>>>, Error> {
    if !case.load.sensitivities {
        return Ok(None);
    }
    let parameters = case.parameters(model)?;
    let wanted: Vec<_> = parameters.iter().map(|of| of.parameter).collect();
    let locate = |error| case.blame(error);
    let derivatives = model.derivatives(&wanted).map_err(locate)?;
    let sensitivities = derivatives.of_path(path).map_err(locate)?;
    let named = |(derivatives, CaseParameter { key, .. }): (Sensitivity, &CaseParameter)| {
        let parameter = key.clone();
        SensitivitySummary {
            parameter,
            derivatives,
        }
    };
    let of_step = |step: Vec<_>| step.into_iter().zip(&parameters).map(named).collect();
    let steps = sensitivities.of_steps(&case.loads());
    Ok(Some(steps.into_iter().map(of_step).collect()))
}
