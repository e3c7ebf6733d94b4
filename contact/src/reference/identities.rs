//! Identities that every closed form satisfies.

use super::{cone, flat_punch, hertz, power_law, sphere, winkler};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const MODULUS: f64 = 3.0;
const RADIUS: f64 = 2.0;
const ANGLE: f64 = 1.1;
const COMPLIANCE: f64 = 0.4;
const DEPTH: f64 = 0.05;

/// Force, strain energy and contact radius of each closed form as functions of penetration, with pressure and indenter.
struct Form {
    name: &'static str,
    contact: fn(f64) -> (f64, f64, f64),
    pressure: fn(f64) -> f64,
    height: fn(f64) -> f64,
}

/// Exponents and coefficients of power laws: between cone and paraboloid, and flatter than both.
const BLUNT: [f64; 2] = [3.7, 0.8];
const POINTED: [f64; 2] = [1.4, 0.8];

const FORMS: [Form; 6] = [
    Form {
        name: "hertz",
        contact: |depth| {
            let contact = hertz::from_penetration(RADIUS, MODULUS, depth);
            (
                contact.force,
                contact.strain_energy(),
                contact.contact_radius,
            )
        },
        pressure: |distance| hertz::from_penetration(RADIUS, MODULUS, DEPTH).pressure(distance),
        height: |distance| distance * distance / (2.0 * RADIUS),
    },
    Form {
        name: "cone",
        contact: |depth| {
            let contact = cone::from_penetration(ANGLE, MODULUS, depth);
            (
                contact.force,
                contact.strain_energy(),
                contact.contact_radius,
            )
        },
        pressure: |distance| cone::from_penetration(ANGLE, MODULUS, DEPTH).pressure(distance),
        height: |distance| distance / ANGLE.tan(),
    },
    Form {
        name: "flat punch",
        contact: |depth| {
            let contact = flat_punch::from_penetration(RADIUS, MODULUS, depth);
            (
                contact.force,
                contact.strain_energy(),
                contact.contact_radius,
            )
        },
        pressure: |distance| {
            flat_punch::from_penetration(RADIUS, MODULUS, DEPTH).pressure(distance)
        },
        height: |_| 0.0,
    },
    Form {
        name: "blunt power law",
        contact: |depth| of_power_law(BLUNT, depth),
        pressure: |distance| power_law::from_penetration(BLUNT, MODULUS, DEPTH).pressure(distance),
        height: |distance| distance.powf(BLUNT[0]) / BLUNT[1].powf(BLUNT[0] - 1.0),
    },
    Form {
        name: "pointed power law",
        contact: |depth| of_power_law(POINTED, depth),
        pressure: |distance| {
            power_law::from_penetration(POINTED, MODULUS, DEPTH).pressure(distance)
        },
        height: |distance| distance.powf(POINTED[0]) / POINTED[1].powf(POINTED[0] - 1.0),
    },
    Form {
        name: "winkler",
        contact: |depth| {
            let contact = winkler::from_penetration(RADIUS, COMPLIANCE, depth);
            (
                contact.force,
                contact.strain_energy(),
                contact.contact_radius,
            )
        },
        pressure: |distance| {
            winkler::from_penetration(RADIUS, COMPLIANCE, DEPTH).pressure(distance)
        },
        height: |distance| distance * distance / (2.0 * RADIUS),
    },
];

fn of_power_law(shape: [f64; 2], depth: f64) -> (f64, f64, f64) {
    let contact = power_law::from_penetration(shape, MODULUS, depth);
    (
        contact.force,
        contact.strain_energy(),
        contact.contact_radius,
    )
}

/// `∫ g dA` over the disc of radius a: midpoints in θ, ρ = a sin θ, which removes square-root singularities on the rim.
fn integral(a: f64, integrand: impl Fn(f64) -> f64) -> f64 {
    let (points, step) = (20_000, FRAC_PI_2 / 20_000.0);
    let ring = |k: i32| {
        let (sine, cosine) = ((f64::from(k) + 0.5) * step).sin_cos();
        integrand(a * sine) * TAU * a * sine * a * cosine * step
    };
    (0..points).map(ring).sum()
}

