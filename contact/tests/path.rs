//! Loading paths: domains that hold the contact, levels that reduce the work, and warnings.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::sync::Arc;

use pellicle_contact::{
    ContactError, Domain, Indenter, Load, LoadingPath, Method, Model, Observer, Paraboloid,
    Profile, Progress, Signal, SolverOptions, Status, default_side, solve_path,
};
use pellicle_influence::{Cache, RadialTables, Sector};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{CylinderSpec, Cylinders, Film, Lattice, Relief};

/// A paraboloid of radius 1 on a homogeneous body of plane-strain modulus 1 under `relief`.
fn model(relief: Relief) -> Model {
    let foundation = Foundation::half_space(Material::new(1.0, 0.0).unwrap());
    Model {
        tables: Arc::new(RadialTables::build(&foundation).unwrap()),
        relief,
        indenter: Indenter::Paraboloid(Paraboloid::new(1.0).unwrap()),
        cache: Cache::in_memory(),
    }
}

fn solve(model: &Model, domain: Domain, elements: usize, loads: &[Load]) -> LoadingPath {
    solve_path(
        model,
        domain,
        elements,
        loads,
        &SolverOptions::default(),
        &mut (),
    )
    .unwrap()
}

/// Force of the Hertzian contact radius `a`.
fn hertz_force(a: f64) -> Load {
    Load::Force(4.0 / 3.0 * a.powi(3))
}

fn codes(path: &LoadingPath) -> Vec<&'static str> {
    path.warnings
        .iter()
        .map(pellicle_contact::Warning::code)
        .collect()
}

#[test]
fn the_default_side_of_a_hertzian_contact_is_three_radii() {
    for a in [1e-6, 0.1] {
        let side = default_side(
            &model(Relief::Bare),
            &[hertz_force(a), hertz_force(0.5 * a)],
        );
        // The search stops within a hundredth; the error of the quadrature over 64 points is small.
        approx::assert_relative_eq!(side, 3.0 * a, max_relative = 0.02);
    }
}

#[test]
fn an_automatic_domain_holds_the_contact_of_every_load() {
    let loads = [hertz_force(0.05), hertz_force(0.1)];
    let path = solve(&model(Relief::Bare), Domain::Automatic, 48, &loads);
    for step in &path.steps {
        assert!(step.solution.certificate.is_satisfied());
        assert!(
            step.summary.contact_radius < 0.5 * path.grid.side() - 3.0 * path.grid.element_side()
        );
    }
}

#[test]
fn an_automatic_domain_grows_with_a_relief_that_spreads_the_contact() {
    let film = Relief::Film(Film::new(0.02, 0.01).unwrap());
    let path = solve(&model(film), Domain::Automatic, 48, &[hertz_force(0.1)]);
    let step = &path.steps[0];
    assert!(step.summary.contact_radius > 0.12, "{:?}", step.summary);
    assert!(!codes(&path).contains(&"domain-edge"));
}

#[test]
fn a_given_domain_that_is_too_small_is_kept_and_its_result_cut_off() {
    let path = solve(
        &model(Relief::Bare),
        Domain::Side(0.2),
        48,
        &[hertz_force(0.1)],
    );
    approx::assert_relative_eq!(path.grid.side(), 0.2);
    assert_eq!(path.steps[0].status(), Status::CutOff);
    assert_eq!(codes(&path), ["cut-off"]);
}

#[test]
fn penetrations_without_contact_are_valid_and_have_no_force() {
    let loads = [-0.1, 0.0, 0.01].map(Load::Penetration);
    let path = solve(&model(Relief::Bare), Domain::Automatic, 48, &loads);
    assert!(
        path.steps
            .iter()
            .all(|step| step.solution.certificate.is_satisfied())
    );
    assert_eq!(path.steps[0].summary.contact_elements, 0);
    // Touching at a point exerts no force.
    assert!(path.steps[1].solution.force.abs() < 1e-12);
    assert!(path.steps[2].solution.force > 0.0);
    approx::assert_relative_eq!(path.steps[2].solution.penetration, 0.01);
}

#[test]
fn a_film_shortened_beyond_its_thickness_is_warned_about() {
    let film = Relief::Film(Film::new(1e-4, 0.01).unwrap());
    let path = solve(&model(film), Domain::Automatic, 48, &[hertz_force(0.1)]);
    assert!(
        codes(&path).contains(&"film-shortening"),
        "{:?}",
        path.warnings
    );
}

