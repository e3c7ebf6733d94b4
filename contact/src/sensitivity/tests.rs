//! Derivatives compared with scaling: a problem's response when all its moduli, or all its heights, are multiplied.
//!
//! On one grid with one set of elements in contact these hold to the tolerance of the solution, whatever the grid.

use std::sync::Arc;

use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{Film, Relief, ReliefParameter};

use super::*;
use crate::{
    Domain, IndenterQuantity, Load, LoadingPath, Model, ModelParameter, Paraboloid, SolverOptions,
    solve_path,
};

const FORCE: f64 = 1e-3;

fn model(relief: Relief) -> Model {
    let body = Foundation::half_space(Material::new(2.0, 0.3).unwrap());
    Model {
        tables: Arc::new(RadialTables::build(&body).unwrap()),
        relief,
        indenter: Paraboloid::new(0.5).unwrap().into(),
        cache: Cache::in_memory(),
    }
}

fn solved(model: &Model) -> LoadingPath {
    let options = SolverOptions {
        tolerance: 1e-12,
        ..SolverOptions::default()
    };
    let domain = Domain::Side(0.4);
    solve_path(model, domain, 24, &[Load::Force(FORCE)], &options, &mut ()).unwrap()
}

/// The energy and the derivatives by some parameters, with a path of one step.
fn derivatives(
    model: &Model,
    path: &LoadingPath,
    parameters: &[ModelParameter],
) -> (f64, Vec<Sensitivity>) {
    let derivatives = model.derivatives(parameters).unwrap();
    let of_path = derivatives.of_path(path).unwrap();
    let found = of_path.at(0);
    // The energies computed alone are the same numbers.
    let energies = of_path.energies(0);
    assert!(found.iter().map(|of| of.energy).eq(energies));
    (of_path.energy(0), found)
}

const RADIUS: ModelParameter = ModelParameter::Indenter(IndenterQuantity::Radius);
const FILM: ModelParameter = ModelParameter::Relief(ReliefParameter::YoungModulus);
const HEIGHT: ModelParameter = ModelParameter::Relief(ReliefParameter::Height);

fn reliefs() -> [Relief; 3] {
    let film = Film::new(4e-3, 0.05).unwrap();
    [
        Relief::Bare,
        Relief::Film(film),
        Relief::Film(film.stiffening()),
    ]
}

#[test]
fn scaling_all_moduli_scales_the_force() {
    for relief in reliefs() {
        let model = model(relief.clone());
        let path = solved(&model);
        // The body's modulus is the first of all numbers.
        let modulus = model.parameters()[0];
        let parameters = match relief {
            Relief::Bare => vec![modulus],
            _ => vec![modulus, FILM],
        };
        let (energy, found) = derivatives(&model, &path, &parameters);
        let step = &path.steps[0];
        let (depth, stiffness) = (step.solution.penetration, step.contact_stiffness.unwrap());
        // Q(λE, D) = λ Q(E, D); E(λQ, λE) = λ E(Q, E), where ∂E/∂Q = D
        let total =
            |of: fn(&Sensitivity) -> f64| found.iter().map(|s| s.value * of(s)).sum::<f64>();
        let force = total(|of| of.force.unwrap());
        // Derivatives by a number are differences over a small step of it.
        assert!((force / FORCE - 1.0).abs() < 1e-5, "{relief:?} {force}");
        let penetration = total(|of| of.penetration.unwrap());
        assert!(
            (-penetration * stiffness / FORCE - 1.0).abs() < 1e-5,
            "{relief:?}"
        );
        let change = total(|of| of.energy);
        let wanted = energy - depth * FORCE;
        assert!(
            (change / wanted - 1.0).abs() < 1e-5,
            "{relief:?} {change} {wanted}"
        );
    }
}

#[test]
fn scaling_all_heights_scales_force_and_penetration() {
    for relief in reliefs() {
        let model = model(relief.clone());
        let path = solved(&model);
        // The law of a stiffening film depends on p/E, so its modulus and its height are multiplied as well, which
        // leaves a linear film unchanged.
        let parameters = match relief {
            Relief::Bare => vec![RADIUS],
            Relief::Film(film) if film.spring_law().is_linear() => vec![RADIUS],
            _ => vec![RADIUS, HEIGHT, FILM],
        };
        let (energy, found) = derivatives(&model, &path, &parameters);
        let step = &path.steps[0];
        let (depth, stiffness) = (step.solution.penetration, step.contact_stiffness.unwrap());
        // Q(λD, R/λ) = λ Q(D, R), with h and E of a law also scaled by λ
        let sign = |index: usize| if index == 0 { -1.0 } else { 1.0 };
        let total = |of: fn(&Sensitivity) -> f64| -> f64 {
            let terms = found.iter().enumerate();
            terms.map(|(index, s)| sign(index) * s.value * of(s)).sum()
        };
        let force = total(|of| of.force.unwrap());
        let wanted = FORCE - depth * stiffness;
        assert!(
            (force / wanted - 1.0).abs() < 1e-5,
            "{relief:?} {force} {wanted}"
        );
        let penetration = total(|of| of.penetration.unwrap());
        assert!(
            (penetration * stiffness / -wanted - 1.0).abs() < 1e-5,
            "{relief:?}"
        );
        // E(λQ, λh, R/λ) = λ² E
        let change = total(|of| of.energy);
        let wanted = 2.0 * energy - depth * FORCE;
        assert!(
            (change / wanted - 1.0).abs() < 1e-5,
            "{relief:?} {change} {wanted}"
        );
    }
}
