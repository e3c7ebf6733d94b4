//! The discrete problem, under either load and by either solver.

use std::f64::consts::PI;
use std::sync::Arc;

use pellicle_contact::{
    ActiveSetSolver, ContactError, DiscreteProblem, GradientSolver, Load, Solution, Solver,
    SolverOptions, Watch,
};
use pellicle_influence::{CoefficientTable, ElasticOperator, RadialTables, SurfaceElasticity};
use pellicle_kernel::Foundation;

use super::{SIDE, body};

fn elasticity(foundation: Foundation, size: usize) -> Arc<SurfaceElasticity> {
    let tables = RadialTables::build(&foundation).unwrap();
    let table = CoefficientTable::assemble(&tables, SIDE / size as f64, size).unwrap();
    Arc::new(SurfaceElasticity::new(Arc::new(table), foundation))
}

/// A field sampled at the centres of the elements.
fn sample(size: usize, of: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let centre = |i: usize| (i as f64 + 0.5) * SIDE / size as f64 - SIDE / 2.0;
    let elements = 0..size * size;
    elements
        .map(|e| of(centre(e / size), centre(e % size)))
        .collect()
}

/// A paraboloid with grooves.
fn grooved(x: f64, y: f64) -> f64 {
    f64::midpoint(x * x, y * y) + 0.004 * (23.0 * x + 5.0 * y).sin()
}

fn solve(solver: &mut impl Solver, problem: &mut DiscreteProblem, load: Load) -> Solution {
    let start = vec![0.0; problem.elements()];
    let iterate = solver
        .solve(problem, load, &start, &mut Watch::alone(&mut ()))
        .unwrap();
    let solution = Solution::judge(problem, load, iterate.pressure, 1e-8);
    let certificate = solution.certificate;
    assert!(certificate.is_satisfied(), "{certificate:?}");
    solution
}

/// The pressure under a penetration by Gauss–Seidel, each value cut to `0 ≤ p ≤ p_max`: slow, but based only on the
/// conditions themselves.
fn cut_gauss_seidel(
    elasticity: &SurfaceElasticity,
    eta: &[f64],
    gap: &[f64],
    [penetration, limit]: [f64; 2],
) -> Vec<f64> {
    let size = elasticity.size();
    let coefficient = |e: usize, f: usize| {
        elasticity.coefficient([(e / size).abs_diff(f / size), (e % size).abs_diff(f % size)])
    };
    let elements = size * size;
    let matrix: Vec<Vec<f64>> = (0..elements)
        .map(|e| (0..elements).map(|f| coefficient(e, f)).collect())
        .collect();
    let mut pressure = vec![0.0; elements];
    for _ in 0..100_000 {
        let mut change = 0.0_f64;
        for e in 0..elements {
            let u: f64 = matrix[e].iter().zip(&pressure).map(|(k, p)| k * p).sum();
            let g = u + eta[e] * pressure[e] + gap[e] - penetration;
            let next = (pressure[e] - g / (matrix[e][e] + eta[e])).clamp(0.0, limit);
            change = change.max((next - pressure[e]).abs());
            pressure[e] = next;
        }
        if change < 1e-13 * limit {
            return pressure;
        }
    }
    unreachable!("Gauss–Seidel does not converge")
}

#[test]
fn an_independent_method_finds_the_same_pressures_under_either_load() {
    let size = 14;
    for (coating, limit) in [
        (None, 0.05),
        (Some([10.0, 0.05]), 0.1),
        (Some([0.1, 0.1]), 0.01),
    ] {
        let elasticity = elasticity(body(coating), size);
        let own = elasticity.coefficient([0, 0]);
        for softness in [0.0, 0.5] {
            let eta = sample(size, |x, _| if x < 0.1 { softness * own } else { 0.0 });
            let gap = sample(size, grooved);
            let wanted = cut_gauss_seidel(&elasticity, &eta, &gap, [0.03, limit]);
            let at_limit = wanted.iter().filter(|p| **p >= limit).count();
            let free = wanted.iter().filter(|p| **p > 0.0 && **p < limit).count();
            assert!(
                at_limit >= 3 && free >= 3,
                "{at_limit} at the limit, {free} free"
            );
            let area = (SIDE / size as f64).powi(2);
            let mut problem = DiscreteProblem::elastic(elasticity.clone(), size, eta, gap, area)
                .unwrap()
                .with_hardness(limit)
                .unwrap();
            let force = area * wanted.iter().sum::<f64>();
            for load in [Load::Penetration(0.03), Load::Force(force)] {
                for found in [
                    solve(&mut GradientSolver::default(), &mut problem, load),
                    solve(&mut ActiveSetSolver::default(), &mut problem, load),
                ] {
                    for (found, wanted) in found.pressure.iter().zip(&wanted) {
                        // The certificate's 1e-8 of a penetration of several times the displacement at the limit.
                        assert!((found - wanted).abs() < 1e-6 * limit, "{found} {wanted}");
                    }
                    assert!((found.penetration - 0.03).abs() < 1e-8);
                    assert!((found.force / force - 1.0).abs() < 1e-7);
                }
            }
        }
    }
}

