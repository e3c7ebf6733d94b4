//! Indenters on a homogeneous body and on springs alone, compared with closed forms.

use std::f64::consts::PI;

use pellicle_contact::{Cone, FlatPunch, Indenter, Load, LoadingPath, PowerLaw, Sphere, reference};
use pellicle_kernel::Foundation;
use pellicle_tests::convergence::{GRIDS, NoConvergence, demand, observed_order};
use pellicle_tests::scene::{
    material, model, paraboloid, penetration, relative, solve, unit_half_space,
};
use pellicle_texture::{Film, Relief};

/// Errors on all grids of the certified solution for a bare half-space.
fn errors(
    indenter: Indenter,
    side: f64,
    load: Load,
    error: impl Fn(&LoadingPath) -> f64,
) -> [(usize, f64); 9] {
    let model = model(&unit_half_space(), Relief::Bare, indenter);
    GRIDS.map(|elements| (elements, error(&solve(&model, side, elements, load))))
}

/// The error of the penetration.
fn of_penetration(wanted: f64) -> impl Fn(&LoadingPath) -> f64 {
    move |path| relative(path.steps[0].solution.penetration, wanted)
}

/// Root mean square of the pressure's error over that of the closed form.
fn of_pressure(pressure: impl Fn(f64) -> f64) -> impl Fn(&LoadingPath) -> f64 {
    move |path| {
        let elements = path.steps[0].solution.pressure.iter();
        let (mut difference, mut total) = (0.0, 0.0);
        for (found, [x, y]) in elements.zip(path.grid.centres()) {
            let wanted = pressure(x.hypot(y));
            difference += (found - wanted).powi(2);
            total += wanted.powi(2);
        }
        (difference / total).sqrt()
    }
}

#[test]
fn hertzs_penetration_converges_with_order_two_and_the_pressure_with_order_one() {
    let hertz = reference::hertz::from_contact_radius(1.0, 1.0, 0.1);
    let load = Load::Force(hertz.force);
    let found = errors(
        paraboloid(1.0),
        0.3,
        load,
        of_penetration(hertz.penetration),
    );
    demand(&found, 1.8, 3e-6).expect("order two");
    // The pressure vanishes like a square root at the edge.
    let found = errors(
        paraboloid(1.0),
        0.3,
        load,
        of_pressure(|r| hertz.pressure(r)),
    );
    demand(&found, 0.9, 2e-3).expect("order one");
}

#[test]
fn the_area_of_hertzs_contact_converges_with_order_near_two() {
    let hertz = reference::hertz::from_contact_radius(1.0, 1.0, 0.1);
    let area = PI * 0.1 * 0.1;
    let of_area = |path: &LoadingPath| relative(path.steps[0].summary.contact_area, area);
    let load = Load::Force(hertz.force);
    let found = errors(paraboloid(1.0), 0.3, load, of_area);
    // Counting elements has an error of 2.5e-3 on the finest grid, with an order of 0.8.
    demand(&found, 1.5, 5e-5).expect("order near two");
    let of_radius = |path: &LoadingPath| relative(path.steps[0].summary.contact_radius, 0.1);
    for (elements, error) in errors(paraboloid(1.0), 0.3, load, of_radius) {
        // A sixteenth of an element.
        assert!(
            error < 0.06 * 3.0 / elements as f64,
            "{elements}: {error:e}"
        );
    }
}

#[test]
fn the_contact_area_of_a_flat_punch_is_the_area_within_its_rim() {
    let punch = reference::flat_punch::from_force(0.1, 1.0, 0.02);
    let indenter = Indenter::FlatPunch(FlatPunch::new(0.1).expect("a punch"));
    let area = |path: &LoadingPath| relative(path.steps[0].summary.contact_area, PI * 0.01);
    let load = Load::Force(punch.force);
    // Error of chords of a circle.
    demand(&errors(indenter, 0.25, load, area), 1.9, 1e-5).expect("order two");
}

#[test]
fn the_force_at_hertzs_penetration_converges_with_order_two() {
    let hertz = reference::hertz::from_penetration(1.0, 1.0, 0.01);
    let load = Load::Penetration(hertz.penetration);
    let error = |path: &LoadingPath| relative(path.steps[0].solution.force, hertz.force);
    demand(&errors(paraboloid(1.0), 0.3, load, error), 1.8, 5e-6).expect("order two");
}

#[test]
fn a_sharp_cones_penetration_converges_with_order_two() {
    let cone = reference::cone::from_penetration(1.2, 1.0, 0.1);
    let indenter = Indenter::Cone(Cone::new(1.2, 0.0).expect("a cone"));
    let (side, load) = (3.0 * cone.contact_radius, Load::Force(cone.force));
    let found = errors(indenter, side, load, of_penetration(cone.penetration));
    demand(&found, 1.8, 3e-6).expect("order two");
}