/// The integral's step is 8e-5; its square times a logarithm at the cone's apex is 5e-8.
const QUADRATURE: f64 = 1e-7;

/// A central difference over 1e-4 of the argument has an error of its square, 1e-8, times a factor of order one.
const DIFFERENCE: f64 = 3e-8;

fn derivative(function: impl Fn(f64) -> f64) -> f64 {
    let step = 1e-4 * DEPTH;
    (function(DEPTH + step) - function(DEPTH - step)) / (2.0 * step)
}

#[test]
fn the_pressure_adds_up_to_the_force() {
    for Form {
        name,
        contact,
        pressure,
        ..
    } in FORMS
    {
        let (force, _, radius) = contact(DEPTH);
        let sum = integral(radius, pressure);
        assert!(
            (sum / force - 1.0).abs() < QUADRATURE,
            "{name}: {sum} against {force}"
        );
    }
}

#[test]
fn the_energy_is_half_the_pressure_times_the_displacement() {
    for Form {
        name,
        contact,
        pressure,
        height,
    } in FORMS
    {
        let (_, energy, radius) = contact(DEPTH);
        let sum = 0.5
            * integral(radius, |distance| {
                pressure(distance) * (DEPTH - height(distance))
            });
        assert!(
            (sum / energy - 1.0).abs() < QUADRATURE,
            "{name}: {sum} against {energy}"
        );
    }
}

#[test]
fn the_energy_grows_by_the_work_of_the_force() {
    for Form { name, contact, .. } in FORMS {
        let slope = derivative(|depth| contact(depth).1);
        let force = contact(DEPTH).0;
        assert!(
            (slope / force - 1.0).abs() < DIFFERENCE,
            "{name}: {slope} against {force}"
        );
    }
}

#[test]
fn the_stiffness_on_a_half_space_is_twice_modulus_times_radius() {
    for Form { name, contact, .. } in FORMS.iter().filter(|form| form.name != "winkler") {
        let slope = derivative(|depth| contact(depth).0);
        let stiffness = 2.0 * MODULUS * contact(DEPTH).2;
        assert!(
            (slope / stiffness - 1.0).abs() < DIFFERENCE,
            "{name}: {slope} against {stiffness}"
        );
    }
}

#[test]
fn the_stiffness_of_a_sphere_is_that_of_its_contact_radius() {
    let at = |a: f64| sphere::from_contact_radius(RADIUS, MODULUS, a);
    for a in [0.02, 0.4, 0.7, 1.9] {
        let (less, more) = (at(a * (1.0 - 1e-4)), at(a * (1.0 + 1e-4)));
        let slope = (more.force - less.force) / (more.penetration - less.penetration);
        // The error is the square of the step, 1e-4 of a. The sphere's force grows steeply near a = R, where the factor
        // is about (R/(R − a))².
        assert!(
            (slope / (2.0 * MODULUS * a) - 1.0).abs() < 1e-8 * (RADIUS / (RADIUS - a)).powi(2),
            "{a}"
        );
    }
}

#[test]
fn the_mean_pressures_have_their_known_ratios() {
    let hertz = hertz::from_penetration(RADIUS, MODULUS, DEPTH);
    let punch = flat_punch::from_penetration(RADIUS, MODULUS, DEPTH);
    let winkler = winkler::from_penetration(RADIUS, COMPLIANCE, DEPTH);
    let cone = cone::from_penetration(ANGLE, MODULUS, DEPTH);
    let mean = |force: f64, radius: f64| force / (PI * radius * radius);
    let pairs = [
        (
            mean(hertz.force, hertz.contact_radius),
            2.0 / 3.0 * hertz.peak_pressure,
        ),
        (
            mean(hertz.force, hertz.contact_radius),
            hertz.mean_pressure(),
        ),
        (
            mean(punch.force, punch.contact_radius),
            punch.mean_pressure(),
        ),
        (
            winkler.force / winkler.contact_area,
            winkler.mean_pressure(),
        ),
        (mean(cone.force, cone.contact_radius), cone.mean_pressure),
    ];
    for (found, wanted) in pairs {
        // A dozen roundings.
        assert!(
            (found / wanted - 1.0).abs() < 3e-15,
            "{found} against {wanted}"
        );
    }
}

