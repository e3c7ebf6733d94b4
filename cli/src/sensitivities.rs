//! The derivatives of a solved path with respect to the parameters of its case, as a summary gives them.

use pellicle_contact::{ForceCurve, Load, LoadingPath, Model};

use crate::case::Case;
use crate::case::parameter::CaseParameter;
use crate::failure::Failure;
use crate::output::summary::SensitivitySummary;

/// Returns the derivatives of every step; none if the case does not request them.
///
/// # Errors
///
/// [`Failure`] if the coefficients of a derivative cannot be computed.
pub fn find(
    case: &Case,
    model: &Model,
    path: &LoadingPath,
) -> Result<Option<Vec<Vec<SensitivitySummary>>>, Failure> {
    if !case.load.sensitivities {
        return Ok(None);
    }
    let parameters = case.parameters(model)?;
    let wanted: Vec<_> = parameters.iter().map(|of| of.parameter).collect();
    let locate = |error| case.blame(error);
    let derivatives = model.derivatives(&wanted).map_err(locate)?;
    let sensitivities = derivatives.of_path(path).map_err(locate)?;
    let steps = (0..path.steps.len()).map(|step| {
        let found = sensitivities.at(step).into_iter();
        let named = found.zip(&parameters);
        named
            .map(|(found, CaseParameter { key, .. })| SensitivitySummary {
                parameter: key.clone(),
                value: found.value,
                penetration: found.penetration,
                smooth_penetration: None,
                force: found.force,
                energy: found.energy,
            })
            .collect()
    });
    let mut steps: Vec<Vec<SensitivitySummary>> = steps.collect();
    smooth(case, &mut steps);
    Ok(Some(steps))
}

/// Fills in the derivatives along the curve, where there are enough forces.
fn smooth(case: &Case, steps: &mut [Vec<SensitivitySummary>]) {
    let loads = case.load.loads();
    let force = |step: usize| match loads[step] {
        Load::Force(force) => Some(force),
        Load::Penetration(_) => None,
    };
    let forces: Option<Vec<f64>> = (0..steps.len()).map(force).collect();
    let Some(forces) = forces else {
        return;
    };
    let mut order: Vec<usize> = (0..forces.len()).collect();
    order.sort_by(|a, b| forces[*a].total_cmp(&forces[*b]));
    let ascending: Vec<f64> = order.iter().map(|step| forces[*step]).collect();
    let count = steps.first().map_or(0, Vec::len);
    for index in 0..count {
        let energies: Vec<f64> = order
            .iter()
            .map(|step| steps[*step][index].energy)
            .collect();
        let Some(curve) = ForceCurve::through(&ascending, &energies) else {
            return;
        };
        for (step, force) in steps.iter_mut().zip(&forces) {
            step[index].smooth_penetration = Some(curve.derivative(*force));
        }
    }
}
