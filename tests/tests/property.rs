//! What every solution must have in common: symmetry, one state for force and penetration, no memory of the path.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use pellicle_contact::{
    ActiveSetSolver, GradientSolver, Iterate, Load, Method, Solution, Solver, SolverOptions, Watch,
    solve_path,
};
use pellicle_contact::{Domain, Step};
use pellicle_tests::paper::{Panel, figure_2};

fn options(tolerance: f64) -> SolverOptions {
    SolverOptions {
        tolerance,
        ..SolverOptions::default()
    }
}

fn solve(panel: &Panel, elements: usize, loads: &[Load], tolerance: f64) -> Vec<Step> {
    let domain = Domain::Side(panel.side);
    let path = solve_path(
        &panel.model,
        domain,
        elements,
        loads,
        &options(tolerance),
        &mut (),
    )
    .unwrap();
    for step in &path.steps {
        assert!(
            step.solution.certificate.is_satisfied(),
            "{}: {:?}",
            panel.name,
            step.solution.certificate
        );
    }
    path.steps
}

/// Largest difference of two pressures over the largest pressure.
fn difference(one: &[f64], other: impl Fn(usize) -> f64) -> f64 {
    let peak = one.iter().copied().fold(0.0, f64::max);
    one.iter()
        .enumerate()
        .map(|(e, p)| (p - other(e)).abs())
        .fold(0.0, f64::max)
        / peak
}

/// Where a symmetry takes the element `(i, j)`, given the last index.
type Image = fn(usize, usize, usize) -> (usize, usize);

#[test]
fn textured_solutions_have_the_eight_symmetries_of_the_square() {
    let n = 64;
    for panel in figure_2() {
        let pressure = &solve(&panel, n, &[panel.load], 1e-10)[0].solution.pressure;
        let images: [Image; 8] = [
            |i, j, _| (i, j),
            |i, j, l| (l - i, j),
            |i, j, l| (i, l - j),
            |i, j, l| (l - i, l - j),
            |i, j, _| (j, i),
            |i, j, l| (l - j, i),
            |i, j, l| (j, l - i),
            |i, j, l| (l - j, l - i),
        ];
        for image in images {
            let at = |e: usize| {
                let (i, j) = image(e / n, e % n, n - 1);
                pressure[i * n + j]
            };
            // Gaps are closed to 1e-10 of the penetration; single pressures follow to some 1e2 of that.
            assert!(
                difference(pressure, at) < 1e-7,
                "{}: {:e}",
                panel.name,
                difference(pressure, at)
            );
        }
    }
}

#[test]
fn unloading_returns_through_the_states_of_loading() {
    let [panel, ..] = figure_2();
    let forces = [0.2, 0.6, 1.0, 0.6, 0.2].map(|part| Load::Force(part * 0.3571e-4));
    let steps = solve(&panel, 64, &forces, 1e-10);
    for (up, down) in [(0, 4), (1, 3)] {
        let (up, down) = (&steps[up].solution, &steps[down].solution);
        approx::assert_relative_eq!(up.penetration, down.penetration, max_relative = 1e-9);
        assert!(difference(&up.pressure, |e| down.pressure[e]) < 1e-7);
    }
}

#[test]
fn the_penetration_of_a_force_gives_that_force_back() {
    for panel in figure_2() {
        let [ref by_force] = solve(&panel, 64, &[panel.load], 1e-10)[..] else {
            panic!("one load, one step")
        };
        let load = Load::Penetration(by_force.solution.penetration);
        let [ref by_penetration] = solve(&panel, 64, &[load], 1e-10)[..] else {
            panic!("one load, one step")
        };
        // Gaps are closed to 1e-10 of the penetration, and the force is at most some ten times stiffer.
        approx::assert_relative_eq!(
            by_penetration.solution.force,
            by_force.solution.force,
            max_relative = 1e-8
        );
    }
}

#[test]
fn the_dense_active_set_and_the_gradient_method_agree_on_the_textured_cases() {
    let n = 48;
    for panel in figure_2() {
        let sampled = panel.model.sample(panel.side, n).unwrap();
        let mut problem = panel.model.discretize(&sampled).unwrap().value;
        let mut solve = |solver: &dyn Solver| {
            let mut watch = Watch {
                observer: &mut (),
                step: 0,
                steps: 1,
            };
            let Iterate { pressure, .. } = solver
                .solve(&mut problem, panel.load, &vec![0.0; n * n], &mut watch)
                .unwrap();
            Solution::judge(&mut problem, panel.load, pressure, 1e-11)
        };
        let by_gradient = solve(&GradientSolver {
            options: options(1e-11),
        });
        let by_active_set = solve(&ActiveSetSolver {
            options: SolverOptions {
                method: Method::ActiveSet,
                ..options(1e-11)
            },
        });
        for solution in [&by_gradient, &by_active_set] {
            assert!(
                solution.certificate.is_satisfied(),
                "{}: {:?}",
                panel.name,
                solution.certificate
            );
        }
        approx::assert_relative_eq!(
            by_gradient.penetration,
            by_active_set.penetration,
            max_relative = 1e-10
        );
        // The tolerance times the condition of the systems, some 1e2 to 1e3.
        let found = difference(&by_gradient.pressure, |e| by_active_set.pressure[e]);
        assert!(found < 1e-8, "{}: {found:e}", panel.name);
    }
}
