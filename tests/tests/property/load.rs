//! A force and its penetration give the same state, and the state does not depend on the path to it.

use pellicle_contact::{Domain, Load, SolverOptions, Step, solve_path};
use pellicle_tests::scene::{Fig2Panel, figure_2, largest_difference};

fn options(tolerance: f64) -> SolverOptions {
    SolverOptions {
        tolerance,
        ..SolverOptions::default()
    }
}

/// The certified steps of a panel of Fig. 2.
pub fn solve(panel: &Fig2Panel, elements: usize, loads: &[Load], tolerance: f64) -> Vec<Step> {
    let (domain, options) = (Domain::Side(panel.side), options(tolerance));
    let path = solve_path(&panel.model, domain, elements, loads, &options, &mut ()).unwrap();
    for step in &path.steps {
        let (name, certificate) = (panel.name, &step.solution.certificate);
        assert!(certificate.is_satisfied(), "{name}: {certificate:?}");
    }
    path.steps
}

#[test]
fn unloading_returns_through_the_states_of_loading() {
    let [panel, ..] = figure_2();
    let forces = [0.2, 0.6, 1.0, 0.6, 0.2].map(|part| Load::Force(part * 0.3571e-4));
    let steps = solve(&panel, 64, &forces, 1e-10);
    for (up, down) in [(0, 4), (1, 3)] {
        let (up, down) = (&steps[up].solution, &steps[down].solution);
        approx::assert_relative_eq!(up.penetration, down.penetration, max_relative = 1e-9);
        assert!(largest_difference(&up.pressure, |e| down.pressure[e]) < 1e-7);
    }
}

#[test]
fn the_penetration_under_a_force_gives_the_same_force() {
    for panel in figure_2() {
        let [ref by_force] = solve(&panel, 64, &[panel.load], 1e-10)[..] else {
            panic!("one load, one step")
        };
        let load = Load::Penetration(by_force.solution.penetration);
        let [ref by_penetration] = solve(&panel, 64, &[load], 1e-10)[..] else {
            panic!("one load, one step")
        };
        // Gaps are closed to 1e-10 of the penetration, and the force is at most about ten times as sensitive.
        approx::assert_relative_eq!(
            by_penetration.solution.force,
            by_force.solution.force,
            max_relative = 1e-8
        );
    }
}
