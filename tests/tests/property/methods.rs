//! Two methods without common steps: projected gradients, and an active set on the dense system.

use pellicle_contact::{
    ActiveSetSolver, GradientSolver, Method, Model, Solution, Solver, SolverOptions, Watch,
};
use pellicle_tests::scene::{Fig2Panel, figure_2, largest_difference};

const TOLERANCE: f64 = 1e-11;

/// The tolerance times the condition number of the systems, about 1e2 to 1e3.
const SAME_PRESSURE: f64 = 1e-8;

fn options(method: Method) -> SolverOptions {
    SolverOptions {
        tolerance: TOLERANCE,
        method,
        ..SolverOptions::default()
    }
}

/// The certified solution on 48 elements per side, from a cold start.
fn solve(panel: &Fig2Panel, model: &Model, solver: &mut dyn Solver) -> Solution {
    let sampled = model.sample(panel.side, 48).unwrap();
    let mut problem = model.discretize(&sampled).unwrap().value;
    let start = vec![0.0; problem.elements()];
    let iterate = solver.solve(&mut problem, panel.load, &start, &mut Watch::alone(&mut ()));
    let solution = Solution::judge(
        &mut problem,
        panel.load,
        iterate.unwrap().pressure,
        TOLERANCE,
    );
    let (name, certificate) = (panel.name, &solution.certificate);
    assert!(certificate.is_satisfied(), "{name}: {certificate:?}");
    solution
}

fn by_gradient(panel: &Fig2Panel, model: &Model) -> Solution {
    let options = options(Method::Gradient);
    solve(panel, model, &mut GradientSolver::new(options))
}

fn by_active_set(panel: &Fig2Panel) -> Solution {
    let options = options(Method::ActiveSet);
    solve(panel, &panel.model, &mut ActiveSetSolver { options })
}

#[test]
fn the_dense_active_set_and_the_gradient_method_agree_on_the_textured_cases() {
    for panel in figure_2() {
        let (one, other) = (by_gradient(&panel, &panel.model), by_active_set(&panel));
        approx::assert_relative_eq!(one.penetration, other.penetration, max_relative = 1e-10);
        let found = largest_difference(&one.pressure, |e| other.pressure[e]);
        assert!(found < SAME_PRESSURE, "{}: {found:e}", panel.name);
    }
}

#[test]
fn the_methods_disagree_if_one_has_coefficients_wrong_by_a_millionth() {
    let [panel, ..] = figure_2();
    let wrong = Model {
        tables: panel.model.tables.perturbed(1e-6).into(),
        ..panel.model.clone()
    };
    let (one, other) = (by_gradient(&panel, &wrong), by_active_set(&panel));
    let found = largest_difference(&one.pressure, |e| other.pressure[e]);
    assert!(found > SAME_PRESSURE, "{found:e}");
}
