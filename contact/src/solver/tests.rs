//! Small problems of every kind: units, starts and counts of products, and the agreement of both solvers.

mod work;

use std::sync::{
    Arc,
    atomic::{AtomicUsize, Ordering},
};

use pellicle_influence::{CoefficientTable, ElasticOperator, RadialTables, SurfaceElasticity};
use pellicle_kernel::{Foundation, Material};

use crate::{
    ActiveSetSolver, DiscreteProblem, GradientSolver, Iterate, Load, Solution, Solver,
    SolverOptions, Watch,
};

pub(in crate::solver) const SIZE: usize = 32;

/// Factors on lengths and moduli.
const UNSCALED: [f64; 2] = [1.0; 2];

/// `SIZE`² elements of a square of side 1, on a coating of relative stiffness `stiffness` and `thickness` on a body.
pub(in crate::solver) fn problem(
    coating: [f64; 2],
    gap: impl Fn(f64, f64) -> f64,
    eta: impl Fn(f64, f64) -> f64,
) -> DiscreteProblem {
    problem_in(UNSCALED, coating, gap, eta)
}

/// The same in other units of length and modulus.
fn problem_in(
    [length, modulus]: [f64; 2],
    [stiffness, thickness]: [f64; 2],
    gap: impl Fn(f64, f64) -> f64,
    eta: impl Fn(f64, f64) -> f64,
) -> DiscreteProblem {
    let [coating, base] = [stiffness, 1.0].map(|e| Material::new(modulus * e, 0.3).unwrap());
    let foundation = Foundation::coated(length * thickness, coating, base).unwrap();
    let tables = RadialTables::build(&foundation).unwrap();
    let side = 1.0 / SIZE as f64;
    let table = CoefficientTable::assemble(&tables, length * side, SIZE).unwrap();
    let elasticity = Arc::new(SurfaceElasticity::new(Arc::new(table), foundation));
    let centre = |i: usize| (i as f64 + 0.5) * side - 0.5;
    let sample = |f: &dyn Fn(f64, f64) -> f64, unit: f64| {
        let elements = 0..SIZE * SIZE;
        elements
            .map(|e| unit * f(centre(e / SIZE), centre(e % SIZE)))
            .collect()
    };
    let (eta, gap) = (sample(&eta, length / modulus), sample(&gap, length));
    let area = (length * side).powi(2);
    DiscreteProblem::elastic(elasticity, SIZE, eta, gap, area).unwrap()
}

pub(in crate::solver) fn paraboloid(x: f64, y: f64) -> f64 {
    f64::midpoint(x * x, y * y)
}

/// Cylinders of radius 0.05 with a period of 1/8, `depth` above the ground between them.
pub(in crate::solver) fn pillars(x: f64, y: f64, depth: f64) -> f64 {
    let off = |c: f64| c - (8.0 * c).round() / 8.0;
    paraboloid(x, y)
        + if off(x).hypot(off(y)) < 0.05 {
            0.0
        } else {
            depth
        }
}

fn solve(problem: &mut DiscreteProblem, load: Load, start: &[f64]) -> Iterate {
    let mut solver = GradientSolver::default();
    let iterate = solver
        .solve(problem, load, start, &mut Watch::alone(&mut ()))
        .unwrap();
    let judged = Solution::judge(problem, load, iterate.pressure.clone(), 1e-8);
    assert!(
        judged.certificate.is_satisfied(),
        "{:?}",
        judged.certificate
    );
    iterate
}

pub(in crate::solver) const RIGID: fn(f64, f64) -> f64 = |_, _| 0.0;

#[test]
fn no_threshold_depends_on_the_units() {
    let punch = |x: f64, y: f64| {
        let end = if x.hypot(y) < 0.3 { 0.0 } else { f64::INFINITY };
        pillars(x, y, 0.002) - paraboloid(x, y) + end
    };
    let springs = |x: f64, y: f64| {
        if pillars(x, y, 1.0) < 0.6 { 0.02 } else { 0.0 }
    };
    let solved = |units: [f64; 2], stiff: bool| {
        let [length, modulus] = units;
        let mut problem = if stiff {
            problem_in(units, [1000.0, 0.01], punch, RIGID)
        } else {
            problem_in(units, [0.1, 0.02], paraboloid, springs)
        };
        let load = Load::Force(1e-2 * modulus * length * length);
        let found = solve(&mut problem, load, &[0.0; SIZE * SIZE]);
        let stiffness = found.contact_stiffness.unwrap() / (modulus * length);
        let pressure: Vec<f64> = found.pressure.iter().map(|p| p / modulus).collect();
        (found.operator_applications, stiffness, pressure)
    };
    // Powers of two, which change no digit, up to values at which squares of lengths and pressures would still neither
    // under- nor overflow.
    for stiff in [false, true] {
        let unscaled = solved(UNSCALED, stiff);
        for exponents in [[-30, 40], [200, -100], [-300, 300]] {
            let units = exponents.map(|exponent| 2_f64.powi(exponent));
            assert!(solved(units, stiff) == unscaled, "{exponents:?}");
        }
    }
}

