//! The parts of an exchange, on sixteen elements with the same displacement.

use pellicle_influence::ElasticOperator;

use super::*;
use crate::GradientSolver;

const LIMIT: f64 = 2.0;
const AREA: f64 = 0.25;

/// Displacement of all elements under 1 Pa on one of them, in m.
const SINKING: f64 = 0.125;

/// A body of 4 × 4 elements that moves only as a whole.
struct Raft;

impl ElasticOperator for Raft {
    fn size(&self) -> usize {
        4
    }

    fn apply_into(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        displacement.fill(SINKING * pressure.iter().sum::<f64>());
    }
}

/// Springs of compliance `eta` with this gap.
fn problem(eta: f64, gap: impl Fn(usize) -> f64) -> DiscreteProblem {
    let gap = (0..16).map(gap).collect();
    let problem = DiscreteProblem::new(Box::new(Raft), vec![eta; 16], gap, AREA).unwrap();
    problem.with_hardness(LIMIT).unwrap()
}

/// A field that begins with these values and is 0 on the other elements.
fn field(values: &[f64]) -> Vec<f64> {
    let others = std::iter::repeat_n(0.0, 16 - values.len());
    values.iter().copied().chain(others).collect()
}

/// The exchanges for a load, starting from a pressure that begins with these values.
fn begun(problem: &mut DiscreteProblem, load: Load, start: &[f64]) -> LimitExchange {
    LimitExchange::start(problem, load, &field(start), 1e-6)
}

fn held(exchange: &LimitExchange) -> Vec<usize> {
    let held = exchange.held.mask.iter().enumerate();
    held.filter_map(|(e, held)| held.then_some(e)).collect()
}

#[test]
fn elements_that_start_near_the_limit_are_held_and_the_rest_are_free() {
    let mut problem = problem(1.0, |e| if e == 3 { f64::INFINITY } else { 0.0 });
    let start = [1.91, 1.89, 5.0, 5.0, 0.5];
    let exchange = begun(&mut problem, Load::Penetration(1.0), &start);
    assert_eq!(held(&exchange), [0, 2]);
    assert_eq!(exchange.free, field(&[0.0, 1.89, 0.0, 5.0, 0.5]));
    assert_eq!(exchange.total.operator_applications, 0);
    // Far from a solution the accuracy is coarse, and never finer than the tolerance.
    assert_eq!(exchange.accuracy, COARSEST);
    let coarse = LimitExchange::start(&mut problem, Load::Penetration(1.0), &field(&[]), 0.05);
    assert_eq!(coarse.accuracy, 0.05);
}

#[test]
fn if_elements_at_the_limit_carry_the_whole_force_those_that_overlap_most_are_held() {
    // v = η p + g0 is smallest where the gap is, at the last of the pressed elements.
    let mut problem = problem(1.0, |e| -0.1 * e as f64);
    let force = |elements: f64| Load::Force(elements * LIMIT * AREA);
    let start = [4.0; 6];
    // Under the force of ten elements all six are held; under the force of four, four are held.
    let all = begun(&mut problem, force(10.0), &start);
    assert_eq!(held(&all), [0, 1, 2, 3, 4, 5]);
    let most = begun(&mut problem, force(4.0), &start);
    assert_eq!(held(&most), [2, 3, 4, 5]);
    // Never more than the force needs: of 1.9 elements one.
    let one = begun(&mut problem, force(1.9), &start);
    assert_eq!(held(&one), [5]);
    assert_eq!(
        [&all, &most, &one].map(|found| found.total.operator_applications),
        [0, 1, 1]
    );
}

