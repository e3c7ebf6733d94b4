//! Single steps of the descent, and their energy.

use approx::assert_relative_eq;

use super::*;
use crate::{
    GradientSolver, Solver, Watch,
    solver::tests::{RIGID, paraboloid, problem},
    vector::dot,
};

const FORCE: f64 = 1e-3;

/// A paraboloid on a homogeneous body, with a hardness.
fn with_hardness(hardness: f64) -> DiscreteProblem {
    let problem = problem([1.0, 1.0], paraboloid, RIGID);
    problem.with_hardness(hardness).unwrap()
}

#[test]
fn pressure_above_the_limit_is_carried_by_the_others_in_proportion() {
    let problem = with_hardness(2.0);
    let mut pressure = vec![0.0; problem.elements()];
    pressure[..4].copy_from_slice(&[5.0, 1.0, 1.5, 0.5]);
    let load = Load::Force(problem.loaded_area() * 6.5);
    let cut = cut(&problem, load, &pressure);
    // The first loses 3, and a factor of two would raise the third to 3: it is at the limit too, and the others share
    // 2.5.
    let wanted = [2.0, 2.5 / 1.5, 2.0, 2.5 / 3.0];
    for (found, wanted) in cut.iter().zip(wanted) {
        assert_relative_eq!(*found, wanted, max_relative = 1e-13);
    }
    assert!(cut[4..].iter().all(|p| *p == 0.0));
}

#[test]
fn pressure_that_no_pressed_element_can_carry_is_shared_by_all() {
    let problem = with_hardness(2.0);
    let mut pressure = vec![0.0; problem.elements()];
    pressure[0] = 100.0;
    let load = Load::Force(problem.loaded_area() * 100.0);
    let cut = cut(&problem, load, &pressure);
    assert_relative_eq!(sum(&cut), 100.0, max_relative = 1e-12);
    assert!(cut.iter().all(|p| *p > 0.0 && *p <= 2.0));
}

#[test]
fn a_step_lowers_the_energy_and_respects_force_and_limit() {
    let mut elastic = problem([1.0, 1.0], paraboloid, RIGID);
    let load = Load::Force(FORCE);
    let start = vec![0.0; elastic.elements()];
    let mut solver = GradientSolver::default();
    let found = solver.solve(&mut elastic, load, &start, &mut Watch::alone(&mut ()));
    let pressure = found.unwrap().pressure;
    let peak = pressure.iter().copied().fold(0.0, f64::max);
    let mut displacement = vec![0.0; pressure.len()];
    elastic.displace(&pressure, &mut displacement);

    let mut problem = with_hardness(0.5 * peak);
    let total = sum(&pressure);
    let even = vec![total / pressure.len() as f64; pressure.len()];
    let mut descent = Descent::begin(&mut problem, load, &even);
    let energy = |descent: &Descent, problem: &DiscreteProblem| {
        let (p, u) = (&descent.pressure, &descent.displacement);
        dot(p, u) / 2.0 + dot(p, problem.initial_gap())
    };
    let before = energy(&descent, &problem);
    let products = descent.step(&mut problem, &pressure, &displacement);
    assert!(products <= 1);
    assert!(energy(&descent, &problem) < before);
    assert_relative_eq!(sum(&descent.pressure), total, max_relative = 1e-12);
    assert!(
        descent
            .pressure
            .iter()
            .all(|p| (0.0..=0.5 * peak).contains(p))
    );
    assert!(descent.pressure.contains(&(0.5 * peak)));
    let mut fresh = vec![0.0; pressure.len()];
    problem.displace(&descent.pressure, &mut fresh);
    for (kept, fresh) in descent.displacement.iter().zip(&fresh) {
        assert_relative_eq!(kept, fresh, max_relative = 1e-10);
    }
}