#[test]
fn a_solution_used_as_the_start_takes_no_iterations() {
    for stiffness in [1.0, 1000.0] {
        let mut problem = problem([stiffness, 0.02], paraboloid, RIGID);
        let first = solve(&mut problem, Load::Force(2e-3), &[0.0; SIZE * SIZE]);
        let again = solve(&mut problem, Load::Force(2e-3), &first.pressure);
        assert_eq!(again.operator_applications, 1, "{again:?}");
        assert_eq!(again.iterations, 0);
    }
}

#[test]
fn a_load_costs_the_same_after_another_as_alone() {
    for stiffness in [1.0, 1000.0] {
        let fresh = || problem([stiffness, 0.02], paraboloid, RIGID);
        let cold = [0.0; SIZE * SIZE];
        let alone = solve(&mut fresh(), Load::Force(2e-3), &cold);
        let mut used = fresh();
        solve(&mut used, Load::Penetration(0.03), &cold);
        let after = solve(&mut used, Load::Force(2e-3), &cold);
        // Storage and rows of the preconditioner are kept between loads, and may be better than new ones.
        assert!(
            after.operator_applications <= alone.operator_applications + 1,
            "{} {}",
            after.operator_applications,
            alone.operator_applications
        );
    }
}

#[test]
fn the_last_residual_is_below_the_tolerance_and_every_iteration_has_one() {
    let mut problem = problem([10.0, 0.05], paraboloid, RIGID);
    let found = solve(&mut problem, Load::Force(2e-3), &[0.0; SIZE * SIZE]);
    let (last, before) = found.residuals.split_last().unwrap();
    assert_eq!(found.iterations, before.len());
    assert!(*last <= 1e-8 && before.iter().all(|residual| *residual > 1e-9));
}

/// An operator that counts the products.
struct Counting {
    springs: f64,
    products: Arc<AtomicUsize>,
}

impl ElasticOperator for Counting {
    fn size(&self) -> usize {
        SIZE
    }

    /// Springs with smoothing: the displacement of an element also depends on its neighbours' pressures.
    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.products.fetch_add(1, Ordering::Relaxed);
        for (e, u) in displacement.iter_mut().enumerate() {
            let (i, j) = (e / SIZE, e % SIZE);
            let at = |i: usize, j: usize| pressure[i.min(SIZE - 1) * SIZE + j.min(SIZE - 1)];
            let around = [
                at(i + 1, j),
                at(i.saturating_sub(1), j),
                at(i, j + 1),
                at(i, j.saturating_sub(1)),
            ];
            *u = self.springs * (at(i, j) + around.iter().sum::<f64>() / 5.0);
        }
    }
}

#[test]
fn every_product_is_counted() {
    for load in [Load::Force(2e-3), Load::Penetration(0.01)] {
        let products = Arc::new(AtomicUsize::new(0));
        let operator = Counting {
            springs: 1.0,
            products: Arc::clone(&products),
        };
        let centre = |i: usize| (i as f64 + 0.5) / SIZE as f64 - 0.5;
        let gap = (0..SIZE * SIZE).map(|e| paraboloid(centre(e / SIZE), centre(e % SIZE)));
        let mut problem = DiscreteProblem::new(
            Box::new(operator),
            vec![0.0; SIZE * SIZE],
            gap.collect(),
            1.0 / (SIZE * SIZE) as f64,
        )
        .unwrap();
        let found = solve(&mut problem, load, &[0.0; SIZE * SIZE]);
        // One more for the certificate, and one for the problem's scale.
        let counted = found.operator_applications + found.stiffness_applications + 2;
        assert_eq!(products.load(Ordering::Relaxed), counted);
        // An unknown operator has no preconditioner.
        assert!(counted < 60, "{counted}");
    }
}

#[test]
fn both_solvers_agree_on_every_kind_of_problem() {
    let springs = |x: f64, y: f64| {
        if pillars(x, y, 1.0) < 0.6 { 0.02 } else { 0.0 }
    };
    for load in [Load::Force(1e-3), Load::Penetration(0.006)] {
        let problems = [
            problem([1.0, 0.1], paraboloid, RIGID),
            problem([0.1, 0.02], |x, y| pillars(x, y, 0.004), springs),
            problem([1000.0, 0.01], |x, y| pillars(x, y, 0.002), RIGID),
        ];
        for mut problem in problems {
            let by_gradient = solve(&mut problem, load, &[0.0; SIZE * SIZE]);
            // From a start that lacks most of the contact and includes some elements outside it.
            let mut start = vec![0.0; SIZE * SIZE];
            start[SIZE * SIZE / 2 + 3..][..20].fill(1.0);
            let found = ActiveSetSolver::default().solve(
                &mut problem,
                load,
                &start,
                &mut Watch::alone(&mut ()),
            );
            let found = found.unwrap();
            let (stiffness, dense) = (by_gradient.contact_stiffness, found.contact_stiffness);
            approx::assert_relative_eq!(stiffness.unwrap(), dense.unwrap(), max_relative = 5e-7);
            let by_active_set = found.pressure;
            let judged = Solution::judge(&mut problem, load, by_active_set.clone(), 1e-12);
            assert!(
                judged.certificate.is_satisfied(),
                "{:?}",
                judged.certificate
            );
            let peak = by_active_set.iter().copied().fold(0.0, f64::max);
            let pairs = by_gradient.pressure.iter().zip(&by_active_set);
            let difference = pairs.map(|(p, q)| (p - q).abs()).fold(0.0, f64::max);
            // The tolerance of 1e-8 times the condition number of the systems, about 1e3 under the stiff coating.
            assert!(difference < 1e-5 * peak, "{:e}", difference / peak);
        }
    }
}