#[test]
fn held_elements_take_one_product_and_leave_the_rest_of_the_force_and_of_the_work() {
    let mut problem = problem(1.0, |_| 0.0);
    let load = Load::Force(7.0 * LIMIT * AREA);
    let mut exchange = begun(&mut problem, load, &[LIMIT, LIMIT, 1.0]);
    exchange.press(&mut problem);
    exchange.press(&mut problem);
    assert_eq!(exchange.total.operator_applications, 1);
    assert_eq!(exchange.held.total, 2.0 * LIMIT);
    // Held elements cannot touch; the gap of the others grows by the displacement due to the held ones.
    let sunk = SINKING * 2.0 * LIMIT;
    let gaps = &exchange.held.gap;
    assert!(gaps[..2].iter().all(|gap| *gap == f64::INFINITY));
    assert!(gaps[2..].iter().all(|gap| *gap == sunk));
    // K p of the whole pressure: one product if that of the free part is unknown.
    let all = exchange.displacement(&mut problem, None);
    assert!(all.iter().all(|u| *u == sunk + SINKING));
    assert_eq!(exchange.total.operator_applications, 2);
    let all = exchange.displacement(&mut problem, Some(vec![1.0; 16]));
    assert!(all.iter().all(|u| *u == sunk + 1.0));
    exchange.total.operator_applications = 1;
    let rest = exchange.held.rest_of(load, problem.loaded_area());
    assert_eq!(rest, Load::Force(5.0 * LIMIT * AREA));
    let wanted = SolverOptions {
        tolerance: 1e-8,
        max_applications: 20,
        contact_stiffness: true,
        ..SolverOptions::default()
    };
    let options = exchange.options(wanted);
    assert_eq!(
        (options.tolerance, options.max_applications),
        (COARSEST, 19)
    );
    // The stiffness of an intermediate set is useless.
    assert!(!options.contact_stiffness);
    exchange.accuracy = 1e-8;
    assert!(exchange.options(wanted).contact_stiffness);
    exchange.total.operator_applications = 30;
    assert_eq!(exchange.options(wanted).max_applications, 0);
}

#[test]
fn the_work_of_all_problems_adds_up_and_the_last_solution_is_the_result() {
    let mut problem = problem(1.0, |_| 0.0);
    let mut exchange = begun(&mut problem, Load::Penetration(1.0), &[]);
    let iterate = |work: usize, pressure: f64| Iterate {
        iterations: work,
        operator_applications: 10 * work,
        stiffness_applications: 100 * work,
        residuals: vec![1.0; work],
        contact_stiffness: Some(pressure),
        penetration: 3.0 * pressure,
        reached_border: pressure > 0.6,
        ..Iterate::of(field(&[pressure]))
    };
    assert!(!exchange.take(iterate(2, 0.5)));
    assert!(exchange.take(iterate(3, 0.7)));
    let found = exchange.into_iterate(LIMIT);
    assert_eq!((found.iterations, found.operator_applications), (5, 50));
    assert_eq!(
        (found.stiffness_applications, found.residuals.len()),
        (500, 5)
    );
    assert_eq!(found.pressure, field(&[0.7]));
    assert_eq!(
        (found.contact_stiffness, found.penetration),
        (Some(0.7), 3.0 * 0.7)
    );
}

#[test]
fn the_penetration_is_the_mean_over_free_elements_or_the_least_admissible() {
    let mut problem = problem(1.0, |_| 0.0);
    let mut exchange = begun(&mut problem, Load::Penetration(9.0), &[5.0, 5.0]);
    exchange.free = field(&[0.0, 0.0, 1.0, 3.0]);
    let v = |first: &[f64]| -> Vec<f64> { field(first).iter().map(|v| v + 4.0).collect() };
    let values = v(&[-3.0, -2.0, 0.5, 0.9]);
    assert_eq!(exchange.penetration(&values), 9.0);
    exchange.load = Load::Force(1.0);
    // (1 · 4.5 + 3 · 4.9)/4
    assert!((exchange.penetration(&values) - 4.8).abs() < 1e-15);
    // If no free element presses, any value between the largest of the held and the smallest of the others would do.
    exchange.free = field(&[]);
    assert_eq!(exchange.penetration(&values), 2.0);
    // If a held element is higher than others, these others would overlap.
    assert_eq!(exchange.penetration(&v(&[-3.0, 1.0, -0.5])), 3.5);
}

