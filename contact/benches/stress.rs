//! Extremes of the stresses under one load, compared with the solution of the contact itself: a ball on a homogeneous
//! body and on a coating, at rest and sliding.

use std::sync::Arc;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use pellicle_contact::{
    BodyPart, BodyStrengths, Domain, Indenter, InterfacePart, InterfaceStrengths, Load,
    LoadingPath, Model, Paraboloid, Sliding, SolverOptions, StressModel, solve_path,
    stress_extremes,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::Relief;

/// A fifth of the contact radius.
const THICKNESS: f64 = 0.02;

fn solved(model: &Model, elements: usize) -> LoadingPath {
    let options = SolverOptions {
        coarse_pressures: true,
        ..SolverOptions::default()
    };
    let load = [Load::Force(1e-3)];
    solve_path(
        model,
        Domain::Side(0.26),
        elements,
        &load,
        &options,
        &mut (),
    )
    .expect("a solution")
}

fn material(young_modulus: f64, poisson_ratio: f64) -> Material {
    Material::new(young_modulus, poisson_ratio).expect("a material")
}

/// The bodies of a foundation, with a coating of this thickness, if any.
fn stresses(coating: Option<f64>, friction: f64) -> StressModel {
    let ends = [Some(0.0), coating, Some(f64::INFINITY)];
    let ends: Vec<f64> = ends.into_iter().flatten().collect();
    let bodies = ends.windows(2).map(|pair| BodyPart {
        name: format!("{pair:?}"),
        top: pair[0],
        bottom: pair[1],
        strengths: BodyStrengths::default(),
    });
    let interfaces = coating.map(|depth| InterfacePart {
        index: 0,
        depth,
        strengths: InterfaceStrengths::default(),
    });
    StressModel {
        sliding: Sliding {
            friction,
            direction: 0.0,
        },
        bodies: bodies.collect(),
        interfaces: interfaces.into_iter().collect(),
        ..StressModel::default()
    }
}

fn extremes(criterion: &mut Criterion) {
    let base = material(1.0, 0.3);
    let coated = Foundation::coated(THICKNESS, material(5.0, 0.25), base).expect("a foundation");
    let scenes = [
        ("one body", Foundation::half_space(base), None, 0.0),
        ("coated", coated.clone(), Some(THICKNESS), 0.0),
        ("coated, sliding", coated, Some(THICKNESS), 0.2),
    ];
    let mut group = criterion.benchmark_group("stress");
    group.sample_size(10);
    for (name, foundation, coating, friction) in scenes {
        let model = Model {
            tables: Arc::new(RadialTables::build(&foundation).expect("tables")),
            relief: Relief::Bare,
            indenter: Indenter::Paraboloid(Paraboloid::new(1.0).expect("an indenter")),
            cache: Cache::none(),
        };
        for elements in [256, 512] {
            let (path, stress) = (solved(&model, elements), stresses(coating, friction));
            group.bench_function(
                BenchmarkId::new(format!("{name}, solution"), elements),
                |b| {
                    b.iter(|| solved(&model, elements));
                },
            );
            group.bench_function(
                BenchmarkId::new(format!("{name}, extremes"), elements),
                |b| {
                    b.iter(|| stress_extremes(&path, 0, &stress).expect("extremes"));
                },
            );
        }
    }
    group.finish();
}

criterion_group!(benches, extremes);
criterion_main!(benches);
