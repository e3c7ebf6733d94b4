//! Fields inside the body: tables of one depth, the fields of an element, and planes of fields against a product.

use std::hint::black_box;
use std::sync::Arc;

use criterion::{Criterion, criterion_group, criterion_main};
use pellicle_influence::{
    CoefficientTable, Depth, ElasticOperator, ElementFields, PlaneFields, RadialTables, Squares,
    SurfaceElasticity,
};
use pellicle_kernel::{Foundation, Material, Side};

const SIZE: usize = 512;

fn bench(criterion: &mut Criterion) {
    let material = |modulus| Material::new(modulus, 0.3).expect("valid input");
    let foundation = Foundation::coated(0.1, material(10.0), material(1.0)).expect("valid input");
    let side = 1.0 / SIZE as f64;
    let plane = Depth {
        z: 0.03,
        side: Side::Above,
    };
    criterion.bench_function("tables of one depth", |bencher| {
        bencher.iter(|| ElementFields::new(&foundation, side, plane, 1.5));
    });
    let element = ElementFields::new(&foundation, side, plane, 1.5).expect("valid input");
    criterion.bench_function("an element seen from 20 elements away", |bencher| {
        bencher.iter(|| element.at(black_box([20.0 * side, 3.0 * side])));
    });
    let pressure = vec![1.0; SIZE * SIZE];
    let tables = RadialTables::build(&foundation).expect("valid input");
    let table = CoefficientTable::assemble(&tables, side, SIZE).expect("valid input");
    let mut operator = SurfaceElasticity::new(Arc::new(table), foundation.clone()).operator(SIZE);
    let mut displacement = vec![0.0; SIZE * SIZE];
    criterion.bench_function("product K p", |bencher| {
        bencher.iter(|| operator.apply_into(&pressure, &mut displacement));
    });
    let squares = Squares {
        loaded: SIZE,
        shown: SIZE,
        before: [0; 2],
    };
    let mut grid = PlaneFields::new(&foundation, side, squares, &pressure, [0.0; 2]);
    criterion
        .benchmark_group("plane")
        .sample_size(10)
        .bench_function("nine fields", |bencher| {
            bencher.iter(|| {
                grid.fields_on(plane, |_, field| {
                    black_box(field);
                })
            });
        });
}

criterion_group!(benches, bench);
criterion_main!(benches);
