//! `K p` compared with its lower bound: the bare zero-padded pair of transforms, 2N × 2N real to complex and back,
//! with the same library.

use std::hint::black_box;
use std::sync::Arc;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use pellicle_fourier::{Complex64, ComplexToReal, Fft, RealToComplex, Transformed};
use pellicle_influence::{
    CoefficientTable, ConvolutionOperator, ElasticOperator, Sector, SectorGrid, love,
};
use pellicle_kernel::Material;
use rayon::ThreadPoolBuilder;

const SIZES: [usize; 5] = [128, 256, 512, 1024, 2048];

fn table(size: usize) -> CoefficientTable {
    let steel = Material::new(1.0, 0.3).expect("a material");
    CoefficientTable::from_fn(1.0, size, |o| love::coefficient(&steel, 1.0, o)).expect("a table")
}

/// Products on the whole grid.
fn product(criterion: &mut Criterion) {
    let operator = |size| ConvolutionOperator::new(&table(size));
    products(criterion, "product", operator);
}

/// Products on the quadrant that stands for a grid of the same size.
fn product_on_a_quadrant(criterion: &mut Criterion) {
    let operator = |size| {
        let quadrant = SectorGrid::of_square(Sector::Quadrant, size);
        ConvolutionOperator::on(&table(size), quadrant)
    };
    products(criterion, "product on a quadrant", operator);
}

fn products<O: ElasticOperator>(
    criterion: &mut Criterion,
    name: &str,
    operator: impl Fn(usize) -> O + Sync,
) {
    let mut group = criterion.benchmark_group(name);
    group.sample_size(10);
    for threads in [1, 2] {
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("a pool");
        for size in SIZES {
            let mut operator = pool.install(|| operator(size));
            let pressure = vec![1.0; operator.size().pow(2)];
            let mut displacement = pressure.clone();
            let name = BenchmarkId::new(format!("{threads} threads"), size);
            group.bench_function(name, |bencher| {
                pool.install(|| {
                    bencher.iter(|| operator.apply_into(black_box(&pressure), &mut displacement));
                });
            });
        }
    }
    group.finish();
}

/// Rows real to complex, transpose, columns there and back, transpose, rows back: everything at full
/// length, on one thread.
fn bare_pair(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("bare padded pair");
    group.sample_size(10);
    for size in SIZES {
        let mut pair = BarePair::new(2 * size);
        group.bench_function(BenchmarkId::from_parameter(size), |bencher| {
            bencher.iter(|| pair.run());
        });
    }
    group.finish();
}

struct BarePair {
    length: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
    there: Arc<dyn Fft<f64>>,
    back: Arc<dyn Fft<f64>>,
    field: Vec<f64>,
    rows: Vec<Complex64>,
    columns: Vec<Complex64>,
    scratch: Vec<Complex64>,
}

impl BarePair {
    fn new(length: usize) -> Self {
        let half = length / 2 + 1;
        Self {
            length,
            forward: f64::real_forward(length),
            inverse: f64::real_inverse(length),
            there: f64::forward(length),
            back: f64::inverse(length),
            field: vec![1.0; length * length],
            rows: vec![Complex64::default(); length * half],
            columns: vec![Complex64::default(); length * half],
            scratch: vec![Complex64::default(); 4 * length],
        }
    }

    fn run(&mut self) {
        let (length, half) = (self.length, self.length / 2 + 1);
        let rows = self.field.chunks_exact_mut(length);
        for (row, transformed) in rows.zip(self.rows.chunks_exact_mut(half)) {
            self.forward
                .process_with_scratch(row, transformed, &mut self.scratch)
                .expect("lengths");
        }
        transpose(&self.rows, &mut self.columns, half, length);
        self.there
            .process_with_scratch(&mut self.columns, &mut self.scratch);
        self.back
            .process_with_scratch(&mut self.columns, &mut self.scratch);
        transpose(&self.columns, &mut self.rows, length, half);
        let rows = self.field.chunks_exact_mut(length);
        for (row, transformed) in rows.zip(self.rows.chunks_exact_mut(half)) {
            transformed[0].im = 0.0;
            transformed[half - 1].im = 0.0;
            self.inverse
                .process_with_scratch(transformed, row, &mut self.scratch)
                .expect("lengths");
            for value in row {
                *value /= (length * length) as f64;
            }
        }
    }
}

/// Transposes `height` rows of `width` numbers, in tiles.
fn transpose(from: &[Complex64], to: &mut [Complex64], width: usize, height: usize) {
    for top in (0..height).step_by(16) {
        for left in (0..width).step_by(16) {
            for y in top..(top + 16).min(height) {
                for x in left..(left + 16).min(width) {
                    to[x * height + y] = from[y * width + x];
                }
            }
        }
    }
}

criterion_group!(benches, product, product_on_a_quadrant, bare_pair);
criterion_main!(benches);