#[test]
fn coarse_cylinders_are_warned_about() {
    let spec = CylinderSpec {
        lattice: Lattice::Square,
        radius: 0.008,
        height: 1e-3,
        period: 0.02,
        offset: [0.0, 0.0],
        young_modulus: 1.0,
    };
    let relief = Relief::Cylinders(Cylinders::new(spec).unwrap());
    let path = solve(&model(relief), Domain::Side(0.4), 64, &[hertz_force(0.1)]);
    assert!(
        codes(&path).contains(&"texture-under-resolved"),
        "{:?}",
        path.warnings
    );
}

#[test]
fn the_grid_error_of_a_smooth_contact_covers_the_true_error() {
    let path = solve(
        &model(Relief::Bare),
        Domain::Side(0.3),
        256,
        &[hertz_force(0.1)],
    );
    let error = path.steps[0].grid_error.penetration.unwrap();
    let true_error = (path.steps[0].solution.penetration - 0.01).abs();
    // Hertz: D = a²/R = 0.01.
    assert!(
        true_error < error.estimate && error.estimate < 8.0 * true_error,
        "{true_error:e} {error:?}"
    );
    assert_eq!(path.steps[0].grid_error.levels.len(), 5);
}

#[test]
fn the_active_set_solves_a_path_and_refuses_too_large_a_grid() {
    let options = SolverOptions {
        method: Method::ActiveSet,
        ..SolverOptions::default()
    };
    let model = model(Relief::Bare);
    let load = [hertz_force(0.1)];
    let path = solve_path(&model, Domain::Side(0.3), 40, &load, &options, &mut ()).unwrap();
    assert!(path.steps[0].solution.certificate.is_satisfied());
    let refused = solve_path(&model, Domain::Side(0.3), 512, &load, &options, &mut ());
    assert!(matches!(
        refused,
        Err(ContactError::TooLargeForActiveSet { elements: 512, .. })
    ));
}

#[test]
fn a_step_out_of_products_is_returned_and_marked() {
    let options = SolverOptions {
        max_applications: 2,
        ..SolverOptions::default()
    };
    let path = solve_path(
        &model(Relief::Bare),
        Domain::Side(0.3),
        64,
        &[hertz_force(0.1)],
        &options,
        &mut (),
    )
    .unwrap();
    assert!(!path.steps[0].solution.certificate.is_satisfied());
    assert!(codes(&path).contains(&"not-converged"));
}

/// Loads of a paraboloid on a homogeneous body, on 64 × 64 elements.
fn watched_path(loads: &[Load], observer: &mut dyn Observer) -> LoadingPath {
    let (model, domain) = (model(Relief::Bare), Domain::Side(0.3));
    let options = SolverOptions::default();
    solve_path(&model, domain, 64, loads, &options, observer).unwrap()
}

#[test]
fn the_observer_sees_every_level_and_step() {
    #[derive(Default)]
    struct Log(Vec<(usize, usize)>);
    impl Observer for Log {
        fn progress(&mut self, progress: &Progress) -> Signal {
            self.0.push((progress.step, progress.elements));
            Signal::Continue
        }
    }
    let mut log = Log::default();
    let loads = [hertz_force(0.05), hertz_force(0.1)];
    watched_path(&loads, &mut log);
    // Both loads are solved at the same time, each from coarse to fine.
    let of_step = |step: usize| {
        let reports = log.0.iter().filter(|report| report.0 == step);
        let mut grids: Vec<usize> = reports.map(|report| report.1).collect();
        grids.dedup();
        grids
    };
    assert_eq!([of_step(0), of_step(1)], [[16, 32, 64], [16, 32, 64]]);
}

/// A user-defined profile `f = ρ⁴/4`, symmetric in x and y.
#[derive(Debug)]
struct Quartic;

impl Profile for Quartic {
    fn height(&self, x: f64, y: f64) -> f64 {
        0.25 * (x * x + y * y).powi(2)
    }

    fn is_mirrored(&self) -> bool {
        true
    }
}

#[test]
fn a_custom_shape_on_an_automatic_domain_agrees_with_its_closed_form() {
    let model = Model {
        indenter: Indenter::custom(Quartic),
        ..model(Relief::Bare)
    };
    // f = B ρ⁴ on a body of E* = 1: D = 8/3 B a⁴, Q = 2 · 4/5 a D (Galin 1946; Sneddon 1965)
    let (a, b) = (0.3_f64, 0.25);
    let force = 64.0 / 15.0 * b * a.powi(5);
    let path = solve(&model, Domain::Automatic, 128, &[Load::Force(force)]);
    let step = &path.steps[0];
    assert_eq!(step.status(), Status::Certified);
    let penetration = 8.0 / 3.0 * b * a.powi(4);
    let error = (step.solution.penetration - penetration).abs();
    assert!(
        error <= step.grid_error.penetration.unwrap().estimate,
        "{error:e}"
    );
    assert_eq!(model.sector(), Sector::Quadrant);
    assert!(model.indenter == model.indenter.clone());
    assert!(model.indenter != Indenter::custom(Quartic));
}

