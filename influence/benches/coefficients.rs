//! Radial tables, single coefficients, tables of coefficients, and the direct quadrature for comparison.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use pellicle_influence::{CoefficientTable, RadialTables, direct};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use rayon::ThreadPoolBuilder;

fn coated(ratio: f64) -> Foundation {
    let material = |young_modulus, poisson_ratio| {
        Material::new(young_modulus, poisson_ratio).expect("a material")
    };
    Foundation::coated(1.0, material(ratio, 0.3), material(1.0, 0.4)).expect("a foundation")
}

/// A coating graded from 10 to 1 in 200 steps.
fn graded() -> Foundation {
    let layer = |i: u32| {
        let material = Material::new(10.0 - 9.0 * f64::from(i) / 200.0, 0.3).expect("a material");
        Layer::new(0.005, material, Interface::Bonded).expect("a layer")
    };
    let base = Base::HalfSpace(Material::new(1.0, 0.3).expect("a material"));
    Foundation::new((0..200).map(layer).collect(), base).expect("a foundation")
}

fn build(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("radial tables");
    group.sample_size(10);
    let foundations = [
        ("stiff coating, 10", coated(10.0)),
        ("soft coating, 0.1", coated(0.1)),
        ("soft coating, 1e-6", coated(1e-6)),
        ("stiff coating, 1e6", coated(1e6)),
        ("200 layers", graded()),
    ];
    for (name, foundation) in foundations {
        group.bench_function(name, |bencher| {
            bencher.iter(|| RadialTables::build(black_box(&foundation)));
        });
    }
    group.finish();
}

fn coefficient(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("coefficient");
    group.sample_size(20);
    let foundation = coated(10.0);
    let tables = RadialTables::build(&foundation).expect("tables");
    for offset in [[0, 0], [3, 2], [6, 2], [12, 5], [40, 7], [500, 200]] {
        let name = BenchmarkId::new("radial tables", format!("{offset:?}"));
        group.bench_function(name, |bencher| {
            bencher.iter(|| tables.coefficient(black_box(0.2), black_box(offset)));
        });
    }
    for offset in [[0, 0], [3, 2]] {
        let name = BenchmarkId::new("direct quadrature", format!("{offset:?}"));
        group.bench_function(name, |bencher| {
            bencher.iter(|| direct::coefficient(black_box(&foundation), 0.2, offset));
        });
    }
    group.finish();
}

fn assemble(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("table of coefficients");
    group.sample_size(10);
    let tables = RadialTables::build(&coated(10.0)).expect("tables");
    for threads in [1, 2] {
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("a pool");
        for size in [128, 256, 512, 1024, 2048] {
            let name = BenchmarkId::new(format!("{threads} threads"), size);
            group.bench_function(name, |bencher| {
                pool.install(|| {
                    bencher.iter(|| CoefficientTable::assemble(&tables, 20.0 / size as f64, size));
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, build, coefficient, assemble);
criterion_main!(benches);