/// A rigid body.
struct Rigid(usize);

impl ElasticOperator for Rigid {
    fn size(&self) -> usize {
        self.0
    }

    fn apply_into(&mut self, _: &[f64], displacement: &mut [f64]) {
        displacement.fill(0.0);
    }
}

#[test]
fn on_springs_alone_the_penetration_is_linear_in_the_force() {
    // p = min((D − ρ²/2R)/η, p_max), so Q = π R (2 D p_max − η p_max²) from D = η p_max on.
    let (radius, eta, limit) = (1.0, 0.1, 0.2);
    let mut errors = Vec::new();
    for size in [32, 128] {
        let gap = sample(size, |x, y| f64::midpoint(x * x, y * y) / radius);
        let area = (SIDE / size as f64).powi(2);
        let springs = vec![eta; size * size];
        let mut problem = DiscreteProblem::new(Box::new(Rigid(size)), springs, gap.clone(), area)
            .unwrap()
            .with_hardness(limit)
            .unwrap();
        for penetration in [0.03, 0.1] {
            let solution = solve(
                &mut GradientSolver::default(),
                &mut problem,
                Load::Penetration(penetration),
            );
            for (p, g0) in solution.pressure.iter().zip(&gap) {
                let wanted = ((penetration - g0) / eta).clamp(0.0, limit);
                assert!((p - wanted).abs() < 1e-7 * limit, "{p} {wanted}");
            }
            let force = PI * radius * limit * (2.0 * penetration - eta * limit);
            let by_force = solve(
                &mut GradientSolver::default(),
                &mut problem,
                Load::Force(force),
            );
            errors.push((by_force.penetration / penetration - 1.0).abs());
        }
    }
    // Sums over the centres of elements: second order except for the kinks at the edges.
    assert!(
        errors[0] < 3e-3 && errors[2] < 3e-4 && errors[3] < 3e-4,
        "{errors:?}"
    );
}

#[test]
fn a_punch_sinks_no_more_than_necessary_if_every_element_is_at_the_limit() {
    let (size, limit) = (24, 0.03);
    let elasticity = elasticity(body(None), size);
    let gap = sample(
        size,
        |x, y| if x.hypot(y) < 0.3 { 0.0 } else { f64::INFINITY },
    );
    let count = gap.iter().filter(|gap| **gap == 0.0).count();
    let area = (SIDE / size as f64).powi(2);
    let mut problem = DiscreteProblem::elastic(elasticity, size, vec![0.0; size * size], gap, area)
        .unwrap()
        .with_hardness(limit)
        .unwrap();
    let most = limit * area * count as f64;
    let mut before = 0.0;
    for part in [0.5, 0.9, 0.99, 1.0] {
        let mut solver = GradientSolver::default();
        let solution = solve(&mut solver, &mut problem, Load::Force(part * most));
        assert!(solution.penetration > before, "{part}");
        before = solution.penetration;
        if part >= 1.0 {
            let pressed: Vec<f64> = solution
                .pressure
                .iter()
                .copied()
                .filter(|p| *p > 0.0)
                .collect();
            assert_eq!((pressed.len(), pressed), (count, vec![limit; count]));
            let mut v = vec![0.0; size * size];
            problem.deform_into(&solution.pressure, &mut v);
            let deepest = v.iter().copied().fold(0.0, f64::max);
            // two products of the same pressure on grids of different size
            assert!((solution.penetration / deepest - 1.0).abs() < 1e-12);
        }
    }
    let start = vec![0.0; size * size];
    let refused = GradientSolver::default().solve(
        &mut problem,
        Load::Force(1.001 * most),
        &start,
        &mut Watch::alone(&mut ()),
    );
    assert!(
        matches!(refused, Err(ContactError::BeyondHardness { .. })),
        "{refused:?}"
    );
}

#[test]
fn an_invalid_hardness_is_refused() {
    let elasticity = elasticity(body(None), 8);
    let problem = || {
        DiscreteProblem::elastic(elasticity.clone(), 8, vec![0.0; 64], vec![0.0; 64], 1.0).unwrap()
    };
    for hardness in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = problem().with_hardness(hardness).err();
        assert!(
            matches!(refused, Some(ContactError::Hardness { .. })),
            "{hardness}"
        );
    }
    for hardness in [0.0, -1.0, f64::NAN] {
        let options = SolverOptions {
            hardness,
            ..SolverOptions::default()
        };
        assert!(options.checked_for(8).is_err(), "{hardness}");
    }
}