#[test]
fn elements_above_the_limit_and_held_ones_with_a_gap_are_on_the_wrong_side() {
    let mut problem = problem(1.0, |_| 0.0);
    let depth = 4.0;
    let load = Load::Penetration(depth);
    let mut exchange = begun(&mut problem, load, &[5.0, 5.0, 5.0]);
    exchange.accuracy = 1e-2;
    let v = field(&[1.0, 4.01, 4.03, 4.0, 4.0]);
    // Rounding above the limit is ignored, and so is a gap of half the residual of the solution.
    exchange.free = field(&[0.0, 0.0, 0.0, 2.5, LIMIT * (1.0 + 1e-15)]);
    let wrong = exchange.wrong(&problem, &v);
    assert_eq!((&wrong.above[..], &wrong.open[..]), (&[3][..], &[2][..]));
    assert!((wrong.by - 0.25).abs() < 1e-15, "{}", wrong.by);
    exchange.free = field(&[]);
    let wrong = exchange.wrong(&problem, &v);
    // (4.03 − D)/D
    assert!(wrong.above.is_empty() && (wrong.by - 0.03 / depth).abs() < 1e-15);
    assert_eq!(exchange.total.penetration, depth);
}

#[test]
fn under_a_force_the_widest_gaps_are_released_a_few_for_each_element_below_the_limit() {
    let mut problem = problem(1.0, |_| 0.0);
    let mut exchange = begun(&mut problem, Load::Penetration(0.5), &[LIMIT; 15]);
    let mut v: Vec<f64> = (0..16).map(|e| 1.0 + 0.1 * f64::from(e)).collect();
    v[15] = 0.5;
    // One element carries: eight of fifteen are released under a force, all under a penetration.
    exchange.free[15] = 1.0;
    assert_eq!(exchange.wrong(&problem, &v).open.len(), 15);
    exchange.load = Load::Force(1.0);
    let open = exchange.wrong(&problem, &v).open;
    assert_eq!(open, [14, 13, 12, 11, 10, 9, 8, 7]);
    // At least a few if none carries.
    exchange.free[15] = 0.0;
    assert_eq!(exchange.wrong(&problem, &v).open, [14, 13, 12, 11]);
}

#[test]
fn enough_further_elements_are_held_to_carry_the_excess_over_the_limit() {
    let mut problem = problem(1.0, |_| 0.0);
    let mut exchange = begun(&mut problem, Load::Force(1.0), &[LIMIT]);
    // The second exceeds the limit by twice its value and the third by 1.5 times: three others are needed, first those
    // with the largest pressure, then the unpressed one with the smallest gap, but none that cannot touch.
    exchange.free = field(&[0.0, 3.0 * LIMIT, 2.5 * LIMIT, 0.3, 0.9]);
    let mut v: Vec<f64> = (0..16).map(|e| 2.0 - 0.1 * f64::from(e)).collect();
    v[15] = f64::INFINITY;
    let beside = |above: &[usize], open: &[usize]| WrongSide {
        above: above.to_vec(),
        open: open.to_vec(),
        ..WrongSide::default()
    };
    let wrong = beside(&[1, 2], &[]);
    assert_eq!(exchange.next(LIMIT, &wrong, &v), [4, 3, 14]);
    exchange.exchange(LIMIT, &wrong, &v);
    assert_eq!(held(&exchange), [0, 1, 2, 3, 4, 14]);
    assert_eq!(exchange.free, field(&[]));
    // An excess of half the limit adds none; nor does any when elements are released, or once others have been
    // held after a release.
    exchange.free = field(&[0.0, 1.5 * LIMIT]);
    assert!(exchange.next(LIMIT, &beside(&[1], &[]), &v).is_empty());
    exchange.release(LIMIT, &[3]);
    assert_eq!(exchange.free[3], LIMIT);
    assert!(!exchange.held.mask[3]);
    exchange.free[1] = 2.0 * LIMIT;
    assert_eq!(exchange.next(LIMIT, &beside(&[1], &[]), &v), [3]);
    assert!(exchange.next(LIMIT, &beside(&[1], &[4]), &v).is_empty());
    exchange.exchange(LIMIT, &beside(&[1], &[]), &v);
    assert_eq!(held(&exchange), [0, 1, 2, 3, 4, 14]);
    exchange.free[5] = 2.0 * LIMIT;
    assert!(exchange.next(LIMIT, &beside(&[5], &[]), &v).is_empty());
}

