//! The same grid problem solved by two others, to ten digits (`tests/data/discrete_contact.json`).

use pellicle_cli::validation::Scene;
use pellicle_cli::validation::data::contact::{DiscreteContact, discrete};
use pellicle_cli::validation::discrete::solve;
use pellicle_contact::Solution;

/// The tolerance of the solutions, 1e-12, times the condition of the systems, some 1e2.
const TEN_DIGITS: f64 = 1e-10;

/// The solution with every coefficient wrong by so much, relatively.
fn solution(case: &DiscreteContact, perturbation: f64) -> Solution {
    solve(Scene { perturbation }, case).expect("a certified solution")
}

/// What differs from the case by more than ten digits: words, none if all is well.
fn differences(case: &DiscreteContact, solution: &Solution) -> Vec<String> {
    let mut found = Vec::new();
    let mut compare = |what: &str, computed: f64, wanted: f64, scale: f64| {
        let error = (computed - wanted).abs() / scale;
        if error.is_nan() || error > TEN_DIGITS {
            found.push(format!("{what}: {computed}, wanted {wanted}"));
        }
    };
    let (size, peak) = (case.size, case.max_pressure);
    compare("force", solution.force, case.force, case.force);
    let depth = case.penetration;
    compare("penetration", solution.penetration, depth, depth);
    let touching = solution.pressure.iter().filter(|p| **p > 0.0).count();
    compare(
        "elements in contact",
        touching as f64,
        case.contact_elements as f64,
        1.0,
    );
    for (j, wanted) in case.pressure_row.iter().enumerate() {
        let pressure = solution.pressure[size / 2 * size + j];
        compare("middle row", pressure, wanted.0, peak);
    }
    for (i, wanted) in case.pressure_diagonal.iter().enumerate() {
        compare("diagonal", solution.pressure[i * size + i], wanted.0, peak);
    }
    for (e, wanted) in case.pressure.iter().flatten().enumerate() {
        compare("pressure", solution.pressure[e], wanted.0, peak);
    }
    found
}

#[test]
fn the_same_grid_problem_has_the_same_solution_to_ten_digits() {
    for case in discrete().expect("the data") {
        let found = differences(&case, &solution(&case, 0.0));
        let (size, thickness) = (case.size, case.thickness);
        assert!(found.is_empty(), "{size}, H = {thickness}: {found:?}");
    }
}

#[test]
fn coefficients_wrong_by_a_billionth_give_other_solutions_in_every_case() {
    for case in discrete().expect("the data") {
        assert!(!differences(&case, &solution(&case, 1e-9)).is_empty());
    }
}
