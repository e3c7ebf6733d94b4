//! What a solution says of its grid: resolved where numbers settle, not where they do not.

use pellicle_contact::{Cone, Estimate, FlatPunch, Indenter, Load, Step};
use pellicle_tests::scene::{model, paraboloid, solve, unit_half_space};
use pellicle_texture::Relief;

fn pressed(indenter: Indenter, elements: usize) -> Step {
    let model = model(&unit_half_space(), Relief::Bare, indenter);
    // Hertz's contact radius is 0.1.
    let load = Load::Force(4e-3 / 3.0);
    solve(&model, 0.3, elements, load).steps.remove(0)
}

fn peak(indenter: Indenter, elements: usize) -> Estimate {
    pressed(indenter, elements).grid_error.max_pressure.unwrap()
}

#[test]
fn a_finite_peak_is_resolved_and_an_infinite_one_is_not() {
    assert!(peak(paraboloid(1.0), 256).resolved);
    let punch = Indenter::FlatPunch(FlatPunch::new(0.1).unwrap());
    assert!(!peak(punch, 256).resolved);
    // Logarithmic at the tip.
    let cone = Indenter::Cone(Cone::new(1.4, 0.0).unwrap());
    assert!(!peak(cone, 256).resolved);
}

#[test]
fn the_penetration_is_resolved_where_the_peak_is_not() {
    let cone = Indenter::Cone(Cone::new(1.4, 0.0).unwrap());
    let error = pressed(cone, 256).grid_error;
    assert!(error.penetration.unwrap().resolved, "{error:?}");
    assert!(!error.max_pressure.unwrap().resolved, "{error:?}");
}

#[test]
fn two_grids_resolve_nothing_and_one_says_nothing() {
    let of_radius = |indenter, elements| pressed(indenter, elements).grid_error.max_pressure;
    assert!(!of_radius(paraboloid(1.0), 32).unwrap().resolved);
    assert!(of_radius(paraboloid(1.0), 20).is_none());
}