#[test]
fn exchanges_stall_after_four_that_release_elements_without_halving_the_violation() {
    let mut problem = problem(1.0, |_| 0.0);
    let wrong = |by: f64, open: &[usize]| WrongSide {
        above: vec![1],
        open: open.to_vec(),
        excess: by,
        by,
    };
    let mut exchange = begun(&mut problem, Load::Penetration(1.0), &[]);
    let mut stalls = |steps: &[(f64, &[usize])]| -> Vec<bool> {
        exchange.milestone.restart();
        let steps = steps.iter();
        steps
            .map(|(by, open)| exchange.has_stalled(&wrong(*by, open)))
            .collect()
    };
    let open: &[usize] = &[0];
    let constant = stalls(&[(0.1, open); 5]);
    assert_eq!(constant, [false, false, false, false, true]);
    let halved = [0.1, 0.08, 0.06, 0.055, 0.04, 0.03, 0.03, 0.03, 0.03];
    let halved = stalls(&halved.map(|by| (by, open)));
    assert_eq!(halved.iter().position(|stalls| *stalls), Some(8));
    // Exchanges that only hold more elements always end.
    let none: &[usize] = &[];
    assert!(!stalls(&[(0.1, none); 9]).contains(&true));
}

#[test]
fn nothing_is_solved_if_the_held_elements_carry_the_whole_force() {
    let mut problem = problem(1.0, |_| 0.0);
    let load = Load::Force(3.0 * LIMIT * AREA);
    let mut exchange = begun(&mut problem, load, &[LIMIT; 3]);
    assert_eq!(held(&exchange).len(), 3);
    exchange.press(&mut problem);
    let (mut solver, watch) = (GradientSolver::default(), &mut ());
    let mut watch = Watch::alone(watch);
    let found = exchange.solve(&mut solver, &mut problem, &mut watch);
    let (found, displacement) = found.unwrap();
    assert_eq!(
        (found.pressure, found.operator_applications),
        (field(&[]), 0)
    );
    assert_eq!(displacement, Some(field(&[])));
    // The others carry a little more force.
    exchange.load = Load::Force(3.5 * LIMIT * AREA);
    exchange.free = field(&[]);
    let found = exchange.solve(&mut solver, &mut problem, &mut watch);
    let (found, _) = found.unwrap();
    assert!(found.operator_applications > 0);
    let carried: f64 = found.pressure.iter().sum();
    assert!((carried / (0.5 * LIMIT) - 1.0).abs() < 1e-9, "{carried}");
    assert!(found.pressure[..3].iter().all(|p| *p == 0.0));
}

#[test]
fn a_correct_set_is_solved_once_more_to_the_tolerance_and_no_further() {
    let mut problem = problem(1.0, |_| 0.0);
    let load = Load::Penetration(4.0);
    let mut exchange = begun(&mut problem, load, &[1.0]);
    let u = vec![SINKING; 16];
    assert!(exchange.advance(&mut problem, &u));
    assert_eq!(exchange.accuracy, 1e-6);
    assert!(!exchange.advance(&mut problem, &u));
    // A pressure a thousandth above the limit is an error of that size, and the next problem is solved to a fraction of
    // it.
    exchange.free[0] = 1.001 * LIMIT;
    assert!(exchange.advance(&mut problem, &u));
    assert_eq!(held(&exchange), [0]);
    assert!((exchange.accuracy / (REFINEMENT * 1e-3) - 1.0).abs() < 1e-9);
    assert!(!exchange.is_pressed);
    // An element held at v = g0 + w* + u = 5 under a penetration of 4 is released at the limit.
    exchange.press(&mut problem);
    let u = vec![3.0; 16];
    assert!(exchange.advance(&mut problem, &u));
    assert!(held(&exchange).is_empty() && exchange.free[0] == LIMIT);
    assert_eq!(exchange.accuracy, TIGHTENING * COARSEST);
}