#[test]
fn the_pressure_vanishes_outside_and_the_peak_is_on_the_axis() {
    for Form {
        name,
        contact,
        pressure,
        ..
    } in FORMS
    {
        let radius = contact(DEPTH).2;
        assert_eq!(pressure(1.000_001 * radius), 0.0, "{name}");
    }
    let hertz = hertz::from_penetration(RADIUS, MODULUS, DEPTH);
    assert_eq!(hertz.pressure(0.0), hertz.peak_pressure);
    assert_eq!(
        cone::from_penetration(ANGLE, MODULUS, DEPTH).pressure(0.0),
        f64::INFINITY
    );
}

#[test]
fn force_and_penetration_give_the_same_contact() {
    let close = |found: f64, wanted: f64| (found / wanted - 1.0).abs() < 3e-15;
    let force = hertz::from_penetration(RADIUS, MODULUS, DEPTH).force;
    assert!(close(
        hertz::from_force(RADIUS, MODULUS, force).penetration,
        DEPTH
    ));
    let force = cone::from_penetration(ANGLE, MODULUS, DEPTH).force;
    assert!(close(
        cone::from_force(ANGLE, MODULUS, force).penetration,
        DEPTH
    ));
    let force = flat_punch::from_penetration(RADIUS, MODULUS, DEPTH).force;
    assert!(close(
        flat_punch::from_force(RADIUS, MODULUS, force).penetration,
        DEPTH
    ));
    for shape in [BLUNT, POINTED] {
        let force = power_law::from_penetration(shape, MODULUS, DEPTH).force;
        let found = power_law::from_force(shape, MODULUS, force).penetration;
        assert!(close(found, DEPTH), "{found}");
    }
    let force = winkler::from_penetration(RADIUS, COMPLIANCE, DEPTH).force;
    assert!(close(
        winkler::from_force(RADIUS, COMPLIANCE, force).penetration,
        DEPTH
    ));
}

#[test]
fn without_a_force_there_is_no_pressure() {
    assert_eq!(hertz::from_force(RADIUS, MODULUS, 0.0).peak_pressure, 0.0);
    assert_eq!(hertz::from_force(RADIUS, MODULUS, 0.0).pressure(0.0), 0.0);
    assert_eq!(
        winkler::from_force(RADIUS, COMPLIANCE, 0.0).peak_pressure,
        0.0
    );
}

#[test]
fn prescribed_values_are_returned_bit_for_bit() {
    // values whose powers and roots are not exact
    for given in [0.1, 0.7, 1.3e-5] {
        let forces = [
            hertz::from_force(RADIUS, MODULUS, given).force,
            cone::from_force(ANGLE, MODULUS, given).force,
            flat_punch::from_force(RADIUS, MODULUS, given).force,
            power_law::from_force(BLUNT, MODULUS, given).force,
            winkler::from_force(RADIUS, COMPLIANCE, given).force,
        ];
        assert_eq!(forces.map(f64::to_bits), [given.to_bits(); 5]);
        let depths = [
            hertz::from_penetration(RADIUS, MODULUS, given).penetration,
            cone::from_penetration(ANGLE, MODULUS, given).penetration,
            flat_punch::from_penetration(RADIUS, MODULUS, given).penetration,
            power_law::from_penetration(BLUNT, MODULUS, given).penetration,
            winkler::from_penetration(RADIUS, COMPLIANCE, given).penetration,
        ];
        assert_eq!(depths.map(f64::to_bits), [given.to_bits(); 5]);
    }
}
