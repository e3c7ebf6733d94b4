//! From grid to grid and from load to load: the accuracy on each grid, and the products that its start saves.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::sync::Arc;

use pellicle_contact::{
    Domain, Indenter, Load, LoadingPath, Model, Observer, Paraboloid, Progress, Signal, Solution,
    SolverOptions, solve_path,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{CylinderSpec, Cylinders, Lattice, Relief};

/// A paraboloid of radius 1 on cylinders of radius 0.02 and period 0.05 on a coating of relative stiffness `stiffness`.
fn model(stiffness: f64) -> Model {
    let coating = Material::new(stiffness, 0.3).unwrap();
    let foundation = Foundation::coated(0.01, coating, Material::new(1.0, 0.3).unwrap()).unwrap();
    let spec = CylinderSpec {
        lattice: Lattice::Square,
        radius: 0.02,
        height: 1e-3,
        period: 0.05,
        offset: [0.0, 0.0],
        young_modulus: 10.0,
    };
    Model {
        tables: Arc::new(RadialTables::build(&foundation).unwrap()),
        relief: Relief::Cylinders(Cylinders::new(spec).unwrap()),
        indenter: Indenter::Paraboloid(Paraboloid::new(1.0).unwrap()),
        cache: Cache::in_memory(),
    }
}

/// Every residual reported, with the grid's elements per side.
#[derive(Default)]
struct Log(Vec<(usize, f64)>);

impl Observer for Log {
    fn progress(&mut self, progress: &Progress) -> Signal {
        self.0.push((progress.elements, progress.residual));
        Signal::Continue
    }
}

fn solve(model: &Model, side: f64, elements: usize, loads: &[Load]) -> (LoadingPath, Log) {
    let (options, mut log) = (SolverOptions::default(), Log::default());
    let domain = Domain::Side(side);
    let path = solve_path(model, domain, elements, loads, &options, &mut log).unwrap();
    for step in &path.steps {
        let certificate = step.solution.certificate;
        assert!(certificate.is_satisfied(), "{certificate:?}");
    }
    (path, log)
}

#[test]
fn coarse_grids_are_solved_to_a_millionth_and_the_finest_to_the_tolerance() {
    let (path, log) = solve(&model(1.0), 0.4, 128, &[Load::Force(2e-3)]);
    for (elements, tolerance) in [(16, 1e-6), (32, 1e-6), (64, 1e-6), (128, 1e-8)] {
        let reports = log.0.iter().filter(|report| report.0 == elements);
        let residuals: Vec<f64> = reports.map(|report| report.1).collect();
        let (last, before) = residuals.split_last().unwrap();
        // Steps end at 0.8 of the tolerance; none begins below it.
        assert!(*last <= tolerance, "{elements}: {last:e}");
        let least = before.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(least > 0.8 * tolerance, "{elements}: {least:e}");
        if elements == 128 {
            assert_eq!(path.steps[0].residuals, residuals);
        }
    }
}

#[test]
fn the_work_of_a_step_is_that_of_its_finest_grid_and_is_listed_for_all() {
    let loads = [Load::Force(2e-3), Load::Force(2.2e-3)];
    let (path, _) = solve(&model(10.0), 0.4, 128, &loads);
    for step in &path.steps {
        let sizes: Vec<usize> = step
            .work
            .levels
            .iter()
            .map(|level| level.elements)
            .collect();
        assert_eq!(sizes, [16, 32, 64, 128]);
        let finest = step.work.levels[3];
        assert_eq!(step.work.iterations, finest.iterations);
        assert_eq!(
            step.work.operator_applications,
            finest.operator_applications
        );
        assert_eq!(
            step.work.stiffness_applications,
            finest.stiffness_applications
        );
        // The stiffness is not computed on a coarse grid.
        assert!(finest.stiffness_applications > 0);
        assert_eq!(step.work.levels[0].stiffness_applications, 0);
        let values: Vec<usize> = step.grid_error.levels.iter().map(|l| l.elements).collect();
        assert_eq!(values, sizes);
        let last = step.grid_error.levels[3];
        assert_eq!(
            last.penetration.to_bits(),
            step.solution.penetration.to_bits()
        );
        assert_eq!(
            last.contact_area.to_bits(),
            step.summary.contact_area.to_bits()
        );
        assert_eq!(
            last.max_pressure.to_bits(),
            step.summary.max_pressure.to_bits()
        );
    }
    let seconds = path.steps.iter().map(|step| step.work.seconds);
    assert!(seconds.fold(0.0, f64::max) <= path.solve_seconds);
}

#[test]
fn each_iteration_takes_one_product_besides_those_of_the_start_and_the_certificate() {
    let (path, _) = solve(&model(1.0), 0.4, 128, &[Load::Force(2e-3)]);
    for level in &path.steps[0].work.levels {
        let fewest = level.iterations + 2;
        // A conjugate step that is clipped takes another.
        assert!((fewest..=fewest + 1).contains(&level.operator_applications));
    }
}

#[test]
fn a_certificate_covers_the_whole_grid() {
    let (model, side, load) = (model(10.0), 0.8, Load::Force(2e-3));
    let (path, _) = solve(&model, side, 96, &[load]);
    let found = &path.steps[0].solution;
    let sampled = model.sample(side, 96).unwrap();
    let mut problem = model.discretize(&sampled).unwrap().value;
    let (pressure, tolerance) = (found.pressure.clone(), found.certificate.tolerance);
    let (again, whole) = Solution::judge_with_surface(&mut problem, load, pressure, tolerance);
    let surface = path.surface(&path.geometry(), 0).unwrap();
    let largest = whole.displacement.iter().copied().fold(0.0, f64::max);
    for (found, whole) in [
        (surface.displacement, whole.displacement),
        (surface.shortening, whole.shortening),
        (surface.gap, whole.gap),
    ] {
        for (found, whole) in found.iter().zip(whole) {
            // Rounding of transforms of two lengths.
            assert!((found - whole).abs() < 1e-13 * largest);
        }
    }
    let (certificate, whole) = (found.certificate, again.certificate);
    assert!((certificate.gap_in_contact - whole.gap_in_contact).abs() < 1e-12);
    assert!((certificate.overlap - whole.overlap).abs() < 1e-12);
    assert!((certificate.complementarity - whole.complementarity).abs() < 1e-12);
}

#[test]
fn no_load_depends_on_the_others() {
    for stiffness in [0.1, 1.0, 100.0] {
        let model = model(stiffness);
        let forces = [3.0, 1.0, 4.0, 1.5, 5.0, 9.0, 2.0, 6.0, 5.3, 0.01].map(|force| 2e-4 * force);
        let (path, _) = solve(&model, 0.4, 96, &forces.map(Load::Force));
        let mut backwards = forces;
        backwards.reverse();
        let (reversed, _) = solve(&model, 0.4, 96, &backwards.map(Load::Force));
        let again = reversed.steps.iter().rev();
        for ((step, again), force) in path.steps.iter().zip(again).zip(forces) {
            assert!(step.solution == again.solution, "{stiffness}: {force}");
            let alone = &solve(&model, 0.4, 96, &[Load::Force(force)]).0.steps[0];
            approx::assert_relative_eq!(
                step.solution.penetration,
                alone.solution.penetration,
                max_relative = 1e-7
            );
        }
    }
}

#[test]
fn a_coarser_grid_saves_products() {
    // As measured, with two to spare.
    for (stiffness, most) in [(0.1, 9), (10.0, 21)] {
        let loads = [2e-3, 2.1e-3, 2.2e-3].map(Load::Force);
        let (path, _) = solve(&model(stiffness), 0.4, 128, &loads);
        for step in &path.steps {
            let taken = step.work.operator_applications;
            assert!(taken <= most, "{stiffness}: {taken}, at most {most}");
        }
    }
}

#[test]
fn a_penetration_takes_hardly_more_products_than_its_force() {
    for stiffness in [0.1, 1.0, 10.0] {
        let model = model(stiffness);
        let (by_force, _) = solve(&model, 0.4, 256, &[Load::Force(2e-3)]);
        let by_force = &by_force.steps[0];
        let depth = Load::Penetration(by_force.solution.penetration);
        let (by_depth, _) = solve(&model, 0.4, 256, &[depth]);
        let by_depth = &by_depth.steps[0];
        let products = [by_force, by_depth].map(|step| step.work.operator_applications);
        assert!(products[1] <= products[0] + 4, "{stiffness}: {products:?}");
        let forces = [by_force, by_depth].map(|step| step.solution.force);
        approx::assert_relative_eq!(forces[0], forces[1], max_relative = 1e-7);
    }
}

#[test]
fn a_small_contact_is_the_same_on_a_large_domain_as_on_a_small_one() {
    let model = model(1.0);
    let loads = [Load::Force(2e-4), Load::Force(1e-3)];
    let (small, _) = solve(&model, 0.3, 48, &loads);
    // The same elements, on a square four times as wide: the centre begins at index 72 of 192 elements.
    let (large, _) = solve(&model, 1.2, 192, &loads);
    for (small, large) in small.steps.iter().zip(&large.steps) {
        let (p, q) = (&small.solution.pressure, &large.solution.pressure);
        let peak = small.summary.max_pressure;
        for (e, q) in q.iter().enumerate() {
            let (i, j) = (e / 192, e % 192);
            let inside = (72..120).contains(&i) && (72..120).contains(&j);
            let wanted = if inside {
                p[(i - 72) * 48 + j - 72]
            } else {
                0.0
            };
            // two solutions to 1e-8, times a condition number of 1e2
            assert!((q - wanted).abs() < 1e-5 * peak, "{i} {j}");
        }
        // as measured, with two to spare
        assert!(small.work.operator_applications <= 21);
        assert!(large.work.operator_applications <= 19);
    }
}