#[test]
fn the_penetration_of_power_laws_converges_with_order_two() {
    for exponent in [1.5, 3.3, 6.0] {
        let shape = [exponent, 1.0];
        let contact = reference::power_law::from_contact_radius(shape, 1.0, 0.1);
        let indenter = Indenter::PowerLaw(PowerLaw::new(exponent, 1.0).expect("a power law"));
        let load = Load::Force(contact.force);
        let found = errors(indenter, 0.3, load, of_penetration(contact.penetration));
        demand(&found, 1.7, 1e-5).expect("order two");
    }
}

#[test]
fn a_spheres_penetration_converges_with_order_two() {
    let sphere = reference::sphere::from_contact_radius(1.0, 1.0, 0.35);
    let indenter = Indenter::Sphere(Sphere::new(1.0).expect("a sphere"));
    let load = Load::Force(sphere.force);
    let found = errors(indenter, 1.05, load, of_penetration(sphere.penetration));
    demand(&found, 1.7, 5e-6).expect("order two");
}

#[test]
fn a_flat_punchs_penetration_converges_with_order_one() {
    let punch = reference::flat_punch::from_force(0.1, 1.0, 0.02);
    let indenter = Indenter::FlatPunch(FlatPunch::new(0.1).expect("a punch"));
    let load = Load::Force(punch.force);
    let found = errors(indenter, 0.25, load, of_penetration(punch.penetration));
    // The rim is a staircase, and the pressure there is infinite.
    demand(&found, 0.8, 2e-3).expect("order one");
}

#[test]
fn the_reported_order_is_the_observed_order() {
    let hertz = reference::hertz::from_contact_radius(1.0, 1.0, 0.1);
    let load = Load::Force(hertz.force);
    let of_penetration = of_penetration(hertz.penetration);
    let observed = observed_order(&errors(paraboloid(1.0), 0.3, load, of_penetration));
    let model = model(&unit_half_space(), Relief::Bare, paraboloid(1.0));
    for elements in [256, 320, 416] {
        let step = solve(&model, 0.3, elements, load).steps.remove(0);
        let reported = step.grid_error.penetration.expect("several grids");
        let order = reported.order.expect("a change");
        // The order from three grids scatters by a fifth; a first-order method would be off by 0.9.
        assert!(
            (order - observed).abs() < 0.3,
            "reported {order}, observed {observed}"
        );
    }
}

#[test]
fn the_estimated_error_has_the_size_of_the_actual_error() {
    let hertz = reference::hertz::from_contact_radius(1.0, 1.0, 0.1);
    let model = model(&unit_half_space(), Relief::Bare, paraboloid(1.0));
    let load = Load::Force(hertz.force);
    let step = solve(&model, 0.3, 416, load).steps.remove(0);
    let reported = step.grid_error.penetration.expect("several grids");
    let truth = (step.solution.penetration - hertz.penetration).abs();
    // Single errors scatter by some factor with the position of the contact's edge on the grid.
    assert!(
        reported.resolved && reported.estimate > 0.2 * truth && reported.estimate < 20.0 * truth,
        "{reported:?} {truth:e}"
    );
}

/// Negative control: a first-order method does not pass for a second-order one.
#[test]
fn a_penetration_off_by_a_fraction_of_an_element_is_detected_as_first_order() {
    let hertz = reference::hertz::from_contact_radius(1.0, 1.0, 0.1);
    let model = model(&unit_half_space(), Relief::Bare, paraboloid(1.0));
    let error = |elements| {
        let found = penetration(&model, 0.3, elements, Load::Force(hertz.force));
        // As if the tip were sampled a hundredth of an element too low.
        let spoilt = found * (1.0 + 0.01 * 3.0 / elements as f64);
        (elements, relative(spoilt, hertz.penetration))
    };
    let found = demand(&GRIDS.map(error), 1.7, 1e-5);
    assert!(
        matches!(found, Err(NoConvergence::Order { .. })),
        "{found:?}"
    );
}

#[test]
fn the_contact_area_on_springs_alone_is_winklers() {
    // Film compliance 0.01; the body deforms by less than 1e-9 of that.
    let foundation = Foundation::half_space(material(1e9, 0.3));
    let film = Relief::Film(Film::new(0.01, 1.0).expect("a film"));
    let winkler = reference::winkler::from_penetration(1.0, 0.01, 0.005);
    let load = Load::Penetration(winkler.penetration);
    let path = solve(&model(&foundation, film, paraboloid(1.0)), 0.25, 256, load);
    let found = path.steps[0].summary.contact_area;
    assert!(relative(found, winkler.contact_area) < 1e-2, "{found}");
}