#[test]
fn stalled_exchanges_continue_on_springs_that_harden_until_they_are_gone() {
    let mut problem = problem(1.0, |_| 0.0);
    let kappa = problem.shortest_compliance();
    let mut exchange = begun(&mut problem, Load::Penetration(4.0), &[LIMIT, 1.0]);
    exchange.milestone = Milestone::after(HALVED, 1e-9, PATIENCE - 1);
    exchange.free[1] = 1.5 * LIMIT;
    // The held element has a gap, v = u + w* > D, and the other exceeds the limit: they change sides.
    let u = vec![3.0; 16];
    assert!(exchange.advance(&mut problem, &u));
    assert_eq!(held(&exchange), [1]);
    assert_eq!(exchange.free, field(&[LIMIT]));
    assert_eq!(problem.springs().compliance(), [1.0 + 2.0 * kappa; 16]);
    assert_eq!(exchange.accuracy, FINER_ON_SPRINGS * COARSEST);
    assert_eq!(exchange.milestone, Milestone::new(HALVED));
    assert!(!exchange.is_pressed);
    // Nothing is wrong on the springs, at v = 2 (1 + 2 κ) ≤ D: they are removed, though the solution is coarse.
    let u = vec![-4.0 * kappa; 16];
    assert!(exchange.advance(&mut problem, &u));
    assert_eq!(problem.springs().compliance(), [1.0; 16]);
    assert_eq!(exchange.accuracy, COARSEST);
    assert_eq!(held(&exchange), [1]);
    assert_eq!(exchange.total.operator_applications, 0);
}

#[test]
fn exchanges_that_stall_again_give_way_to_a_descent_from_an_admissible_pressure() {
    let mut problem = problem(1.0, |_| 0.0);
    let load = Load::Penetration(4.0);
    let mut exchange = begun(&mut problem, load, &[LIMIT, 1.0]);
    exchange.continuation = Continuation::ended();
    exchange.milestone = Milestone::after(HALVED, 1e-9, PATIENCE - 1);
    exchange.free[1] = 1.5 * LIMIT;
    let u = vec![3.0; 16];
    assert!(exchange.advance(&mut problem, &u));
    let descent = exchange.descent.as_ref().unwrap();
    assert_eq!(descent.pressure(), field(&[LIMIT, LIMIT]));
    assert_eq!(held(&exchange), [0, 1]);
    assert_eq!(exchange.free, field(&[]));
    assert_eq!(exchange.total.operator_applications, 1);
    // No element exceeds the limit and both have a gap: both are released.
    assert!(exchange.advance(&mut problem, &u));
    assert_eq!(held(&exchange), [0; 0]);
    assert_eq!(exchange.free, field(&[LIMIT, LIMIT]));
    assert_eq!(exchange.total.operator_applications, 1);
    // They exceed the limit again and are held again, without a product.
    exchange.free[..2].fill(1.25 * LIMIT);
    assert!(exchange.advance(&mut problem, &u));
    assert_eq!(held(&exchange), [0, 1]);
    assert_eq!(exchange.total.operator_applications, 1);
    // Another element reaches the limit: the pressure moves there, and it is held too.
    exchange.free[5] = 2.0 * LIMIT;
    let u = vec![0.0; 16];
    assert!(exchange.advance(&mut problem, &u));
    assert_eq!(held(&exchange), [0, 1, 5]);
    assert_eq!(exchange.free, field(&[]));
}
