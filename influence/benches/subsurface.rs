//! Fields inside the body: tables of one depth, the fields of an element, and planes of fields in products `K p`.

use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use criterion::{Criterion, criterion_group, criterion_main};
use pellicle_influence::{
    CoefficientTable, ConvolutionOperator, Depth, ElasticOperator, ElementFields, PlaneFields,
    RadialTables, Squares, SurfaceElasticity,
};
use pellicle_kernel::{Foundation, Material, Side};
use rayon::ThreadPoolBuilder;

/// Side of the domain of Fig. 2(c), in radii of the indenter.
const DOMAIN: f64 = 0.12;

/// The foundation of Fig. 2(c), and a plane inside its base.
fn foundation() -> (Foundation, Depth) {
    let material = |modulus, ratio| Material::new(modulus, ratio).expect("valid input");
    let foundation = Foundation::coated(1e-4, material(1.0, 0.4), material(10.0, 0.3));
    let plane = Depth {
        z: 1e-3,
        side: Side::Above,
    };
    (foundation.expect("valid input"), plane)
}

fn operator(size: usize) -> ConvolutionOperator {
    let (foundation, _) = foundation();
    let tables = RadialTables::build(&foundation).expect("valid input");
    let table = CoefficientTable::assemble(&tables, DOMAIN / size as f64, size);
    let table = Arc::new(table.expect("valid input"));
    SurfaceElasticity::new(table, foundation).operator(size)
}

fn element(criterion: &mut Criterion) {
    let (foundation, plane) = foundation();
    let side = DOMAIN / 512.0;
    criterion.bench_function("tables of one depth", |bencher| {
        bencher.iter(|| ElementFields::new(&foundation, side, plane, 0.17));
    });
    let element = ElementFields::new(&foundation, side, plane, 0.17).expect("valid input");
    for distance in [3.0, 60.0, 400.0] {
        let point = [distance * side, 3.0 * side];
        let name = format!("an element seen from {distance} elements away");
        criterion.bench_function(&name, |bencher| {
            bencher.iter(|| element.at(black_box(point)));
        });
    }
    let loaded: Vec<([f64; 2], f64)> = (0..224 * 224)
        .map(|e| [e / 224, e % 224].map(|i| f64::from(i - 112) * side))
        .map(|centre| (centre, 1.0))
        .collect();
    criterion.bench_function("50,176 elements at one point", |bencher| {
        bencher.iter(|| element.sum_over(&loaded, [0.0; 2], black_box([0.3 * side; 2])));
    });
}

/// Prints the cost of a plane in units of products on a grid of the same size, on one thread.
#[expect(clippy::print_stdout, reason = "criterion has no ratios")]
fn ratios(_: &mut Criterion) {
    let pool = ThreadPoolBuilder::new().num_threads(1).build();
    pool.expect("a pool").install(|| {
        for size in [512, 1024] {
            let mut product = operator(size);
            let uneven: Vec<f64> = (0..size * size).map(|e| (e % 7) as f64).collect();
            let even = vec![1.0; size * size];
            for (name, pressure, friction) in [
                ("any pressure", &uneven, 0.0),
                ("a mirrored pressure", &even, 0.0),
                ("any pressure, with friction", &uneven, 0.2),
                ("a mirrored pressure, with friction", &even, 0.2),
            ] {
                let [tables, fields] = in_products(size, pressure, friction, &mut product);
                println!("N = {size}, {name}: tables {tables:.2}, nine fields {fields:.2}");
            }
        }
    });
}

/// The times of the tables of a plane, and of its nine fields with the spectra of the tables, in products: means of ten
/// alternating rounds, so that other load on the machine slows all of them.
fn in_products(
    size: usize,
    pressure: &[f64],
    friction: f64,
    product: &mut ConvolutionOperator,
) -> [f64; 2] {
    let (foundation, plane) = foundation();
    let squares = Squares {
        loaded: size,
        shown: size,
        before: [0; 2],
    };
    let side = DOMAIN / size as f64;
    let mut planes = PlaneFields::new(&foundation, side, squares, pressure, [friction, 0.0]);
    let mut displacement = pressure.to_vec();
    let mut take = |chosen: &[usize]| {
        let outcome = planes.chosen_fields_on(plane, chosen, |_, field| {
            black_box(field);
        });
        outcome.expect("a depth in the body");
    };
    // The waves are solved for once.
    take(&[]);
    let mut times = [0.0; 3];
    let timed = |time: &mut f64, work: &mut dyn FnMut()| {
        let start = Instant::now();
        work();
        *time += start.elapsed().as_secs_f64();
    };
    for _ in 0..10 {
        timed(&mut times[0], &mut || {
            product.apply_into(pressure, &mut displacement);
        });
        timed(&mut times[1], &mut || take(&[]));
        timed(&mut times[2], &mut || take(&[0, 1, 2, 3, 4, 5, 6, 7, 8]));
    }
    [times[1] / times[0], (times[2] - times[1]) / times[0]]
}

criterion_group!(benches, element, ratios);
criterion_main!(benches);
