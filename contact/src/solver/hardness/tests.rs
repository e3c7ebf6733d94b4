//! Small problems with a hardness: the conditions of a solution, and the work in products with `K`.

use super::*;
use crate::{
    ActiveSetSolver, GradientSolver, Solution, Solver, SolverOptions,
    solver::tests::{RIGID, SIZE, paraboloid, pillars, problem},
};

const COLD: [f64; SIZE * SIZE] = [0.0; SIZE * SIZE];

/// Solves and checks the certificate: a pressure between 0 and the limit that meets all conditions is the unique
/// solution.
#[track_caller]
fn solved(
    solver: &mut impl Solver,
    problem: &mut DiscreteProblem,
    load: Load,
    start: &[f64],
) -> (Iterate, Solution) {
    let iterate = solver
        .solve(problem, load, start, &mut Watch::alone(&mut ()))
        .unwrap();
    let solution = Solution::judge(problem, load, iterate.pressure.clone(), 1e-8);
    assert!(
        solution.certificate.is_satisfied(),
        "{:?}",
        solution.certificate
    );
    let limit = problem.hardness();
    assert!(iterate.pressure.iter().all(|p| (0.0..=limit).contains(p)));
    if let Load::Force(force) = load {
        assert!((solution.force / force - 1.0).abs() < 1e-12);
    }
    (iterate, solution)
}

/// The peak of the pressure without a limit.
fn elastic_peak(problem: &mut DiscreteProblem, load: Load) -> f64 {
    let mut solver = GradientSolver::default();
    let found = solver.solve(problem, load, &COLD, &mut Watch::alone(&mut ()));
    found.unwrap().pressure.into_iter().fold(0.0, f64::max)
}

/// Solves from a zero start, from its own solution and from four fifths of it, with the limit at a fraction `part` of
/// the elastic peak; returns the products of each.
#[track_caller]
fn work(case: &impl Fn() -> DiscreteProblem, load: Load, part: f64) -> [usize; 3] {
    let peak = elastic_peak(&mut case(), load);
    let mut problem = case().with_hardness(part * peak).unwrap();
    let mut solver = GradientSolver::default();
    let (cold, _) = solved(&mut solver, &mut problem, load, &COLD);
    assert!(cold.pressure.contains(&(part * peak)));
    let starts = [1.0, 0.8].map(|factor| cold.pressure.iter().map(|p| factor * p).collect());
    let [again, near] = starts.map(|start: Vec<f64>| {
        let (found, _) = solved(&mut solver, &mut problem, load, &start);
        for (p, q) in found.pressure.iter().zip(&cold.pressure) {
            // The certificate's 1e-8 times the condition number of the systems.
            assert!((p - q).abs() < 1e-4 * part * peak, "{p} {q}");
        }
        found.operator_applications
    });
    [cold.operator_applications, again, near]
}

/// Asserts that the products are no more than measured, with a margin of a tenth.
#[track_caller]
fn assert_work(case: &impl Fn() -> DiscreteProblem, load: Load, cases: &[(f64, [usize; 3])]) {
    for (part, most) in cases {
        let found = work(case, load, *part);
        let is_as_measured = found
            .iter()
            .zip(most)
            .all(|(found, most)| 10 * found <= 11 * most);
        assert!(is_as_measured, "{part}: {found:?}");
    }
}

#[test]
fn a_contact_at_its_hardness_on_a_homogeneous_body_takes_few_products() {
    let bare = || problem([1.0, 0.1], paraboloid, RIGID);
    assert_work(
        &bare,
        Load::Force(2e-3),
        &[(0.9, [21, 8, 7]), (0.05, [35, 25, 31])],
    );
    let some = [(0.9, [13, 3, 10]), (0.5, [15, 3, 13]), (0.05, [20, 3, 20])];
    assert_work(&bare, Load::Penetration(0.01), &some);
}

#[test]
fn a_contact_at_its_hardness_on_springs_takes_few_products() {
    let springs = |x: f64, _: f64| if x < 0.0 { 0.3 } else { 0.0 };
    let on_springs = || problem([0.1, 0.02], paraboloid, springs);
    assert_work(&on_springs, Load::Force(2e-3), &[(0.5, [30, 3, 19])]);
    let some = [(0.9, [14, 19, 13]), (0.2, [19, 3, 19])];
    assert_work(&on_springs, Load::Penetration(0.01), &some);
}

