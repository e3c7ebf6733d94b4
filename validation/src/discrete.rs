//! The same problem on the same small grid, solved by other programs.

use std::sync::Arc;

use pellicle_contact::{
    DiscreteProblem, GradientSolver, Load, Solution, Solver, SolverOptions, Watch,
};
use pellicle_influence::{CoefficientTable, SurfaceElasticity};
use pellicle_kernel::{Foundation, Material};
use rayon::prelude::*;

use crate::comparison::Comparison;
use crate::data::contact::{DiscreteContact, DiscreteProfile, Given, discrete};
use crate::run::{ValidationError, ValidationRun};
use crate::section::ValidationSection;

/// The section.
pub const SECTION: ValidationSection = ValidationSection {
    name: "The same grid problem",
    source: "tests/data/discrete_contact.json: conjugate gradients and a dense active set, which agree to 1e-12",
    because: "largest error of any pressure, over the peak, of force and of penetration; the tolerance of the \
              solution, 1e-12, times the condition of the system",
    rows,
};

/// Tolerance of the certificate: far below the tolerance of the comparison.
const CERTIFIED: f64 = 1e-12;
/// `CERTIFIED` times a condition number of about 1e2.
const COMPARED: f64 = 1e-10;

fn rows(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let cases = discrete()?;
    Ok(cases.par_iter().map(|case| row(run, case)).collect())
}

fn row(run: ValidationRun, case: &DiscreteContact) -> Comparison {
    let profile = match case.profile {
        DiscreteProfile::Paraboloid => "paraboloid",
        DiscreteProfile::Wavy => "waves",
    };
    let given = match case.given {
        Given::Force => "by force",
        Given::Penetration => "by depth",
    };
    let (size, chi, thickness) = (case.size, case.e1 / case.e2, case.thickness);
    let check = format!("{profile}, {size} × {size}, χ = {chi}, H = {thickness}, {given}");
    match solve(run, case) {
        Ok(solution) => {
            let peak = solution.pressure.iter().copied().fold(0.0, f64::max);
            let error = error(case, &solution);
            Comparison::compare(check, [case.max_pressure, peak], error, COMPARED)
        }
        Err(error) => Comparison::failed(check, &error),
    }
}

/// Solves the grid problem from a cold start, with a certificate of 1e-12.
///
/// # Errors
/// Errors of the crates, and [`ValidationError::NotCertified`].
pub fn solve(run: ValidationRun, case: &DiscreteContact) -> Result<Solution, ValidationError> {
    let mut problem = problem(run, case)?;
    let load = match case.given {
        Given::Force => Load::Force(case.force),
        Given::Penetration => Load::Penetration(case.penetration),
    };
    let options = SolverOptions {
        tolerance: CERTIFIED,
        contact_stiffness: false,
        ..SolverOptions::default()
    };
    let start = vec![0.0; problem.elements()];
    let iterate = GradientSolver::new(options).solve(
        &mut problem,
        load,
        &start,
        &mut Watch::alone(&mut ()),
    )?;
    let solution = Solution::judge(&mut problem, load, iterate.pressure, CERTIFIED);
    let worst = solution.certificate.worst();
    if solution.certificate.is_satisfied() {
        Ok(solution)
    } else {
        Err(ValidationError::NotCertified { worst })
    }
}

fn problem(run: ValidationRun, case: &DiscreteContact) -> Result<DiscreteProblem, ValidationError> {
    let coating = Material::new(case.e1, case.nu1)?;
    let substrate = Material::new(case.e2, case.nu2)?;
    let foundation = Foundation::coated(case.thickness, coating, substrate)?;
    let side = 2.0 * case.half_side / case.size as f64;
    let centre = |i: usize| (i as f64 + 0.5) * side - case.half_side;
    let height = |e: usize| {
        let (x, y) = (centre(e / case.size), centre(e % case.size));
        case.profile.height(x, y)
    };
    let table = CoefficientTable::assemble(&run.tables(&foundation)?, side, case.size)?;
    let elasticity = Arc::new(SurfaceElasticity::new(Arc::new(table), foundation));
    let elements = case.size * case.size;
    let (springs, gap) = (vec![0.0; elements], (0..elements).map(height).collect());
    Ok(DiscreteProblem::elastic(
        elasticity,
        case.size,
        springs,
        gap,
        side * side,
    )?)
}

/// The largest error of a pressure over the peak, of the force and of the penetration; infinite if different elements
/// are in contact.
fn error(case: &DiscreteContact, solution: &Solution) -> f64 {
    let touching = solution.pressure.iter().filter(|p| **p > 0.0).count();
    if touching != case.contact_elements {
        return f64::INFINITY;
    }
    let relative = |found: f64, wanted: f64| (found / wanted - 1.0).abs();
    let start =
        relative(solution.force, case.force).max(relative(solution.penetration, case.penetration));
    let row = case.size / 2 * case.size;
    let on_row = case.pressure_row.iter().zip(&solution.pressure[row..]);
    let diagonal = solution.pressure.iter().step_by(case.size + 1);
    let on_diagonal = case.pressure_diagonal.iter().zip(diagonal);
    let everywhere = case.pressure.iter().flatten().zip(&solution.pressure);
    let all = on_row.chain(on_diagonal).chain(everywhere);
    let errors = all.map(|(wanted, found)| (found - wanted.0).abs() / case.max_pressure);
    errors.fold(start, f64::max)
}
