//! Complete solutions to a certificate of 1e-8: the four textured cases of the paper, and two problems on a homogeneous
//! body that other programs solve too. The products with K on the finest grid are printed to standard error.
//!
//! Coefficients, operators and transform plans are recomputed on every grid in every run; only the radial tables of the
//! foundation, which do not depend on the grid, are built beforehand.

#![expect(
    clippy::print_stderr,
    reason = "criterion shows times only; the work belongs beside them"
)]

use std::sync::Arc;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use pellicle_contact::{
    Domain, Indenter, Load, LoadingPath, Model, Paraboloid, SolverOptions, solve_path,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{CylinderSpec, Cylinders, Lattice, Relief};
use rayon::{ThreadPool, ThreadPoolBuilder};

/// A model under one load on one square.
struct Scene {
    name: &'static str,
    model: Model,
    side: f64,
    force: f64,
}

impl Scene {
    fn solve(&self, elements: usize) -> LoadingPath {
        let load = [Load::Force(self.force)];
        let options = SolverOptions::default();
        let domain = Domain::Side(self.side);
        solve_path(&self.model, domain, elements, &load, &options, &mut ()).expect("a solution")
    }
}

/// A paraboloid of radius 1 above `relief` on `foundation`, with nothing cached between runs.
fn model(foundation: &Foundation, relief: Relief) -> Model {
    Model {
        tables: Arc::new(RadialTables::build(foundation).expect("tables")),
        relief,
        indenter: Indenter::Paraboloid(Paraboloid::new(1.0).expect("an indenter")),
        cache: Cache::none(),
    }
}

fn material(young_modulus: f64, poisson_ratio: f64) -> Material {
    Material::new(young_modulus, poisson_ratio).expect("a material")
}

fn cylinders(spec: CylinderSpec) -> Relief {
    Relief::Cylinders(Cylinders::new(spec).expect("cylinders"))
}

/// A case of the paper's figure 2: lengths in units of R, pressures in units of E1.
fn textured(name: &'static str, coating: Material, base: Material, side: f64, force: f64) -> Scene {
    let relief = cylinders(CylinderSpec {
        lattice: Lattice::Square,
        radius: 5e-3,
        height: 1e-4,
        period: 1.0 / 80.0,
        offset: [0.0, 0.0],
        young_modulus: 1.0,
    });
    let foundation = Foundation::coated(1e-4, coating, base).expect("a foundation");
    Scene {
        name,
        model: model(&foundation, relief),
        side,
        force,
    }
}

/// Figures 2a and 2c, the coating ten times softer than its base; 2b and 2d, ten times stiffer.
fn textured_scenes() -> [Scene; 4] {
    let soft = [material(1.0, 0.4), material(10.0, 0.3)];
    let stiff = [material(1.0, 0.3), material(0.1, 0.4)];
    [
        ("2a", soft, 0.08, 0.3571e-4),
        ("2b", stiff, 0.08, 0.3571e-5),
        ("2c", soft, 0.12, 2.1426e-4),
        ("2d", stiff, 0.14, 2.1426e-5),
    ]
    .map(|(name, [coating, base], side, force)| textured(name, coating, base, side, force))
}

/// The problems that other programs solve too, at `elements` per side: Hertz with contact radius 0.15 on the unit
/// square, and the same above rigid pillars with a period of 16 elements (`xtask/compare/problem.py` holds the
/// definition).
fn rivals_scenes(elements: usize) -> [Scene; 2] {
    let (contact_radius, period) = (0.15_f64, 16.0 / elements as f64);
    let pillars = cylinders(CylinderSpec {
        lattice: Lattice::Square,
        radius: 0.4 * period,
        height: 0.1 * contact_radius.powi(2),
        period,
        offset: [0.5 * (period - 1.0); 2],
        // Rigid: the shortening is below the last bit of every displacement.
        young_modulus: 1e30,
    });
    let foundation = Foundation::half_space(material(1.0, 0.0));
    [("hertz", Relief::Bare), ("pillars", pillars)].map(|(name, relief)| Scene {
        name,
        model: model(&foundation, relief),
        side: 1.0,
        // F = 4 E* a³/(3R)
        force: 4.0 / 3.0 * contact_radius.powi(3),
    })
}

fn textured_cases(criterion: &mut Criterion) {
    for elements in [256, 512] {
        for scene in textured_scenes() {
            measure(criterion, "textured", &scene, elements);
        }
    }
}

fn rivals_problems(criterion: &mut Criterion) {
    for elements in [512, 1024] {
        for scene in rivals_scenes(elements) {
            measure(criterion, "homogeneous", &scene, elements);
        }
    }
}

/// Times a scene with one thread and with two; the first timed run of a scene prints its work.
fn measure(criterion: &mut Criterion, group: &str, scene: &Scene, elements: usize) {
    let mut group = criterion.benchmark_group(group);
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100));
    let mut is_reported = false;
    for threads in [1, 2] {
        let id = BenchmarkId::new(format!("{}, {threads} threads", scene.name), elements);
        let pool = pool(threads);
        group.bench_function(id, |bencher| {
            pool.install(|| {
                if !is_reported {
                    report(scene, &scene.solve(elements));
                    is_reported = true;
                }
                bencher.iter(|| scene.solve(elements));
            });
        });
    }
    group.finish();
}

fn pool(threads: usize) -> ThreadPool {
    let builder = ThreadPoolBuilder::new().num_threads(threads);
    builder.build().expect("a pool")
}

/// Prints products with K and the certificate's worst line, which do not depend on the number of threads.
fn report(scene: &Scene, path: &LoadingPath) {
    for step in &path.steps {
        eprintln!(
            "{} at N = {}: {} products, certificate {:.1e}",
            scene.name,
            path.grid.size(),
            step.work.operator_applications,
            step.solution.certificate.worst(),
        );
    }
}

criterion_group!(benches, textured_cases, rivals_problems);
criterion_main!(benches);
