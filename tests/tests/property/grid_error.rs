//! What a solution says of its grid. That a finite peak is resolved and an infinite one is not is a row of
//! `pellicle validate`.

use pellicle_contact::{Cone, Indenter, Load, Step};
use pellicle_tests::scene::{model, paraboloid, solve, unit_half_space};
use pellicle_texture::Relief;

fn pressed(indenter: Indenter, elements: usize) -> Step {
    let model = model(&unit_half_space(), Relief::Bare, indenter);
    // Hertz's contact radius is 0.1.
    let load = Load::Force(4e-3 / 3.0);
    solve(&model, 0.3, elements, load).steps.remove(0)
}

#[test]
fn the_penetration_is_resolved_where_the_peak_is_not() {
    // Logarithmic at the tip.
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