#[test]
fn the_slope_at_the_end_of_a_step_is_that_of_the_energy_there() {
    let springs = |x: f64, _: f64| if x < 0.0 { 0.3 } else { 0.0 };
    let end = |x: f64, y: f64| {
        if x.hypot(y) < 0.4 {
            paraboloid(x, y)
        } else {
            f64::INFINITY
        }
    };
    let mut problem = problem([1.0, 0.1], end, springs);
    problem = problem.with_hardness(2.0).unwrap();
    let depth = 0.02;
    let touchable: Vec<bool> = problem
        .initial_gap()
        .iter()
        .map(|g0| g0.is_finite())
        .collect();
    let field = |phase: f64| -> Vec<f64> {
        let wave = |(e, can_touch): (usize, &bool)| {
            if *can_touch {
                1.0 + 0.5 * (phase + e as f64).sin()
            } else {
                0.0
            }
        };
        touchable.iter().enumerate().map(wave).collect()
    };
    let (from, to) = (field(0.0), field(1.0));
    // ½ p·(K + η) p + (g0 − D)·p
    let mut energy = |p: &[f64]| {
        let mut u = vec![0.0; p.len()];
        problem.displace(p, &mut u);
        let terms = (0..p.len()).filter(|e| touchable[*e]).map(|e| {
            let (eta, g0) = (problem.relief_compliance()[e], problem.initial_gap()[e]);
            p[e] * (0.5 * (u[e] + eta * p[e]) + g0 - depth)
        });
        terms.sum::<f64>()
    };
    let beyond = |part: f64| -> Vec<f64> {
        let both = from.iter().zip(&to);
        both.map(|(from, to)| from + part * (to - from)).collect()
    };
    // The central difference of a quadratic is its exact derivative.
    let wanted = energy(&beyond(1.5)) - energy(&beyond(0.5));
    let load = Load::Penetration(depth);
    let mut descent = Descent::begin(&mut problem, load, &to);
    let found = descent.slope_from(&problem, &from);
    assert_relative_eq!(found, wanted, max_relative = 1e-9);
    // Under a force, no energy is gained by more pressure.
    let more = sum(&to) - sum(&from);
    descent.load = Load::Force(1.0);
    let found = descent.slope_from(&problem, &from);
    assert_relative_eq!(found, wanted + depth * more, max_relative = 1e-9);
}

/// A descent at a uniform pressure of 0.5 below a limit of 2, and a target pressure that is 0.7 except on the first
/// elements.
fn at_half(problem: &mut DiscreteProblem, load: Load, to: &[f64]) -> (Descent, Vec<f64>, Vec<f64>) {
    let mut pressure = vec![0.7; problem.elements()];
    pressure[..to.len()].copy_from_slice(to);
    let mut displacement = vec![0.0; pressure.len()];
    problem.displace(&pressure, &mut displacement);
    let descent = Descent::begin(problem, load, &vec![0.5; pressure.len()]);
    (descent, pressure, displacement)
}

/// Asserts the pressure after this fraction of the step, cut at the limit, and its displacement.
#[track_caller]
fn assert_at(descent: &Descent, problem: &mut DiscreteProblem, to: &[f64], part: f64) {
    for (found, to) in descent.pressure.iter().zip(to) {
        assert_relative_eq!(
            *found,
            (0.5 + part * (to - 0.5)).min(2.0),
            max_relative = 1e-12
        );
    }
    let mut fresh = vec![0.0; to.len()];
    problem.displace(&descent.pressure, &mut fresh);
    for (kept, fresh) in descent.displacement.iter().zip(&fresh) {
        assert_relative_eq!(kept, fresh, max_relative = 1e-9);
    }
}

#[test]
fn a_step_with_one_element_above_the_limit_ends_where_it_reaches_the_limit() {
    let (mut problem, load) = (with_hardness(2.0), Load::Penetration(1.0));
    let (mut descent, to, u) = at_half(&mut problem, load, &[1.9, 5.0]);
    descent.caution = Caution::after(3);
    assert_eq!(descent.step(&mut problem, &to, &u), 0);
    // (2 − 0.5)/(5 − 0.5)
    assert_at(&descent, &mut problem, &to, 1.0 / 3.0);
    assert_eq!(descent.pressure()[1], 2.0);
    assert!(descent.pressure()[0] < 1.0);
    assert_eq!(descent.caution, Caution::after(2));
}

#[test]
fn a_downhill_step_continues_until_a_fraction_of_the_elements_is_at_the_limit() {
    // So deep that any more pressure lowers the energy.
    let (mut problem, load) = (with_hardness(2.0), Load::Penetration(1e3));
    // At the limit after 1/2, 1/3, 1/4 and 1/6 of the step.
    let above = [3.5, 5.0, 6.5, 9.5];
    for (caution, part, next) in [(0, 1.0, 0), (1, 0.25, 0), (2, 1.0 / 6.0, 1)] {
        let (mut descent, to, u) = at_half(&mut problem, load, &above);
        descent.caution = Caution::after(caution);
        let products = descent.step(&mut problem, &to, &u);
        assert_eq!(
            (products, descent.caution),
            (usize::from(caution < 2), Caution::after(next))
        );
        assert_at(&descent, &mut problem, &to, part);
        let at_limit = descent.pressure().iter().filter(|p| **p == 2.0).count();
        assert_eq!(at_limit, 4 >> caution);
    }
}

#[test]
fn a_step_uphill_at_its_end_stops_at_the_first_limit_and_the_next_is_more_cautious() {
    // The indenter is above the surface: any pressure raises the energy.
    let (mut problem, load) = (with_hardness(2.0), Load::Penetration(-1e3));
    let (mut descent, to, u) = at_half(&mut problem, load, &[3.5, 5.0, 6.5, 9.5]);
    assert_eq!(descent.step(&mut problem, &to, &u), 1);
    assert_at(&descent, &mut problem, &to, 1.0 / 6.0);
    assert_eq!(descent.caution, Caution::after(2));
}
