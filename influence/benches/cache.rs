//! Coefficients read from disk, compared with computing them: the threshold below which reading does not pay.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use pellicle_influence::{Cache, Origin, RadialTables};
use pellicle_kernel::{Foundation, Material};
use rayon::ThreadPoolBuilder;

const SIZES: [usize; 10] = [4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048];

fn foundations() -> [(&'static str, Foundation); 2] {
    let material = |young_modulus, poisson_ratio| {
        Material::new(young_modulus, poisson_ratio).expect("a material")
    };
    let (coating, substrate) = (material(10.0, 0.3), material(1.0, 0.4));
    let coated = Foundation::coated(1.0, coating, substrate).expect("a foundation");
    [
        ("coated", coated),
        ("homogeneous", Foundation::half_space(substrate)),
    ]
}

fn tables(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("cache, radial tables");
    group.sample_size(20);
    let [(_, foundation), _] = foundations();
    let folder = tempfile::tempdir().expect("a folder");
    Cache::at(folder.path())
        .radial_tables(&foundation)
        .expect("tables");
    group.bench_function("computed", |bencher| {
        bencher.iter(|| RadialTables::build(black_box(&foundation)));
    });
    group.bench_function("read", |bencher| {
        bencher.iter(|| {
            let read = Cache::at(folder.path())
                .radial_tables(&foundation)
                .expect("tables");
            assert_eq!(read.origin, Origin::Disk);
        });
    });
    group.finish();
}

fn coefficients(criterion: &mut Criterion) {
    for (name, foundation) in foundations() {
        let mut group = criterion.benchmark_group(format!("cache, coefficients, {name}"));
        group.sample_size(20);
        let tables = RadialTables::build(&foundation).expect("tables");
        let folder = tempfile::tempdir().expect("a folder");
        for size in SIZES {
            let side = 20.0 / size as f64;
            for threads in [1, 2] {
                let pool = ThreadPoolBuilder::new().num_threads(threads).build();
                let pool = pool.expect("a pool");
                let name = BenchmarkId::new(format!("computed, {threads} threads"), size);
                group.bench_function(name, |bencher| {
                    pool.install(|| {
                        bencher.iter(|| Cache::none().coefficients(black_box(&tables), side, size));
                    });
                });
            }
            let from_disk =
                || Cache::storing_from(1, folder.path()).coefficients(&tables, side, size);
            from_disk().expect("coefficients");
            group.bench_function(BenchmarkId::new("read", size), |bencher| {
                bencher
                    .iter(|| assert_eq!(from_disk().expect("coefficients").origin, Origin::Disk));
            });
        }
        group.finish();
    }
}

criterion_group!(benches, tables, coefficients);
criterion_main!(benches);
