//! The directions in parameter space along which no predicted curve changes, by the keys of the case.

use pellicle::case::parameter::CaseParameter;
use pellicle_contact::{ModelDirection, ModelParameter};
use pellicle_identify::fit_file::model::ModelParameters;
use pellicle_identify::{IdentifyError, NullDirections};

/// Returns the null directions of the model of one table, in logarithms of its parameters; parameters specific to the
/// table have their own names.
///
/// # Errors
///
/// None: every direction has a number for each parameter.
pub fn of(
    parameters: &ModelParameters,
    own: &[ModelParameter],
    table: usize,
) -> Result<NullDirections, IdentifyError> {
    named(parameters, |of| {
        let is_own = own.contains(&of.parameter);
        is_own.then(|| format!("data[{table}] {}", of.key))
    })
}

/// Returns the null directions, with the names of some parameters in place of their keys.
///
/// # Errors
///
/// None: every direction has a number for each parameter.
pub fn named(
    parameters: &ModelParameters,
    name: impl Fn(&CaseParameter) -> Option<String>,
) -> Result<NullDirections, IdentifyError> {
    let all = &parameters.parameters;
    let names = all
        .iter()
        .map(|of| name(of).unwrap_or_else(|| of.key.clone()));
    let of_bodies = |direction: &ModelDirection| {
        direction
            .iter()
            .all(|(of, _)| !matches!(of, ModelParameter::Indenter(_)))
    };
    // Lengths and forces that scale together change what adhesion adds.
    let vectors = parameters.model.null_directions().into_iter();
    let vectors = vectors.filter(|direction| parameters.adhesion.is_none() || of_bodies(direction));
    let vectors = vectors.map(|direction| {
        let entry = |parameter: ModelParameter| {
            let found = direction.iter().find(|(of, _)| *of == parameter);
            let value = parameters.model.parameter(parameter).unwrap_or(1.0);
            // d ln θ; a parameter that is zero is not fitted by its logarithm.
            found.map_or(0.0, |(_, change)| {
                if value == 0.0 {
                    *change
                } else {
                    change / value
                }
            })
        };
        let raw: Vec<f64> = all.iter().map(|of| entry(of.parameter)).collect();
        let length = raw.iter().map(|x| x * x).sum::<f64>().sqrt();
        raw.iter().map(|x| x / length).collect()
    });
    NullDirections::new(names.collect(), vectors.collect())
}

/// Returns the null directions common to all tables.
///
/// # Errors
///
/// [`IdentifyError::Decomposition`] if a number is not finite.
pub fn common(
    tables: Vec<Result<NullDirections, IdentifyError>>,
) -> Result<NullDirections, IdentifyError> {
    let tables = tables.into_iter().collect::<Result<Vec<_>, _>>()?;
    NullDirections::common(&tables)
}
