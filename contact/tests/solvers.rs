//! Both solvers on problems small enough for a dense matrix: they agree, are certified and recover from bad starts.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use pellicle_contact::{
    ActiveSetSolver, ContactError, DiscreteProblem, GradientSolver, Load, Observer, Progress,
    Signal, Solution, Solver, SolverOptions, Watch,
};
use std::sync::Arc;

use pellicle_influence::{CoefficientTable, RadialTables, SurfaceElasticity};
use pellicle_kernel::{Foundation, Material};
use proptest::prelude::*;

/// Tolerance of the solutions compared here; the pressures then agree to about this times the condition number, 1e2.
const TOLERANCE: f64 = 1e-12;

/// A contact on `size`² elements of side `1/size` on a coated half-space.
fn problem(
    size: usize,
    stiffness: f64,
    gap: impl Fn(f64, f64) -> f64,
    eta: impl Fn(f64, f64) -> f64,
) -> DiscreteProblem {
    let coating = Material::new(stiffness, 0.3).unwrap();
    let foundation = Foundation::coated(0.05, coating, Material::new(1.0, 0.4).unwrap()).unwrap();
    let tables = RadialTables::build(&foundation).unwrap();
    let side = 1.0 / size as f64;
    let table = CoefficientTable::assemble(&tables, side, size).unwrap();
    let centre = |i: usize| (i as f64 + 0.5) * side - 0.5;
    let sample = |f: &dyn Fn(f64, f64) -> f64| {
        (0..size * size)
            .map(|e| f(centre(e / size), centre(e % size)))
            .collect()
    };
    let elasticity = SurfaceElasticity::new(Arc::new(table), foundation);
    let (eta, gap) = (sample(&eta), sample(&gap));
    DiscreteProblem::elastic(Arc::new(elasticity), size, eta, gap, side * side).unwrap()
}

fn paraboloid(x: f64, y: f64) -> f64 {
    f64::midpoint(x * x, y * y)
}

/// A paraboloid over waves deep enough for separate islands.
fn wavy(x: f64, y: f64) -> f64 {
    paraboloid(x, y) + 0.01 * (1.0 - (23.0 * x + 0.3).cos() * (19.0 * y - 0.2).cos())
}

fn solve(
    solver: &mut dyn Solver,
    problem: &mut DiscreteProblem,
    load: Load,
    start: &[f64],
) -> Solution {
    let iterate = solver
        .solve(problem, load, start, &mut Watch::alone(&mut ()))
        .unwrap();
    Solution::judge(problem, load, iterate.pressure, TOLERANCE)
}

fn gradient() -> GradientSolver {
    GradientSolver::new(SolverOptions {
        tolerance: TOLERANCE,
        ..SolverOptions::default()
    })
}

fn cold(problem: &DiscreteProblem) -> Vec<f64> {
    vec![0.0; problem.elements()]
}

fn largest_difference(one: &Solution, other: &Solution) -> f64 {
    let peak = one.pressure.iter().copied().fold(0.0, f64::max);
    let differences = one
        .pressure
        .iter()
        .zip(&other.pressure)
        .map(|(p, q)| (p - q).abs());
    differences.fold(0.0, f64::max) / peak
}

#[test]
fn both_solvers_find_the_same_pressure_under_force_and_under_penetration() {
    for stiffness in [0.1, 10.0] {
        for load in [Load::Force(2e-3), Load::Penetration(0.01)] {
            let mut problem = problem(24, stiffness, wavy, |x, _| if x > 0.0 { 0.02 } else { 0.0 });
            let start = cold(&problem);
            let by_gradient = solve(&mut gradient(), &mut problem, load, &start);
            let by_active_set = solve(&mut ActiveSetSolver::default(), &mut problem, load, &start);
            assert!(
                by_gradient.certificate.is_satisfied(),
                "{:?}",
                by_gradient.certificate
            );
            assert!(
                by_active_set.certificate.is_satisfied(),
                "{:?}",
                by_active_set.certificate
            );
            // The tolerance times the condition number of the systems, about 1e2.
            assert!(largest_difference(&by_gradient, &by_active_set) < 1e-10);
        }
    }
}

