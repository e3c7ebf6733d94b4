//! Against contact solutions of others to many digits: the same grid problem to 1e-10, the continuum with its order.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::sync::Arc;

use pellicle_contact::{
    Cone, DiscreteProblem, Domain, GradientSolver, Indenter, Load, Model, Paraboloid, Solution,
    Solver, SolverOptions, Watch, solve_path,
};
use pellicle_influence::{Cache, CoefficientTable, RadialTables, SurfaceElasticity};
use pellicle_kernel::{Foundation, Material};
use pellicle_tests::convergence::{GRIDS, observed_order};
use pellicle_tests::reference_data::{
    AxisymmetricContact, DiscreteContact, axisymmetric_contacts, discrete_contacts, number,
};
use pellicle_texture::Relief;

/// The grids' problems are solved far below the digits compared.
const OPTIONS: SolverOptions = SolverOptions {
    tolerance: 1e-12,
    ..SolverOptions {
        tolerance: 0.0,
        method: pellicle_contact::Method::Gradient,
        max_applications: 2000,
        contact_stiffness: false,
    }
};

fn foundation(e1: f64, nu1: f64, e2: f64, nu2: f64, thickness: f64) -> Foundation {
    Foundation::coated(
        thickness,
        Material::new(e1, nu1).unwrap(),
        Material::new(e2, nu2).unwrap(),
    )
    .unwrap()
}

fn surface(case: &DiscreteContact, x: f64, y: f64) -> f64 {
    match case.surface.as_str() {
        "paraboloid" => f64::midpoint(x * x, y * y),
        _ => {
            0.1 * (x * x + 0.5 * y * y)
                + 0.02 * (1.0 - (7.0 * x + 0.3).cos() * (5.0 * y - 0.2).cos())
        }
    }
}

fn solve_discrete(case: &DiscreteContact) -> Solution {
    let foundation = foundation(case.e1, case.nu1, case.e2, case.nu2, case.thickness);
    let tables = RadialTables::build(&foundation).unwrap();
    let side = 2.0 * case.half_side / case.size as f64;
    let centre = |i: usize| (i as f64 + 0.5) * side - case.half_side;
    let table = CoefficientTable::assemble(&tables, side, case.size).unwrap();
    let elements = case.size * case.size;
    let gap = (0..elements)
        .map(|e| surface(case, centre(e / case.size), centre(e % case.size)))
        .collect();
    let elasticity = Arc::new(SurfaceElasticity::new(Arc::new(table), foundation));
    let springs = vec![0.0; elements];
    let mut problem =
        DiscreteProblem::elastic(elasticity, case.size, springs, gap, side * side).unwrap();
    let load = if case.given == "P" {
        Load::Force(number(&case.load))
    } else {
        Load::Penetration(number(&case.delta))
    };
    let mut watch = Watch {
        observer: &mut (),
        step: 0,
        steps: 1,
    };
    let solver = GradientSolver { options: OPTIONS };
    let iterate = solver
        .solve(&mut problem, load, &vec![0.0; elements], &mut watch)
        .unwrap();
    Solution::judge(&mut problem, load, iterate.pressure, OPTIONS.tolerance)
}

#[test]
fn the_same_grid_problem_has_the_same_solution_to_ten_digits() {
    for case in discrete_contacts() {
        let solution = solve_discrete(&case);
        let name = format!(
            "{} on {} elements, H = {}",
            case.surface, case.size, case.thickness
        );
        assert!(
            solution.certificate.is_satisfied(),
            "{name}: {:?}",
            solution.certificate
        );
        let close = |found: f64, wanted: f64, scale: f64, what: &str| {
            assert!(
                (found - wanted).abs() <= 1e-10 * scale,
                "{name}: {what} {found}, wanted {wanted}"
            );
        };
        let peak = number(&case.pmax);
        close(
            solution.force,
            number(&case.load),
            number(&case.load),
            "load",
        );
        close(
            solution.penetration,
            number(&case.delta),
            number(&case.delta),
            "approach",
        );
        assert_eq!(
            solution.pressure.iter().filter(|p| **p > 0.0).count(),
            case.n_contact,
            "{name}"
        );
        for (j, wanted) in case.pressure_row.iter().enumerate() {
            close(
                solution.pressure[case.size / 2 * case.size + j],
                number(wanted),
                peak,
                "pressure of the middle row",
            );
        }
        for (i, wanted) in case.pressure_diag.iter().enumerate() {
            close(
                solution.pressure[i * case.size + i],
                number(wanted),
                peak,
                "pressure of the diagonal",
            );
        }
        for (e, wanted) in case.pressure.iter().flatten().enumerate() {
            close(solution.pressure[e], number(wanted), peak, "pressure");
        }
    }
}

/// Relative error of the penetration under the reference's load on `elements` per side of a square of side 2.4.
fn penetration_error(case: &AxisymmetricContact, elements: usize) -> f64 {
    let foundation = foundation(
        number(&case.e1),
        number(&case.nu1),
        1.0,
        number(&case.nu2),
        number(&case.thickness),
    );
    let indenter = if case.shape.starts_with("cone") {
        // z = r: 45 degrees between axis and side.
        Indenter::Cone(Cone::new(std::f64::consts::FRAC_PI_4, 0.0).unwrap())
    } else {
        Indenter::Paraboloid(Paraboloid::new(1.0).unwrap())
    };
    let model = Model {
        tables: Arc::new(RadialTables::build(&foundation).unwrap()),
        relief: Relief::Bare,
        indenter,
        cache: Cache::none(),
    };
    let load = Load::Force(number(&case.load));
    let path = solve_path(
        &model,
        Domain::Side(SIDE),
        elements,
        &[load],
        &SolverOptions::default(),
        &mut (),
    )
    .unwrap();
    let solution = &path.steps[0].solution;
    assert!(
        solution.certificate.is_satisfied(),
        "{:?}",
        solution.certificate
    );
    (solution.penetration - number(&case.delta)).abs() / number(&case.delta)
}

/// Side of the domain, in contact radii.
const SIDE: f64 = 2.4;

/// The observed order and the error on the finest grid, over the grids whose elements are at most half as large as
/// the coating is thick.
fn convergence(case: &AxisymmetricContact) -> (f64, f64) {
    let fine = |elements: &usize| SIDE / *elements as f64 <= number(&case.thickness) / 2.0;
    let grids = GRIDS.into_iter().filter(fine);
    let errors: Vec<_> = grids
        .map(|elements| (elements, penetration_error(case, elements)))
        .collect();
    (observed_order(&errors), errors[errors.len() - 1].1)
}

#[test]
fn paraboloids_on_coatings_approach_the_continuum_with_order_two() {
    for case in axisymmetric_contacts()
        .iter()
        .filter(|case| case.shape.starts_with("paraboloid"))
    {
        let (order, last) = convergence(case);
        assert!(order > 1.7, "{case:?}: order {order}");
        assert!(last < 1e-5, "{case:?}: {last}");
    }
}

#[test]
fn cones_on_coatings_approach_the_continuum_with_order_two() {
    for case in axisymmetric_contacts()
        .iter()
        .filter(|case| case.shape.starts_with("cone"))
    {
        let (order, last) = convergence(case);
        assert!(order > 1.7, "{case:?}: order {order}");
        assert!(last < 1e-5, "{case:?}: {last}");
    }
}
