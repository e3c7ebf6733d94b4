//! Scale and total of a state's pressure, and its residual.

use super::*;
use crate::{
    Load,
    solver::{
        gradient::tests::begun,
        tests::{RIGID, SIZE, paraboloid, problem},
    },
    vector::dot,
};

const ELEMENTS: usize = SIZE * SIZE;

/// A non-uniform pressure on a disc in the middle.
fn disc() -> Vec<f64> {
    let along = |i: usize| (i as f64 - 15.5) / SIZE as f64;
    let radius = |e: usize| along(e / SIZE).hypot(along(e % SIZE));
    let pressure = |e: usize| {
        if radius(e) < 0.2 {
            1.0 + 0.3 * (e as f64).sin()
        } else {
            0.0
        }
    };
    (0..ELEMENTS).map(pressure).collect()
}

#[test]
fn balancing_takes_a_product_only_if_the_scale_is_far_off() {
    let mut problem = problem([1.0, 0.1], paraboloid, RIGID);
    let control = LoadControl::of(&problem, Load::Penetration(0.05));
    let (mut state, _) = begun(&mut problem, control, &disc());
    let (balanced, v) = (state.pressure.clone(), state.v.clone());
    for (factor, products) in [(0.01, 1), (0.5, 0), (1.0, 0), (3.0, 0)] {
        for e in 0..ELEMENTS {
            state.pressure[e] = factor * balanced[e];
            state.v[e] = state.initial_gap[e] + factor * (v[e] - state.initial_gap[e]);
        }
        let before = state.applications();
        let growth = state.balance(&mut problem);
        assert!(
            (growth - (1.0 / factor - 1.0)).abs() < 1e-10 / factor,
            "{factor} {growth}"
        );
        assert_eq!(state.applications() - before, products);
        let largest = balanced.iter().copied().fold(0.0, f64::max);
        for (found, wanted) in state.pressure.iter().zip(&balanced) {
            assert!((found - wanted).abs() < 1e-11 * largest);
        }
        for (found, wanted) in state.v.iter().zip(&v) {
            assert!((found - wanted).abs() < 1e-10 * state.penetration);
        }
    }
    // The mean of v over the pressure is the penetration.
    let mean = dot(&state.pressure, &state.v) / sum(&state.pressure);
    assert!((mean / state.penetration - 1.0).abs() < 1e-12);
}

#[test]
fn steps_preserve_a_prescribed_total_and_can_be_undone() {
    let mut problem = problem([1.0, 0.1], paraboloid, RIGID);
    for load in [Load::Penetration(0.05), Load::Force(1e-3)] {
        let control = LoadControl::of(&problem, load);
        let (mut state, _) = begun(&mut problem, control, &disc());
        assert!(state.keeps_total());
        state.press_anywhere();
        let mut other = vec![2.0; ELEMENTS];
        state.rescale(&mut other);
        assert!((sum(&other) / sum(&state.pressure) - 1.0).abs() < 1e-12);
        let (pressure, v, depth) = (state.pressure.clone(), state.v.clone(), state.penetration);
        let energy = state.energy();
        // No scaling of this pressure gives the penetration, which the gap exceeds.
        state.pressure.fill(0.0);
        state.pressure[0] = 1.0;
        state.refresh(&mut problem);
        assert_eq!(state.keeps_total(), matches!(load, Load::Force(_)));
        state.go_back(&pressure, &v, depth);
        assert!(state.keeps_total() && state.energy() == energy);
    }
}

#[test]
fn a_state_without_pressure_gets_pressure_on_the_whole_set_and_others_are_unchanged() {
    let problem = problem([1.0, 0.1], paraboloid, RIGID);
    let mut state = State::new(&problem);
    let mask: Vec<bool> = (0..ELEMENTS).map(|e| e % 3 == 0).collect();
    state.pressure[5] = -1.0;
    state.press_somewhere(&mask);
    let even = |e: usize| f64::from(u8::from(e.is_multiple_of(3)));
    assert!((0..ELEMENTS).all(|e| state.pressure[e] == even(e)));
    state.pressure.fill(0.0);
    state.pressure[5] = 0.5;
    state.press_somewhere(&mask);
    assert!((0..ELEMENTS).all(|e| state.pressure[e] == if e == 5 { 0.5 } else { 0.0 }));
}

#[test]
fn the_residual_is_the_largest_gap_under_pressure_or_overlap_over_the_penetration() {
    let problem = problem([1.0, 0.1], paraboloid, RIGID);
    let mut state = State::new(&problem);
    state.control = LoadControl::Penetration(2.0);
    state.pressure[3] = 1.0;
    let of = |state: &State, changes: &[(usize, f64)]| {
        let mut v = vec![2.5; ELEMENTS];
        v[3] = 2.0;
        changes.iter().for_each(|(e, value)| v[*e] = *value);
        state.residual_of(&v, 2.0)
    };
    assert_eq!(of(&state, &[]), (0.0, true));
    // A gap under pressure, an overlap elsewhere.
    assert_eq!(of(&state, &[(3, 2.25)]), (0.125, true));
    assert_eq!(of(&state, &[(3, 1.5), (9, 1.75)]), (0.25, true));
    assert_eq!(of(&state, &[(9, 1.0)]), (0.5, true));
    assert_eq!(of(&state, &[(9, f64::NAN)]), (f64::INFINITY, true));
    assert_eq!(
        state.residual_of(&vec![2.5; ELEMENTS], f64::NAN).0,
        f64::INFINITY
    );
    state.pressure[4] = -1e-9;
    assert_eq!(of(&state, &[]), (0.0, false));
}
