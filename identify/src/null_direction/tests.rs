//! Directions of known models, and those that remain when a parameter is held.

use approx::assert_relative_eq;

use super::*;

fn names(list: &[&str]) -> Vec<String> {
    list.iter().map(ToString::to_string).collect()
}

fn free(list: &[&str]) -> Vec<Unknown> {
    list.iter()
        .map(|name| Unknown::positive(*name, [1e-3, 1e3]).unwrap())
        .collect()
}

#[test]
fn a_ball_on_a_half_space_determines_the_modulus_times_the_root_of_the_radius() {
    // D ~ (Q²/(R E²))^⅓ depends only on E √R, not on ν: (E, R, ν) → (E/√b, b R, ν), and ν is arbitrary.
    let directions = NullDirections::new(
        names(&["E", "R", "nu"]),
        vec![vec![-0.5, 1.0, 0.0], vec![0.0, 0.0, 1.0]],
    )
    .unwrap();
    let space = directions.among(&free(&["E", "R"])).unwrap();
    assert_eq!(space.rank(), 1);
    let hold = space.hold_for(0).unwrap().unwrap();
    assert_eq!(hold.held, [1]);
    assert_relative_eq!(hold.exponents[0].1, 0.5, max_relative = 1e-12);
    let hold = space.hold_for(1).unwrap().unwrap();
    assert_relative_eq!(hold.exponents[0].1, 2.0, max_relative = 1e-12);
}

#[test]
fn a_fixed_parameter_or_a_prior_closes_a_direction() {
    let directions = NullDirections::new(names(&["E", "R"]), vec![vec![-0.5, 1.0]]).unwrap();
    assert_eq!(directions.among(&free(&["E"])).unwrap().rank(), 0);
    let mut unknowns = free(&["E", "R"]);
    let prior = crate::Prior::Lognormal {
        median: 1.0,
        factor: 1.1,
    };
    unknowns[1] = unknowns[1].clone().with_prior(prior).unwrap();
    assert_eq!(directions.among(&unknowns).unwrap().rank(), 0);
}

#[test]
fn two_directions_combine_into_one_that_keeps_the_fixed_parameter() {
    // (1, 1, 0) and (0, 1, 1) with the second fixed: only their difference (1, 0, −1) counts.
    let directions = NullDirections::new(
        names(&["a", "b", "c"]),
        vec![vec![1.0, 1.0, 0.0], vec![0.0, 1.0, 1.0]],
    )
    .unwrap();
    let space = directions.among(&free(&["a", "c"])).unwrap();
    assert_eq!(space.rank(), 1);
    let hold = space.hold_for(0).unwrap().unwrap();
    assert_relative_eq!(hold.exponents[0].1, 1.0, max_relative = 1e-12);
}

#[test]
fn an_unknown_that_no_curve_depends_on_has_no_known_combination() {
    let directions = NullDirections::new(names(&["E", "nu"]), vec![vec![0.0, 1.0]]).unwrap();
    let space = directions.among(&free(&["E", "nu"])).unwrap();
    assert!(space.moves(1) && !space.moves(0));
    assert_eq!(space.hold_for(1).unwrap(), None);
    assert_eq!(space.hold_for(0).unwrap().unwrap().exponents, []);
    assert_eq!(space.hold().unwrap(), [1]);
}