#[test]
fn a_contact_at_its_hardness_under_a_stiff_coating_takes_few_products() {
    let plate = || problem([1000.0, 0.01], |x, y| pillars(x, y, 0.002), RIGID);
    assert_work(&plate, Load::Force(2e-3), &[(0.9, [16, 3, 5])]);
    let some = [(0.9, [15, 3, 7]), (0.05, [49, 3, 48])];
    assert_work(&plate, Load::Penetration(0.01), &some);
}

#[test]
fn both_methods_agree_and_the_stiffness_is_that_of_the_free_elements() {
    let load = Load::Penetration(0.01);
    let bare = || problem([1.0, 0.1], paraboloid, RIGID);
    let peak = elastic_peak(&mut bare(), load);
    let mut cut = bare().with_hardness(0.6 * peak).unwrap();
    let (one, _) = solved(&mut GradientSolver::default(), &mut cut, load, &COLD);
    let (other, _) = solved(&mut ActiveSetSolver::default(), &mut cut, load, &COLD);
    for (p, q) in one.pressure.iter().zip(&other.pressure) {
        assert!((p - q).abs() < 1e-5 * peak, "{p} {q}");
    }
    // dQ/dD by a difference that leaves the sets unchanged: both are solved to 1e-8 of D.
    let step = 1e-5;
    let force = |cut: &mut DiscreteProblem, depth: f64| {
        let load = Load::Penetration(depth);
        let mut solver = ActiveSetSolver::default();
        solved(&mut solver, cut, load, &one.pressure).1.force
    };
    let difference = force(&mut cut, 0.01 + step) - force(&mut cut, 0.01 - step);
    let slope = difference / (2.0 * step);
    for found in [&one, &other] {
        let stiffness = found.contact_stiffness.unwrap();
        assert!(
            (stiffness / slope - 1.0).abs() < 1e-3,
            "{stiffness} {slope}"
        );
    }
}

#[test]
fn a_force_beyond_the_capacity_of_all_that_can_touch_is_refused() {
    let end = |x: f64, y: f64| if x.hypot(y) < 0.3 { 0.0 } else { f64::INFINITY };
    let mut punch = problem([1.0, 0.1], end, RIGID).with_hardness(0.5).unwrap();
    let count = punch.initial_gap().iter().filter(|g0| **g0 == 0.0).count();
    let most = 0.5 * count as f64 / (SIZE * SIZE) as f64;
    let (found, _) = solved(
        &mut GradientSolver::default(),
        &mut punch,
        Load::Force(most),
        &COLD,
    );
    assert_eq!(found.pressure.iter().filter(|p| **p == 0.5).count(), count);
    let refused = GradientSolver::default().solve(
        &mut punch,
        Load::Force(1.001 * most),
        &COLD,
        &mut Watch::alone(&mut ()),
    );
    let Err(ContactError::BeyondHardness {
        force,
        most: found,
        area,
        ..
    }) = refused
    else {
        panic!("{refused:?}")
    };
    assert_eq!((force, found, area), (1.001 * most, most, 2.0 * most));
}

#[test]
fn exchanges_out_of_products_end_at_an_admissible_pressure() {
    let load = Load::Force(2e-3);
    let bare = || problem([1.0, 0.1], paraboloid, RIGID);
    let limit = 0.2 * elastic_peak(&mut bare(), load);
    let mut cut = bare().with_hardness(limit).unwrap();
    for max_applications in [5, 12] {
        let options = SolverOptions {
            max_applications,
            ..SolverOptions::default()
        };
        let mut solver = GradientSolver::new(options);
        let found = solver.solve(&mut cut, load, &COLD, &mut Watch::alone(&mut ()));
        let found = found.unwrap();
        // A step takes one or two products, an exchange two.
        let applications = found.operator_applications;
        assert!((max_applications..=max_applications + 4).contains(&applications));
        assert!(found.pressure.iter().all(|p| (0.0..=limit).contains(p)));
        assert_eq!(solver.options.max_applications, max_applications);
    }
}
