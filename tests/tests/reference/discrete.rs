//! The same grid problem solved by two others, to ten digits (`tests/data/discrete_contact.json`).

use std::sync::Arc;

use pellicle_cli::validation::data::contact::{DiscreteContact, Given, discrete};
use pellicle_contact::{
    DiscreteProblem, GradientSolver, Load, Solution, Solver, SolverOptions, Watch,
};
use pellicle_influence::{CoefficientTable, RadialTables, SurfaceElasticity};
use pellicle_tests::scene::{coated, material};

/// The grids' problems are solved far below the digits compared.
const TOLERANCE: f64 = 1e-12;
/// The tolerance times the condition of the systems, some 1e2.
const TEN_DIGITS: f64 = 1e-10;

fn problem(case: &DiscreteContact, perturbation: f64) -> DiscreteProblem {
    let (coating, substrate) = (material(case.e1, case.nu1), material(case.e2, case.nu2));
    let foundation = coated(case.thickness, coating, substrate);
    let tables = RadialTables::build(&foundation).expect("tables");
    let side = 2.0 * case.half_side / case.size as f64;
    let centre = |i: usize| (i as f64 + 0.5) * side - case.half_side;
    let height = |e: usize| {
        case.surface
            .height(centre(e / case.size), centre(e % case.size))
    };
    let elements = case.size * case.size;
    let tables = tables.perturbed(perturbation);
    let table = CoefficientTable::assemble(&tables, side, case.size).expect("finite");
    let elasticity = Arc::new(SurfaceElasticity::new(Arc::new(table), foundation));
    let gap = (0..elements).map(height).collect();
    DiscreteProblem::elastic(elasticity, case.size, vec![0.0; elements], gap, side * side)
        .expect("a problem")
}

fn solve(case: &DiscreteContact, perturbation: f64) -> Solution {
    let mut problem = problem(case, perturbation);
    let load = match case.given {
        Given::Force => Load::Force(case.force),
        Given::Penetration => Load::Penetration(case.penetration),
    };
    let options = SolverOptions {
        tolerance: TOLERANCE,
        contact_stiffness: false,
        ..SolverOptions::default()
    };
    let mut watch = Watch {
        observer: &mut (),
        step: 0,
        steps: 1,
    };
    let start = vec![0.0; problem.elements()];
    let solver = GradientSolver { options };
    let iterate = solver.solve(&mut problem, load, &start, &mut watch);
    let pressure = iterate.expect("a solution").pressure;
    let solution = Solution::judge(&mut problem, load, pressure, TOLERANCE);
    let certificate = &solution.certificate;
    assert!(certificate.is_satisfied(), "{certificate:?}");
    solution
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
        let found = differences(&case, &solve(&case, 0.0));
        let (size, thickness) = (case.size, case.thickness);
        assert!(found.is_empty(), "{size}, H = {thickness}: {found:?}");
    }
}

#[test]
fn coefficients_wrong_by_a_billionth_give_other_solutions_in_every_case() {
    for case in discrete().expect("the data") {
        assert!(!differences(&case, &solve(&case, 1e-9)).is_empty());
    }
}