#[test]
fn penetration_control_recovers_the_original_force() {
    let mut problem = problem(32, 10.0, wavy, |_, _| 0.0);
    let start = cold(&problem);
    let by_force = solve(&mut gradient(), &mut problem, Load::Force(1e-3), &start);
    let by_penetration = solve(
        &mut gradient(),
        &mut problem,
        Load::Penetration(by_force.penetration),
        &start,
    );
    // Both certify gaps to 1e-12 of the penetration; the error of the force follows with the contact stiffness.
    approx::assert_relative_eq!(by_penetration.force, 1e-3, max_relative = 1e-10);
    assert!(largest_difference(&by_force, &by_penetration) < 1e-9);
}

#[test]
fn the_active_set_recovers_elements_that_a_bad_start_left_out() {
    let mut problem = problem(24, 10.0, paraboloid, |_, _| 0.0);
    let load = Load::Force(2e-3);
    let start = cold(&problem);
    let wanted = solve(&mut gradient(), &mut problem, load, &start);
    let mut corner = cold(&problem);
    corner[0] = 1.0;
    let found = solve(&mut ActiveSetSolver::default(), &mut problem, load, &corner);
    assert!(found.certificate.is_satisfied(), "{:?}", found.certificate);
    assert!(largest_difference(&wanted, &found) < 1e-10);
}

#[test]
fn without_contact_force_and_pressure_are_zero_and_the_certificate_is_satisfied() {
    let mut problem = problem(16, 10.0, |x, y| 0.1 + paraboloid(x, y), |_, _| 0.0);
    for solver in [
        &mut gradient() as &mut dyn Solver,
        &mut ActiveSetSolver::default(),
    ] {
        for penetration in [0.05, 0.0, -1.0] {
            let start = cold(&problem);
            let solution = solve(solver, &mut problem, Load::Penetration(penetration), &start);
            assert!(
                solution.certificate.is_satisfied(),
                "{:?}",
                solution.certificate
            );
            assert_eq!(solution.force.to_bits(), 0.0_f64.to_bits());
        }
    }
}

#[test]
fn elements_beyond_the_indenters_rim_stay_out_of_contact() {
    let rim = |x: f64, y: f64| if x.hypot(y) < 0.3 { 0.0 } else { f64::INFINITY };
    // A soft coating: a stiff one would be bent away from the flat by the punch's rim.
    let mut problem = problem(24, 0.1, rim, |_, _| 0.0);
    let start = cold(&problem);
    let by_gradient = solve(&mut gradient(), &mut problem, Load::Force(1e-2), &start);
    let by_active_set = solve(
        &mut ActiveSetSolver::default(),
        &mut problem,
        Load::Force(1e-2),
        &start,
    );
    assert!(
        by_gradient.certificate.is_satisfied(),
        "{:?}",
        by_gradient.certificate
    );
    assert!(largest_difference(&by_gradient, &by_active_set) < 1e-9);
    let touching = by_gradient.pressure.iter().filter(|p| **p > 0.0).count();
    assert_eq!(
        touching,
        problem
            .initial_gap()
            .iter()
            .filter(|g| g.is_finite())
            .count()
    );
}

#[test]
fn contact_that_fills_the_grid_is_solved() {
    let mut problem = problem(24, 0.1, paraboloid, |_, _| 0.0);
    let start = cold(&problem);
    let solution = solve(&mut gradient(), &mut problem, Load::Force(1.0), &start);
    assert!(
        solution.certificate.is_satisfied(),
        "{:?}",
        solution.certificate
    );
    assert!(solution.pressure.iter().all(|p| *p > 0.0));
}

#[test]
fn a_pressure_perturbed_by_a_millionth_fails_its_certificate() {
    let mut problem = problem(24, 10.0, paraboloid, |_, _| 0.0);
    let load = Load::Force(2e-3);
    let start = cold(&problem);
    let good = solve(&mut gradient(), &mut problem, load, &start);
    let mut bad = good.pressure.clone();
    let touching = bad.iter().position(|p| *p > 0.0).unwrap();
    bad[touching] *= 1.0 + 1e-6;
    assert!(
        !Solution::judge(&mut problem, load, bad.clone(), TOLERANCE)
            .certificate
            .is_satisfied()
    );
    bad[touching] = f64::NAN;
    assert!(
        !Solution::judge(&mut problem, load, bad.clone(), TOLERANCE)
            .certificate
            .is_satisfied()
    );
    bad[touching] = -1e-300;
    assert!(
        !Solution::judge(&mut problem, load, bad, 0.1)
            .certificate
            .is_satisfied()
    );
}

