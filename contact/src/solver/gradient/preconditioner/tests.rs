//! What the choice of a preconditioner goes by.

use std::sync::Arc;

use pellicle_influence::{CoefficientTable, RadialTables, SurfaceElasticity};
use pellicle_kernel::{Foundation, Material};

use super::*;
use crate::{
    Load,
    solver::{
        gradient::{control::Control, tests::begun},
        tests::{RIGID, SIZE, paraboloid, problem as of_coat},
    },
};

#[test]
fn neighbours_grow_with_the_grid_from_a_few_hundred_elements_up_to_a_bound() {
    let of = |size| [1.0, 2.0 * STIFF, 2.0 * VERY_STIFF].map(|contrast| neighbours(size, contrast));
    assert_eq!(of(1), [42, 42, 60]);
    assert_eq!(of(COARSE), [42, 42, 60]);
    assert_eq!(of(3 * COARSE / 2), [63, 72, 103]);
    assert_eq!(of(2 * COARSE), [84, 105, 108]);
    assert_eq!(of(16 * COARSE), [108; 3]);
}

#[test]
fn a_stiff_coat_shows_in_the_response_to_long_waves_over_that_to_short_ones() {
    let contrast = |body: Foundation, size: usize| {
        let tables = RadialTables::build(&body).unwrap();
        let table = CoefficientTable::assemble(&tables, 1.0 / size as f64, size).unwrap();
        stiffness_contrast(&SurfaceElasticity::new(Arc::new(table), body).symbol(size))
    };
    let material = |young| Material::new(young, 0.3).unwrap();
    let half_space = || Foundation::half_space(material(1.0));
    let coated = |young| Foundation::coated(0.02, material(young), material(1.0)).unwrap();
    // No wave meets a softer body than another. The element's own shape counts a little.
    assert!((contrast(half_space(), 128) - 1.0).abs() < 0.1);
    // The longest wave of 1 meets the base below a coat of 0.02, the shortest of 1/64 meets the coat alone.
    let [stiff, soft] = [8.0, 0.125].map(|young| contrast(coated(young), 128));
    assert!(stiff > 5.0 && stiff < 8.0, "{stiff}");
    assert!(soft > 0.125 && soft < 0.25, "{soft}");
    assert_eq!(contrast(coated(8.0), 4), 1.0);
}

#[test]
fn what_is_missing_of_the_penetration_is_counted_on_the_set_alone() {
    let mut problem = of_coat([1.0, 0.1], paraboloid, RIGID);
    let control = Control::of(&problem, Load::Penetration(0.02));
    let pressure: Vec<f64> = (0..SIZE * SIZE)
        .map(|e| (e as f64).sin().max(0.0))
        .collect();
    let (state, mut set) = begun(&mut problem, control, &pressure);
    set.keep_pressing(&state);
    let mut residual = vec![7.0; SIZE * SIZE];
    residual_into(&state, &set, &mut residual);
    for (e, found) in residual.iter().enumerate() {
        let wanted = if pressure[e] > 0.0 {
            state.penetration - state.v[e]
        } else {
            0.0
        };
        assert_eq!(*found, wanted);
    }
}
