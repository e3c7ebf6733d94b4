//! Warnings about a model under the largest load of a planned curve.

use pellicle_contact::{Domain, Load, Model, SolverOptions, Warning, solve_path};

use crate::failure::Failure;

/// Elements per side of the solution used.
const ELEMENTS: usize = 64;

/// Returns the warnings about a model under a load.
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

/// Returns the warning without its step number; there is only one step.
#[must_use]
pub fn words(warning: &Warning) -> String {
    let words = warning.to_string();
    words.trim_start_matches("step 0: ").to_owned()
}
