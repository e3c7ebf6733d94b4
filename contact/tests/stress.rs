//! Stresses under solved pressures: extremes compared with closed forms and sampling, critical loads with closed forms
//! and new solutions.

#![expect(clippy::unwrap_used, reason = "a test fails by its panic")]

mod critical_loads;
mod extremes;
mod residual;
mod sliding_edge;

use std::sync::Arc;

use approx::assert_relative_eq;
use pellicle_contact::{
    BodyPart, BodyStrengths, Criterion, CriticalLoad, Domain, FlatPunch, Indenter, InterfacePart,
    InterfaceStrengths, Load, LoadingPath, Model, Paraboloid, Profile, Sliding, SolverOptions,
    StressExtremes, StressField, StressModel, critical_loads, reference::hertz, solve_path,
    stress_extremes,
};
use pellicle_influence::{Cache, Depth, RadialTables, SubsurfaceState};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::Relief;

const STEEL: (f64, f64) = (1.0, 0.3);

fn half_space() -> Foundation {
    Foundation::half_space(Material::new(STEEL.0, STEEL.1).unwrap())
}

/// A coating of this thickness, five times as stiff as its support.
fn coated(thickness: f64) -> Foundation {
    let (coating, base) = (Material::new(5.0, 0.25), Material::new(STEEL.0, STEEL.1));
    Foundation::coated(thickness, coating.unwrap(), base.unwrap()).unwrap()
}

/// An indenter on a bare body.
fn model(foundation: &Foundation, indenter: impl Into<Indenter>) -> Model {
    Model {
        tables: Arc::new(RadialTables::build(foundation).unwrap()),
        relief: Relief::Bare,
        indenter: indenter.into(),
        cache: Cache::none(),
    }
}

fn solved(model: &Model, elements: usize, force: f64) -> LoadingPath {
    let options = SolverOptions {
        coarse_pressures: true,
        ..SolverOptions::default()
    };
    let loads = [Load::Force(force)];
    solve_path(
        model,
        Domain::Automatic,
        elements,
        &loads,
        &options,
        &mut (),
    )
    .unwrap()
}

fn body(name: &str, top: f64, bottom: f64, strengths: BodyStrengths) -> BodyPart {
    BodyPart {
        name: name.to_owned(),
        top,
        bottom,
        strengths,
    }
}

/// Stresses of a body of one material.
fn whole(strengths: BodyStrengths) -> StressModel {
    StressModel {
        bodies: vec![body("substrate", 0.0, f64::INFINITY, strengths)],
        ..StressModel::default()
    }
}

/// Stresses of a coating, its support and the interface, under sliding.
fn sliding_coating(thickness: f64) -> StressModel {
    let none = BodyStrengths::default();
    StressModel {
        sliding: Sliding {
            friction: 0.3,
            direction: 0.4,
        },
        bodies: vec![
            body("layer[0]", 0.0, thickness, none),
            body("substrate", thickness, f64::INFINITY, none),
        ],
        interfaces: vec![InterfacePart {
            index: 0,
            depth: thickness,
            strengths: InterfaceStrengths::default(),
        }],
        ..StressModel::default()
    }
}

/// The largest von Mises stress under Hertz's pressure and its depth, over the largest pressure and the radius: from
/// Huber's stresses on the axis, `σ_z = −1/(1 + ζ²)` and `σ_r = −(1 + ν)(1 − ζ arctan 1/ζ) + ½/(1 + ζ²)`.
fn on_the_axis() -> [f64; 2] {
    let difference = |zeta: f64| {
        let inside = 1.0 / (1.0 + zeta * zeta);
        1.5 * inside - (1.0 + STEEL.1) * (1.0 - zeta * (1.0 / zeta).atan())
    };
    let depths = (1..20_000).map(|i| f64::from(i) * 1e-4);
    let largest = depths.map(|zeta| [difference(zeta), zeta]);
    largest.fold(
        [0.0; 2],
        |best, next| if next[0] > best[0] { next } else { best },
    )
}
