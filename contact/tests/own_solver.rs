//! A solver written outside the crate: the paper's procedure, which drops elements in tension and takes none back.
//!
//! Stepanov and Torskaya (2022) solve the linear system of all elements that may touch, drop those with negative
//! pressure, and repeat until there are none. The gaps are never checked. If the first systems put elements of the
//! contact in tension, as under a stiff coating or on a relief of islands, the procedure ends with an indenter that
//! overlaps the surface, and the certificate shows it.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use pellicle_contact::{
    ActiveSetSolver, ContactError, DiscreteProblem, GradientSolver, Iterate, Load, Solution,
    Solver, Watch,
};
use pellicle_influence::{CoefficientTable, RadialTables, SurfaceElasticity};
use pellicle_kernel::{Foundation, Material};

/// Elements per side of a square of side 1.
const SIZE: usize = 16;
const SIDE: f64 = 1.0 / SIZE as f64;
const ELEMENTS: usize = SIZE * SIZE;

/// The procedure of the paper, using only the public interface.
struct DropOnly;

impl Solver for DropOnly {
    fn solve(
        &mut self,
        problem: &mut DiscreteProblem,
        load: Load,
        _: &[f64],
        watch: &mut Watch<'_>,
    ) -> Result<Iterate, ContactError> {
        let area = problem.loaded_area();
        let matrix = matrix(problem);
        let gap = DVector::from_column_slice(problem.initial_gap());
        let mut members: Vec<usize> = (0..ELEMENTS).collect();
        let (mut dropped, mut iteration) = (ELEMENTS, 0);
        loop {
            watch.tell(SIZE, iteration, f64::INFINITY, [members.len(), dropped])?;
            // (K + η) a = 1, (K + η) b = g0 on the members; p = D a − b, under a force D = (Σ p + Σ b)/Σ a
            let factor = matrix
                .select_rows(&members)
                .select_columns(&members)
                .cholesky()
                .unwrap();
            let a = factor.solve(&DVector::repeat(members.len(), 1.0));
            let b = factor.solve(&gap.select_rows(&members));
            let penetration = match load {
                Load::Force(force) => (force / area + b.sum()) / a.sum(),
                Load::Penetration(penetration) => penetration,
            };
            let pressure = &a * penetration - &b;
            let pulls: Vec<bool> = pressure.iter().map(|p| *p < 0.0).collect();
            dropped = pulls.iter().filter(|pulls| **pulls).count();
            if dropped == 0 {
                let mut field = vec![0.0; ELEMENTS];
                for (member, p) in members.iter().zip(&pressure) {
                    field[*member] = *p;
                }
                return Ok(Iterate {
                    iterations: iteration,
                    ..Iterate::of(field)
                });
            }
            let mut pulls = pulls.into_iter();
            members.retain(|_| !pulls.next().unwrap());
            iteration += 1;
        }
    }
}

/// The matrix `K + η`, one column for each unit pressure.
fn matrix(problem: &mut DiscreteProblem) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(ELEMENTS, ELEMENTS);
    for element in 0..ELEMENTS {
        let mut unit = vec![0.0; ELEMENTS];
        unit[element] = 1.0;
        problem.deform_into(&unit, matrix.column_mut(element).as_mut_slice());
    }
    matrix
}

/// An indenter over a body of modulus 1, or over a coating of modulus `coating` and thickness 0.05 on it.
fn problem(coating: f64, height: impl Fn(f64, f64) -> f64) -> DiscreteProblem {
    let material = |modulus| Material::new(modulus, 0.3).unwrap();
    let body = Foundation::coated(0.05, material(coating), material(1.0)).unwrap();
    let table = CoefficientTable::assemble(&RadialTables::build(&body).unwrap(), SIDE, SIZE);
    let elasticity = Arc::new(SurfaceElasticity::new(Arc::new(table.unwrap()), body));
    let centre = |i: usize| (i as f64 + 0.5) * SIDE - 0.5;
    let gap = (0..ELEMENTS).map(|e| height(centre(e / SIZE), centre(e % SIZE)));
    let springs = vec![0.0; ELEMENTS];
    DiscreteProblem::elastic(elasticity, SIZE, springs, gap.collect(), SIDE * SIDE).unwrap()
}

fn paraboloid(x: f64, y: f64) -> f64 {
    f64::midpoint(x * x, y * y)
}

fn waved(x: f64, y: f64) -> f64 {
    paraboloid(x, y) + 0.002 * (1.0 - (23.0 * x + 0.3).cos() * (19.0 * y - 0.2).cos())
}

fn solve(solver: &mut dyn Solver, problem: &mut DiscreteProblem) -> Solution {
    let load = Load::Force(2e-2);
    let start = vec![0.0; ELEMENTS];
    let iterate = solver.solve(problem, load, &start, &mut Watch::alone(&mut ()));
    Solution::judge(problem, load, iterate.unwrap().pressure, 1e-8)
}

#[test]
fn on_a_homogeneous_body_it_agrees_with_the_other_solvers() {
    let mut problem = problem(1.0, paraboloid);
    let own = solve(&mut DropOnly, &mut problem);
    assert!(own.certificate.is_satisfied(), "{:?}", own.certificate);
    for solver in [
        &mut GradientSolver::default() as &mut dyn Solver,
        &mut ActiveSetSolver::default(),
    ] {
        let other = solve(solver, &mut problem);
        // The certificate's tolerance.
        approx::assert_relative_eq!(own.penetration, other.penetration, max_relative = 1e-8);
    }
}

#[test]
fn under_a_stiff_coating_it_ends_with_an_overlap_and_the_certificate_shows_it() {
    let mut problem = problem(30.0, waved);
    let own = solve(&mut DropOnly, &mut problem);
    assert!(!own.certificate.is_satisfied());
    assert!(own.certificate.overlap > 1e-4, "{:?}", own.certificate);
    let other = solve(&mut GradientSolver::default(), &mut problem);
    assert!(other.certificate.is_satisfied(), "{:?}", other.certificate);
}

#[test]
fn a_solver_given_another_problem_discards_the_previous_one() {
    let mut solver = GradientSolver::default();
    for coating in [30.0, 1.0, 30.0] {
        let kept = solve(&mut solver, &mut problem(coating, waved));
        let fresh = solve(&mut GradientSolver::default(), &mut problem(coating, waved));
        assert_eq!(kept, fresh);
    }
}
