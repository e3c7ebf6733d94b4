//! Whether the model holds where a fit used it: the warnings of the contact at the best fit, under the largest load.

use pellicle_contact::{Domain, Load, Model, SolverOptions, Warning, solve_path};
use pellicle_identify::{Fit, Observable};

use super::Identification;
use super::result::WarningResult;
use crate::failure::Failure;

/// Elements per side of the solution that is looked at.
const ELEMENTS: usize = 64;

/// The warnings about the model, a film squeezed by more than its thickness or a steep indenter, for each table.
///
/// # Errors
///
/// [`Failure`] if the contact cannot be solved at the best fit.
pub fn warnings(of: &Identification, fit: &Fit) -> Result<Vec<WarningResult>, Failure> {
    let values: Vec<f64> = fit
        .estimates
        .iter()
        .map(|estimate| estimate.value)
        .collect();
    let mut found = Vec::new();
    for (table, curve) in of.model.curves().iter().enumerate() {
        let model = of.model.model(table, &values)?;
        let largest = curve.abscissae.iter().copied().fold(0.0, f64::max);
        let load = match curve.observable {
            Observable::DepthAtForce => Load::Force(largest),
            Observable::ForceAtDepth => Load::Penetration(largest),
            // Radii do not tell how far the indenter went.
            Observable::StiffnessAtContactRadius => continue,
        };
        found.extend(at_load(&model, load)?.iter().map(|warning| WarningResult {
            code: warning.code().into(),
            message: format!("data[{table}], at its largest load: {}", words(warning)),
        }));
    }
    Ok(found)
}

/// The warnings about a model under a load.
///
/// # Errors
///
/// [`Failure`] if the contact cannot be solved.
pub fn at_load(model: &Model, load: Load) -> Result<Vec<Warning>, Failure> {
    let options = SolverOptions {
        contact_stiffness: false,
        ..SolverOptions::default()
    };
    let domain = Domain::Automatic;
    let path = solve_path(model, domain, ELEMENTS, &[load], &options, &mut ())?;
    let is_of_model = |warning: &Warning| {
        matches!(
            warning,
            Warning::FilmShortening { .. } | Warning::SteepIndenter { .. }
        )
    };
    Ok(path.warnings.into_iter().filter(is_of_model).collect())
}

/// The warning without the number of its step: there is one.
#[must_use]
pub fn words(warning: &Warning) -> String {
    let words = warning.to_string();
    words.trim_start_matches("step 0: ").to_owned()
}