#[test]
fn the_stiffness_of_a_punch_is_its_force_over_its_penetration() {
    let flat = |x: f64, y: f64| if x.hypot(y) < 0.3 { 0.0 } else { f64::INFINITY };
    for stiffness in [0.1, 30.0] {
        // Springs keep the whole face in contact.
        let mut problem = problem([stiffness, 0.05], flat, |_, _| 0.5);
        let load = Load::Penetration(0.01);
        let found = solve(&mut problem, load, &[0.0; SIZE * SIZE]);
        let force = found.pressure.iter().sum::<f64>() * problem.loaded_area();
        let wanted = force / 0.01;
        // The solution's tolerance is 1e-8.
        assert!((found.contact_stiffness.unwrap() / wanted - 1.0).abs() < 1e-7);
    }
}

#[test]
fn an_operator_in_its_own_units_is_solved_from_zero_pressure() {
    // Steel under a sphere of 1 mm, elements of 1 µm: pressures of 1e9 on displacements of 1e-8.
    let (side, depth) = (1e-6, 1e-8);
    let body = Foundation::half_space(Material::new(210e9, 0.3).unwrap());
    let tables = RadialTables::build(&body).unwrap();
    let table = CoefficientTable::assemble(&tables, side, SIZE).unwrap();
    let elasticity = Arc::new(SurfaceElasticity::new(Arc::new(table), body));
    let centre = |i: usize| (i as f64 + 0.5 - SIZE as f64 / 2.0) * side;
    let gap = (0..SIZE * SIZE).map(|e| paraboloid(centre(e / SIZE), centre(e % SIZE)) / 1e-3);
    let gap: Vec<f64> = gap.collect();
    let (nothing, area) = (vec![0.0; SIZE * SIZE], side * side);
    let operator = Box::new(elasticity.operator(SIZE));
    let mut unknown = DiscreteProblem::new(operator, nothing.clone(), gap.clone(), area).unwrap();
    let mut known = DiscreteProblem::elastic(elasticity, SIZE, nothing.clone(), gap, area).unwrap();
    let load = Load::Penetration(depth);
    let [one, other] = [&mut unknown, &mut known].map(|problem| solve(problem, load, &nothing));
    let [one, other] = [one, other].map(|found| found.contact_stiffness.unwrap());
    approx::assert_relative_eq!(one, other, max_relative = 1e-6);
    // Also from a pressure that is far too small.
    let almost: Vec<f64> = known
        .initial_gap()
        .iter()
        .map(|g0| f64::from(u8::from(*g0 < depth / 2.0)))
        .collect();
    let again = solve(&mut known, load, &almost).contact_stiffness.unwrap();
    approx::assert_relative_eq!(again, other, max_relative = 1e-6);
}

#[test]
fn a_solver_that_gives_up_returns_the_best_pressure_found() {
    let mut problem = problem([1.0, 0.01], |x, y| pillars(x, y, 0.002), RIGID);
    let mut worst_before = f64::INFINITY;
    for max_applications in [3, 5, 7] {
        let options = SolverOptions {
            max_applications,
            ..SolverOptions::default()
        };
        let load = Load::Force(1e-2);
        let start = [0.0; SIZE * SIZE];
        let found = GradientSolver::new(options).solve(
            &mut problem,
            load,
            &start,
            &mut Watch::alone(&mut ()),
        );
        let found = found.unwrap();
        // A step takes one or two products.
        assert!(found.operator_applications <= max_applications + 1);
        assert!(found.contact_stiffness.is_none());
        let judged = Solution::judge(&mut problem, load, found.pressure, 1e-8);
        let worst = judged.certificate.worst();
        let least = found
            .residuals
            .iter()
            .copied()
            .fold(f64::INFINITY, f64::min);
        // The best is kept to within a factor of two.
        assert!(worst <= 2.001 * least, "{worst:e} {least:e}");
        assert!(!judged.certificate.is_satisfied());
        assert!(worst <= 2.001 * worst_before, "{worst:e} {worst_before:e}");
        worst_before = worst;
    }
}

#[test]
fn only_tolerances_above_zero_and_up_to_a_tenth_are_accepted() {
    let checked = |tolerance| {
        let options = SolverOptions {
            tolerance,
            ..SolverOptions::default()
        };
        options.checked_for(SIZE).is_ok()
    };
    assert!([1e-300, 1e-8, 0.1].into_iter().all(checked));
    assert!(
        ![0.0, -1e-8, 0.11, f64::NAN, f64::INFINITY]
            .into_iter()
            .any(checked)
    );
}
