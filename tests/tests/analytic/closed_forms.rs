//! Indenters on a homogeneous body: Hertz's paraboloid, Sneddon's cone, punch and sphere.

use std::f64::consts::PI;

use pellicle_contact::{Cone, FlatPunch, Indenter, Load, LoadingPath, Sphere, reference};
use pellicle_tests::scene::{model, paraboloid, relative, solve, unit_half_space};
use pellicle_texture::Relief;

/// On 256 elements per side.
fn fine(indenter: Indenter, side: f64, force: f64) -> LoadingPath {
    let model = model(&unit_half_space(), Relief::Bare, indenter);
    solve(&model, side, 256, Load::Force(force))
}

#[test]
fn a_paraboloid_on_a_homogeneous_body_is_hertzs_contact() {
    let hertz = reference::hertz::from_contact_radius(1.0, 1.0, 0.1);
    let path = fine(paraboloid(1.0), 0.3, hertz.force);
    let (solution, summary) = (&path.steps[0].solution, path.steps[0].summary);
    // Second order: (1/85)² of the radius squared, 1.4e-4, times what the sampling of the edge leaves, some 0.05.
    assert!(relative(solution.penetration, hertz.penetration) < 1e-5);
    // The peak lies a quarter of an element off the nearest centre; the area is that of whole elements.
    assert!(relative(summary.max_pressure, hertz.peak_pressure) < 1e-3);
    assert!(relative(summary.contact_area, PI * 0.01) < 1e-2);
    assert!(relative(summary.mean_pressure, hertz.mean_pressure()) < 1e-2);
}

#[test]
fn the_contact_stiffness_is_twice_modulus_times_radius() {
    let hertz = reference::hertz::from_contact_radius(1.0, 1.0, 0.1);
    let path = fine(paraboloid(1.0), 0.3, hertz.force);
    let stiffness = path.steps[0].contact_stiffness.unwrap_or(f64::NAN);
    // A punch of the contact's outline, which is a staircase.
    assert!(relative(stiffness, 0.2) < 1e-2, "{stiffness}");
}

#[test]
fn a_cone_on_a_homogeneous_body_is_sneddons_contact() {
    let cone = reference::cone::from_penetration(1.2, 1.0, 0.1);
    let indenter = Indenter::Cone(Cone::new(1.2, 0.0).expect("a cone"));
    let path = fine(indenter, 3.0 * cone.contact_radius, cone.force);
    let found = path.steps[0].solution.penetration;
    // Second order, as for the paraboloid.
    assert!(relative(found, cone.penetration) < 1e-5, "{found}");
}

#[test]
fn a_sphere_is_sneddons_contact_and_not_the_paraboloids() {
    let sphere = reference::sphere::from_contact_radius(1.0, 1.0, 0.35);
    let hertz = reference::hertz::from_force(1.0, 1.0, sphere.force);
    let indenter = Indenter::Sphere(Sphere::new(1.0).expect("a sphere"));
    let path = fine(indenter, 1.05, sphere.force);
    let found = path.steps[0].solution.penetration;
    // Second order; Hertz's formula is off by some (a/R)²/10 = 1e-2 here.
    assert!(relative(found, sphere.penetration) < 2e-5, "{found}");
    assert!(relative(found, hertz.penetration) > 5e-3, "{found}");
}

#[test]
fn a_flat_punch_on_a_homogeneous_body_is_sneddons_contact() {
    let punch = reference::flat_punch::from_force(0.1, 1.0, 0.02);
    let indenter = Indenter::FlatPunch(FlatPunch::new(0.1).expect("a punch"));
    let path = fine(indenter, 0.25, punch.force);
    let solution = &path.steps[0].solution;
    // The rim is a staircase of some 1/100 of the radius, and the pressure at it infinite.
    assert!(relative(solution.penetration, punch.penetration) < 1e-2);
    let middle = solution.pressure[128 * 256 + 128];
    assert!(relative(middle, punch.central_pressure) < 1e-2, "{middle}");
}
