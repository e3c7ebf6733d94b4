//! Periodic cells: waves by closed forms, the mean displacement, penetrations, the scale of gaps, and ever larger
//! cells.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

mod mean_displacement;
mod oblong;
mod penetration;
mod scale_of_gaps;
mod waves;

use std::sync::Arc;

use pellicle_contact::{
    Domain, Indenter, Load, LoadingPath, Model, SolverOptions, Warning, solve_path,
};
use pellicle_influence::{Cache, ElasticBodies, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::Relief;

/// A bare body under a rigid indenter.
fn model(foundation: &Foundation, indenter: Indenter) -> Model {
    Model {
        tables: Arc::new(RadialTables::build(foundation).unwrap()),
        relief: Relief::Bare,
        indenter,
        cache: Cache::none(),
    }
}

/// The same under an indenter of this material.
fn with_elastic_indenter(model: &Model, material: Material) -> Model {
    let bodies = ElasticBodies::new(model.tables.foundation().clone(), material);
    Model {
        tables: Arc::new(RadialTables::of_bodies(&bodies).unwrap()),
        ..model.clone()
    }
}

fn solve(model: &Model, domain: Domain, elements: usize, force: f64) -> LoadingPath {
    let options = SolverOptions::default();
    let loads = [Load::Force(force)];
    let path = solve_path(model, domain, elements, &loads, &options, &mut ()).unwrap();
    let certificate = path.steps[0].solution.certificate;
    assert!(certificate.is_satisfied(), "{certificate:?}");
    // The equations are linear and solved as they are, so the limits of model and grid do not matter here.
    let is_expected = |warning: &Warning| {
        matches!(
            warning,
            Warning::PeakNotResolved { .. }
                | Warning::NotResolved { .. }
                | Warning::NoGridError { .. }
                | Warning::DomainMuchLarger { .. }
                | Warning::LayerShortening { .. }
                | Warning::BeyondModel { .. }
        )
    };
    assert!(path.warnings.iter().all(is_expected), "{:?}", path.warnings);
    path
}