#[test]
fn a_path_unloads_as_it_loads_and_its_stiffness_is_the_slope_of_its_curve() {
    let forces = [0.1, 0.1002, 0.1004, 0.14, 0.1002].map(hertz_force);
    let path = solve(&model(Relief::Bare), Domain::Side(0.5), 96, &forces);
    let step = |i: usize| &path.steps[i].solution;
    // Elastic: the same load gives the same state, within the tolerance.
    approx::assert_relative_eq!(
        step(1).penetration,
        step(4).penetration,
        max_relative = 1e-7
    );
    // The contact set is constant over this interval, so the curve is straight there.
    let slope = (step(2).force - step(0).force) / (step(2).penetration - step(0).penetration);
    let stiffness = path.steps[1].contact_stiffness.unwrap();
    // The set may change by a few of 1200 elements, those with the least pressure.
    approx::assert_relative_eq!(stiffness, slope, max_relative = 2e-3);
    // Hertz: dQ/dD = 2 E* a, on a grid of 19 elements per radius.
    approx::assert_relative_eq!(stiffness, 2.0 * 0.1002, max_relative = 5e-3);
}

#[test]
fn a_cancelled_path_keeps_the_steps_that_it_finished() {
    struct AtTheSecond;
    impl Observer for AtTheSecond {
        fn progress(&mut self, progress: &Progress) -> Signal {
            if progress.step == 1 && progress.elements == 64 {
                Signal::Cancel
            } else {
                Signal::Continue
            }
        }
    }
    let loads = [0.05, 0.08, 0.1].map(hertz_force);
    let solved_by = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let solve = || watched_path(&loads, &mut AtTheSecond);
        pool.unwrap().install(solve)
    };
    let path = solved_by(1);
    assert!(path.interrupted);
    assert_eq!(path.steps.len(), 1);
    assert!(path.steps[0].solution.certificate.is_satisfied());
    // If loads are solved at the same time, the first may still be running when the second is cancelled, and is then
    // cancelled too.
    let path = solved_by(3);
    assert!(path.interrupted && path.steps.len() <= 1);
}

/// The result of `task` on a pool of this many threads.
fn with_threads<T: Send>(threads: usize, task: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.unwrap().install(task)
}

#[test]
fn a_finest_grid_built_in_parallel_with_the_coarser_ones_is_the_same() {
    // The film makes the first domain too small, so that the grid is prepared in advance more than once.
    let film = || Relief::Film(Film::new(0.02, 0.01).unwrap());
    let solved = |threads| {
        with_threads(threads, || {
            let path = solve(&model(film()), Domain::Automatic, 512, &[hertz_force(0.1)]);
            assert!(path.solve_seconds > 0.0 && path.coefficients_seconds > 0.0);
            path
        })
    };
    let (one, two) = (solved(1), solved(2));
    assert_eq!(one.grid, two.grid);
    assert!(one.steps[0].solution.certificate.is_satisfied());
    assert_eq!(one.steps[0].solution, two.steps[0].solution);
    assert_eq!(one.steps[0].grid_error, two.steps[0].grid_error);
}

#[test]
fn a_path_can_be_cancelled_while_its_finest_grid_is_built() {
    struct Cancels;
    impl Observer for Cancels {
        fn progress(&mut self, progress: &Progress) -> Signal {
            if progress.elements == 128 {
                Signal::Cancel
            } else {
                Signal::Continue
            }
        }
    }
    let path = with_threads(2, || {
        let (domain, options) = (Domain::Side(0.3), SolverOptions::default());
        let loads = [hertz_force(0.1)];
        solve_path(
            &model(Relief::Bare),
            domain,
            512,
            &loads,
            &options,
            &mut Cancels,
        )
        .unwrap()
    });
    assert!(path.interrupted && path.steps.is_empty());
}

/// A shape whose height is NaN far from its axis.
#[derive(Debug)]
struct WithNan;

impl Profile for WithNan {
    fn height(&self, x: f64, y: f64) -> f64 {
        if x > 0.3 { f64::NAN } else { x * x + y * y }
    }
}

#[test]
fn a_nan_height_is_an_error_of_the_path() {
    let model = Model {
        indenter: Indenter::custom(WithNan),
        ..model(Relief::Bare)
    };
    let (loads, options) = ([Load::Penetration(0.01)], SolverOptions::default());
    let found = solve_path(&model, Domain::Side(1.0), 32, &loads, &options, &mut ());
    assert!(
        matches!(found, Err(ContactError::FieldValue { .. })),
        "{found:?}"
    );
}
