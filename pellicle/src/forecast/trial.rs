//! A trial of a case: its smallest and its largest load on a coarse grid.

use pellicle_contact::{
    ContactError, Domain, Load, LoadingPath, Method, Model, SolverOptions, solve_path,
};

use crate::case::Case;

/// Elements per side of the trial.
pub const TRIAL: usize = 64;

/// Number of products after which the trial gives up, to stay quick.
const MAX_PRODUCTS: usize = 150;

/// Solves the smallest and the largest load on a domain.
///
/// # Errors
///
/// As [`solve_path`].
pub fn solve(
    case: &Case,
    model: &Model,
    domain: Domain,
    elements: usize,
) -> Result<LoadingPath, ContactError> {
    let options = SolverOptions {
        method: Method::Gradient,
        max_applications: MAX_PRODUCTS,
        coarse_pressures: false,
        ..case.solver_options()
    };
    let loads = extremes(&case.loads());
    solve_path(model, domain, elements, &loads, &options, &mut ())
}

/// Share of the domain that the square around the largest contact takes.
pub fn contact_share(path: &LoadingPath) -> f64 {
    let radii = path.steps.iter().map(|step| step.summary.contact_radius);
    let share = 2.0 * radii.fold(0.0, f64::max) / path.grid.side();
    share.powi(2).min(1.0)
}

/// The smallest and the largest load; one load if there is only one.
fn extremes(loads: &[Load]) -> Vec<Load> {
    let size = |load: &Load| match load {
        Load::Force(value) | Load::Penetration(value) => *value,
    };
    let smallest = loads.iter().min_by(|a, b| size(a).total_cmp(&size(b)));
    let largest = loads.iter().max_by(|a, b| size(a).total_cmp(&size(b)));
    let mut extremes: Vec<_> = smallest.into_iter().chain(largest).copied().collect();
    extremes.dedup();
    extremes
}
