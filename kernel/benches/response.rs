//! Cost of one evaluation of `Φ` by each path, of the interior, and of splitting a graded layer.

#![expect(
    clippy::unwrap_used,
    reason = "a foundation that cannot be built stops the measurement"
)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use pellicle_kernel::{
    Base, Foundation, GradedLayer, GradingOptions, Interface, Layer, Material, Side,
    TransformedSystem,
};
use std::hint::black_box;

fn coating() -> Material {
    Material::new(10.0, 0.3).unwrap()
}

fn substrate() -> Material {
    Material::new(1.0, 0.4).unwrap()
}

fn stack(count: usize) -> Foundation {
    let layer = |i: usize| {
        let material = Material::new(1.0 + i as f64, 0.3).unwrap();
        Layer::new(1.0 / count as f64, material, Interface::Bonded).unwrap()
    };
    Foundation::new(
        (0..count).map(layer).collect(),
        Base::HalfSpace(substrate()),
    )
    .unwrap()
}

/// A thin layer takes the series, a thick one the exponentials.
const WAVENUMBERS: [(&str, f64); 2] = [("thin", 0.3), ("thick", 3.0)];

fn closed_form(criterion: &mut Criterion) {
    let foundation = Foundation::coated(1.0, coating(), substrate()).unwrap();
    let mut group = criterion.benchmark_group("one layer");
    for (name, k) in WAVENUMBERS {
        group.bench_function(BenchmarkId::new("closed form", name), |b| {
            b.iter(|| foundation.response(black_box(k)));
        });
        group.bench_function(BenchmarkId::new("minus one", name), |b| {
            b.iter(|| foundation.response_minus_one(black_box(k)));
        });
        group.bench_function(BenchmarkId::new("4x4 system", name), |b| {
            b.iter(|| TransformedSystem::new(black_box(k), coating(), substrate()).response());
        });
    }
}

fn recursion(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("stack");
    for count in [2, 10, 200] {
        let foundation = stack(count);
        group.throughput(Throughput::Elements(count as u64));
        group.bench_function(BenchmarkId::new("recursion", count), |b| {
            b.iter(|| foundation.response(black_box(1.0)));
        });
        group.bench_function(BenchmarkId::new("minus one", count), |b| {
            b.iter(|| foundation.response_minus_one(black_box(1.0)));
        });
    }
}

fn interior(criterion: &mut Criterion) {
    let foundation = stack(10);
    criterion.bench_function("interior/10 layers", |b| {
        b.iter(|| foundation.interior(black_box(1.0)));
    });
    let interior = foundation.interior(1.0).unwrap();
    criterion.bench_function("interior/one depth", |b| {
        b.iter(|| interior.at(black_box(0.37), Side::Above));
    });
}

fn graded(criterion: &mut Criterion) {
    let profile = |z: f64| Material::new(4.0 * (-1.5 * z).exp(), 0.25);
    let layer = GradedLayer::new(1.0, Interface::Bonded, profile).unwrap();
    let mut group = criterion.benchmark_group("graded");
    group.sample_size(10);
    group.bench_function("split to 1e-4", |b| {
        b.iter(|| {
            layer.split(
                &[],
                Base::HalfSpace(substrate()),
                &GradingOptions::default(),
            )
        });
    });
}

criterion_group!(benches, closed_form, recursion, interior, graded);
criterion_main!(benches);