/// All reports of one solver on one solution.
#[derive(Default)]
struct Log(Vec<Progress>);

impl Observer for Log {
    fn progress(&mut self, progress: &Progress) -> Signal {
        self.0.push(*progress);
        Signal::Continue
    }
}

#[test]
fn every_solver_reports_its_working_set_and_its_changes() {
    let (mut by_gradient, mut active_set) = (gradient(), ActiveSetSolver::default());
    for solver in [&mut by_gradient as &mut dyn Solver, &mut active_set] {
        let mut problem = problem(24, 10.0, wavy, |_, _| 0.0);
        let start = cold(&problem);
        let mut log = Log::default();
        let mut watch = Watch::alone(&mut log);
        let outcome = solver.solve(&mut problem, Load::Force(2e-3), &start, &mut watch);
        let pressing = outcome
            .unwrap()
            .pressure
            .iter()
            .filter(|p| **p > 0.0)
            .count();
        let reports = log.0;
        assert!(
            reports
                .iter()
                .map(|report| report.iteration)
                .eq(0..reports.len())
        );
        assert_eq!(reports.last().unwrap().working_set, pressing);
        // Initially the whole set is new. Then as many elements enter or leave as it grows or shrinks by, or an even
        // number more than that.
        assert_eq!(reports[0].working_set_change, reports[0].working_set);
        assert!(reports[1].working_set_change > 0);
        for pair in reports.windows(2) {
            let growth = pair[0].working_set.abs_diff(pair[1].working_set);
            let moves = pair[1].working_set_change;
            assert!(moves >= growth && (moves - growth).is_multiple_of(2));
        }
    }
}

#[test]
fn an_observer_can_cancel() {
    struct Impatient;
    impl Observer for Impatient {
        fn progress(&mut self, progress: &Progress) -> Signal {
            if progress.iteration < 2 {
                Signal::Continue
            } else {
                Signal::Cancel
            }
        }
    }
    let mut problem = problem(24, 10.0, paraboloid, |_, _| 0.0);
    let start = cold(&problem);
    let mut watch = Watch {
        observer: &mut Impatient,
        step: 3,
        finished: 3,
        steps: 7,
    };
    let outcome = gradient().solve(&mut problem, Load::Force(2e-3), &start, &mut watch);
    assert!(matches!(outcome, Err(ContactError::Cancelled { step: 3 })));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Random rough reliefs with random springs and loads over four decades: the gradient method certifies and agrees
    /// with the active set.
    #[test]
    fn random_reliefs_are_certified_and_agree(
        heights in prop::collection::vec(0.0..0.05_f64, 144),
        springs in prop::collection::vec(0.0..0.3_f64, 144),
        exponent in -5.0..-1.0_f64,
        stiffness in prop::sample::select(vec![0.01, 1.0, 30.0]),
    ) {
        let at = |x: f64, y: f64, field: &[f64]| {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cell of 12 by 12")]
            let index = |c: f64| ((c + 0.5) * 12.0) as usize;
            field[index(x) * 12 + index(y)]
        };
        let mut problem = problem(12, stiffness, |x, y| paraboloid(x, y) + at(x, y, &heights), |x, y| at(x, y, &springs));
        let load = Load::Force(10_f64.powf(exponent));
        let start = cold(&problem);
        let by_gradient = solve(&mut gradient(), &mut problem, load, &start);
        let by_active_set = solve(&mut ActiveSetSolver::default(), &mut problem, load, &start);
        prop_assert!(by_gradient.certificate.is_satisfied(), "{:?}", by_gradient.certificate);
        prop_assert!(by_active_set.certificate.is_satisfied(), "{:?}", by_active_set.certificate);
        prop_assert!(largest_difference(&by_gradient, &by_active_set) < 1e-9);
    }
}
