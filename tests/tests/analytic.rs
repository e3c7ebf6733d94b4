//! Against closed forms: Hertz, cone, flat punch, Winkler, and the limits in which a coating is not felt.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::sync::Arc;

use pellicle_contact::{
    Cone, Domain, FlatPunch, Indenter, Load, LoadingPath, Model, Paraboloid, SolverOptions,
    reference, solve_path,
};
use pellicle_influence::RadialTables;
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{Film, Relief};

/// Plane-strain modulus 1 with Poisson's ratio 0.3.
fn body() -> Material {
    Material::new(0.91, 0.3).unwrap()
}

fn model(foundation: &Foundation, relief: Relief, indenter: Indenter) -> Model {
    Model {
        tables: Arc::new(RadialTables::build(foundation).unwrap()),
        relief,
        indenter,
    }
}

fn solve(model: &Model, side: f64, elements: usize, load: Load) -> LoadingPath {
    let path = solve_path(
        model,
        Domain::Side(side),
        elements,
        &[load],
        &SolverOptions::default(),
        &mut (),
    )
    .unwrap();
    assert!(
        path.steps[0].solution.certificate.is_satisfied(),
        "{:?}",
        path.steps[0].solution.certificate
    );
    path
}

fn paraboloid(radius: f64) -> Indenter {
    Indenter::Paraboloid(Paraboloid::new(radius).unwrap())
}

/// Observed order over grids that double from one error to the next, by least squares of log₂ error.
fn order(errors: [f64; 4]) -> f64 {
    (3.0 * (errors[0] / errors[3]).log2() + (errors[1] / errors[2]).log2()) / 10.0
}

const GRIDS: [usize; 4] = [32, 64, 128, 256];
