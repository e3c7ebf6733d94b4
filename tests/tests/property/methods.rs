//! Two methods that share no step: projected gradients, and an active set on the dense system.

use pellicle_contact::{
    ActiveSetSolver, GradientSolver, Iterate, Method, Solution, Solver, SolverOptions, Watch,
};
use pellicle_tests::paper::figure_2;
use pellicle_tests::scene::largest_difference;

fn options(tolerance: f64) -> SolverOptions {
    SolverOptions {
        tolerance,
        ..SolverOptions::default()
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
        let found = largest_difference(&by_gradient.pressure, |e| by_active_set.pressure[e]);
        assert!(found < 1e-8, "{}: {found:e}", panel.name);
    }
}
