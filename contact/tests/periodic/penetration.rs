//! A prescribed penetration in a cell over a rigid base: the inverse of a prescribed force.

use std::f64::consts::TAU;

use approx::assert_relative_eq;
use pellicle_contact::{
    ContactError, Domain, Indenter, Load, Method, Model, Profile, SolverOptions, Step, solve_path,
};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use pellicle_texture::{Film, Relief};

use super::{model, with_elastic_indenter};

/// A layer as thick as the cell is wide, with this Poisson's ratio.
fn layer(ratio: f64, interface: Interface) -> Layer {
    Layer::new(1.0, Material::new(1.0, ratio).unwrap(), interface).unwrap()
}

fn on(base: Base, layers: Vec<Layer>, indenter: Indenter) -> Model {
    model(&Foundation::new(layers, base).unwrap(), indenter)
}

/// Summits of different heights: `Δ (1 − cos 2πx cos 4πy + ½ sin 2π(x + y))`.
#[derive(Debug)]
struct Summits;

const AMPLITUDE: f64 = 0.01;

impl Profile for Summits {
    fn height(&self, x: f64, y: f64) -> f64 {
        let diagonal = 0.5 * (TAU * (x + y)).sin();
        AMPLITUDE * (1.0 - (TAU * x).cos() * (2.0 * TAU * y).cos() + diagonal)
    }
}

fn summits() -> Indenter {
    Indenter::custom(Summits)
}

fn solve(model: &Model, load: Load, options: &SolverOptions) -> Step {
    let path = solve_path(model, Domain::Periodic(1.0), 32, &[load], options, &mut ());
    let step = path.unwrap().steps.remove(0);
    assert!(step.solution.certificate.is_satisfied(), "{load:?}");
    step
}

/// Forces that press a few elements, about half of them and all of them.
const FORCES: [f64; 3] = [3e-4, 0.01, 0.2];

/// Holds the solution under the penetration that a force gives to that under the force, which it returns.
fn assert_inverse(model: &Model, force: f64, options: &SolverOptions) -> Step {
    let wanted = solve(model, Load::Force(force), options);
    let depth = wanted.solution.penetration;
    let found = solve(model, Load::Penetration(depth), options);
    // The tolerance of the gaps, which are relative to the deformation; 1.0e-8 at most was found.
    assert_relative_eq!(found.solution.force, force, max_relative = 3e-8);
    let largest = wanted.summary.max_pressure;
    let pressures = wanted.solution.pressure.iter();
    for (wanted, found) in pressures.zip(&found.solution.pressure) {
        // Pressures of single elements follow gaps by the stiffness of the shortest waves.
        assert!((wanted - found).abs() < 1e-6 * largest, "{wanted} {found}");
    }
    wanted
}

#[test]
fn the_penetration_of_a_force_takes_that_force() {
    let spring = Interface::spring(0.4, 0.1).unwrap();
    for layers in [
        vec![layer(0.3, Interface::Bonded)],
        vec![layer(0.3, Interface::Frictionless)],
        vec![layer(0.2, spring), layer(0.45, Interface::Bonded)],
        // The mean is a thousand times as stiff as the longest wave.
        vec![layer(0.4999, Interface::Bonded)],
    ] {
        let cell = on(Base::Rigid, layers, summits());
        for force in FORCES {
            assert_inverse(&cell, force, &SolverOptions::default());
        }
    }
    // Incompressible layers have this penetration only while gaps are left.
    let cell = on(Base::Rigid, vec![layer(0.5, Interface::Bonded)], summits());
    for force in [3e-4, 0.01] {
        assert_inverse(&cell, force, &SolverOptions::default());
    }
}

#[test]
fn so_it_does_on_springs_at_a_hardness_and_by_the_active_set() {
    let usual = SolverOptions::default();
    let cell = on(Base::Rigid, vec![layer(0.3, Interface::Bonded)], summits());
    let film = Film::new(0.1, 0.5).unwrap();
    for relief in [film, film.stiffening()] {
        let model = Model {
            relief: Relief::Film(relief),
            ..cell.clone()
        };
        for force in FORCES {
            assert_inverse(&model, force, &usual);
        }
    }
    let hard = SolverOptions {
        hardness: 0.03,
        ..usual
    };
    let step = assert_inverse(&cell, 0.01, &hard);
    assert!(step.summary.area_at_limit.unwrap() > 0.0);
    let dense = SolverOptions {
        method: Method::ActiveSet,
        ..usual
    };
    assert_inverse(&cell, 0.01, &dense);
}

#[test]
fn a_penetration_without_contact_needs_no_force() {
    let cell = on(Base::Rigid, vec![layer(0.3, Interface::Bonded)], summits());
    // The lowest summit is at -Δ/2.
    for depth in [-0.1, -0.0051] {
        let options = SolverOptions::default();
        let step = solve(&cell, Load::Penetration(depth), &options);
        assert!(step.solution.force <= 0.0, "{depth}");
    }
}

#[test]
fn a_penetration_of_bodies_with_an_infinite_mean_is_refused() {
    let layers = || vec![layer(0.3, Interface::Bonded)];
    let steel = Material::new(1.0, 0.3).unwrap();
    let on_half_space = on(Base::HalfSpace(steel), layers(), summits());
    let under_elastic = with_elastic_indenter(&on(Base::Rigid, layers(), summits()), steel);
    for model in [on_half_space, under_elastic] {
        let (loads, options) = ([Load::Penetration(0.01)], SolverOptions::default());
        let refused = solve_path(&model, Domain::Periodic(1.0), 32, &loads, &options, &mut ());
        assert!(matches!(refused, Err(ContactError::InfiniteMean)));
    }
}

/// The mean of the initial gap is `Δ`: incompressible layers fill it, and nothing more.
#[test]
fn incompressible_layers_can_be_pressed_until_all_gaps_are_closed() {
    let cell = on(Base::Rigid, vec![layer(0.5, Interface::Bonded)], summits());
    let at = |depth: f64| {
        let (loads, options) = ([Load::Penetration(depth)], SolverOptions::default());
        solve_path(&cell, Domain::Periodic(1.0), 32, &loads, &options, &mut ())
    };
    let path = at(0.9 * AMPLITUDE).unwrap();
    assert!(path.steps[0].solution.certificate.is_satisfied());
    let Err(ContactError::BeyondGaps { mean_gap, .. }) = at(1.01 * AMPLITUDE) else {
        panic!("a penetration that nothing reaches");
    };
    // The mean of whole waves, with roundings.
    assert_relative_eq!(mean_gap, AMPLITUDE, max_relative = 1e-13);
    let springy = Model {
        relief: Relief::Film(Film::new(0.1, 0.5).unwrap()),
        ..cell.clone()
    };
    solve(
        &springy,
        Load::Penetration(1.01 * AMPLITUDE),
        &SolverOptions::default(),
    );
}
