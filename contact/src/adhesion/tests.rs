//! Adhesive contacts against closed forms, a table, and the least energy.

use std::f64::consts::PI;

use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};

use super::*;
use crate::ContactError;
use crate::axisymmetric::{AxisymmetricElasticity, AxisymmetricProfile};

const PARABOLOID: AxisymmetricProfile = AxisymmetricProfile::Paraboloid { radius: 1.0 };

fn half_space(modulus: f64) -> AxisymmetricElasticity {
    let material = Material::new(modulus * 0.91, 0.3).unwrap();
    AxisymmetricElasticity::new(&Foundation::half_space(material).into())
}

/// A bonded layer of thickness 1 and E* = 1 on a rigid base.
fn on_rigid_base(nu: f64) -> AxisymmetricElasticity {
    let material = Material::new(1.0 - nu * nu, nu).unwrap();
    let layer = Layer::new(1.0, material, Interface::Bonded).unwrap();
    AxisymmetricElasticity::new(&Foundation::new(vec![layer], Base::Rigid).unwrap().into())
}

/// Two films on a half-space.
fn stack() -> AxisymmetricElasticity {
    let layer = |thickness, modulus| {
        Layer::new(
            thickness,
            Material::new(modulus, 0.3).unwrap(),
            Interface::Bonded,
        )
        .unwrap()
    };
    let base = Base::HalfSpace(Material::new(1.0, 0.3).unwrap());
    let body = Foundation::new(vec![layer(0.05, 20.0), layer(0.4, 0.2)], base).unwrap();
    AxisymmetricElasticity::new(&body.into())
}

fn jkr(body: AxisymmetricElasticity, profile: AxisymmetricProfile, work: f64) -> AdhesiveCurve {
    AdhesiveCurve::new(
        body,
        profile,
        Adhesion {
            work,
            law: AdhesionLaw::Jkr,
        },
    )
    .unwrap()
}

fn assert_near(found: f64, wanted: f64, tolerance: f64) {
    assert!(
        (found / wanted - 1.0).abs() < tolerance,
        "{found:e} {wanted:e}"
    );
}

#[test]
fn on_a_half_space_the_contacts_are_those_of_johnson_kendall_and_roberts() {
    let (modulus, radius, work) = (3e9, 2e-6, 0.04);
    let profile = AxisymmetricProfile::Paraboloid { radius };
    let curve = jkr(half_space(modulus), profile, work);
    let unit = PI * work * radius;
    assert_near(curve.pull_off().force, -1.5 * unit, 1e-12);
    // a³ = 3R/4E* (F + 3πwR + √(6πwR F + (3πwR)²))
    let cube = |force: f64| {
        let root = (6.0 * unit * force + (3.0 * unit).powi(2)).max(0.0).sqrt();
        0.75 * radius / modulus * (force + 3.0 * unit + root)
    };
    // The place of a least value is known to the root of the accuracy.
    assert_near(curve.pull_off().radius.powi(3), cube(-1.5 * unit), 1e-6);
    for force in [-1.4 * unit, 0.0, 10.0 * unit, 1e4 * unit] {
        let found = curve.at_force(force).unwrap();
        assert_near(found.radius.powi(3), cube(force), 1e-11);
        // D = a²/R − √(2πaw/E*)
        let a = found.radius;
        let wanted = a * a / radius - (2.0 * PI * a * work / modulus).sqrt();
        assert!((found.penetration - wanted).abs() < 1e-12 * a * a / radius);
    }
    // At the least penetration D = −3/4 (π² w² R/E*²)^⅓ and F = −5/6 πwR.
    let last = curve.last_contact();
    let wanted = -0.75 * ((PI * work / modulus).powi(2) * radius).cbrt();
    assert_near(last.penetration, wanted, 1e-12);
    assert_near(last.force, -5.0 / 6.0 * unit, 1e-6);
    assert!(
        curve
            .at_penetration(1.0001 * last.penetration)
            .unwrap()
            .is_none()
    );
    // At D = 0 F = −4/3 πwR.
    let jump_in = curve.at_penetration(0.0).unwrap().unwrap();
    assert_near(jump_in.force, -4.0 / 3.0 * unit, 1e-11);
    // μ = (R w²/(E*² z₀³))^⅓
    let tabor = curve.tabor_number().unwrap().unwrap();
    assert_near(
        tabor,
        (radius * (work / modulus).powi(2) / 2.7e-29).cbrt(),
        1e-12,
    );
}

#[test]
fn dmt_takes_the_pull_of_the_undeformed_shape_from_the_force() {
    let (radius, work) = (2.0, 1e-3);
    let dmt = Adhesion {
        work,
        law: AdhesionLaw::Dmt,
    };
    for profile in [
        AxisymmetricProfile::Paraboloid { radius },
        AxisymmetricProfile::Sphere { radius },
    ] {
        let curve = AdhesiveCurve::new(half_space(1.0), profile, dmt).unwrap();
        let pull = 2.0 * PI * work * radius;
        assert_near(curve.pull_off().force, -pull, 1e-15);
        let found = curve.at_force(0.0).unwrap();
        assert_near(found.force_without, pull, 1e-12);
        // a³ = 3RF/4E*; a sphere is stiffer by a few a²/R².
        assert_near(found.radius.powi(3), 0.75 * radius * pull, 0.02);
        assert!(curve.at_penetration(-1e-9).unwrap().is_none());
        let touching = curve.at_penetration(0.0).unwrap().unwrap();
        assert_near(touching.force, -pull, 1e-15);
        assert!(curve.work_lost().unwrap().abs() < 1e-18);
    }
    let cone = AxisymmetricProfile::Cone {
        slope: 0.5,
        tip_radius: 0.0,
    };
    let refused = AdhesiveCurve::new(half_space(1.0), cone, dmt);
    assert!(matches!(refused, Err(ContactError::NoDmtFormula)));
}

#[test]
fn on_a_layer_on_a_rigid_base_the_pull_off_is_the_tabulated_one() {
    // w/(E* h), pull-off force over πwR and contact radius over h for R = h: computed elsewhere.
    let table = [
        (1e-4, 1.5003, 0.0707),
        (1e-3, 1.5027, 0.1525),
        (1e-2, 1.523, 0.3308),
        (0.1, 1.6267, 0.7181),
        (1.0, 1.7936, 1.439),
    ];
    for (work, force, radius) in table {
        let found = jkr(on_rigid_base(0.3), PARABOLOID, work).pull_off();
        // Half of the last digit printed, and the steps of the table's search for the radius.
        assert!(
            (-found.force / (PI * work) - force).abs() < 6e-5,
            "{work}: {found:?}"
        );
        assert!(
            (found.radius - radius).abs() < 2e-3 * radius,
            "{work}: {found:?}"
        );
    }
}

#[test]
fn on_a_film_much_thinner_than_the_contact_the_pull_off_approaches_two() {
    let factor =
        |work: f64| -jkr(on_rigid_base(0.3), PARABOLOID, work).pull_off().force / (PI * work);
    let factors = [1.0, 1e2, 1e4].map(factor);
    assert!(factors.is_sorted() && factors[2] < 2.0, "{factors:?}");
    // The edge of a punch on a film of thickness h adds a part h/a, here 1/16, to its stiffness.
    assert!(factors[2] > 1.95, "{factors:?}");
}

/// On springs alone `F = πa⁴/4Rη − πa²/η √(2wη)`, least at `a² = 2R√(2wη)`: −2π w R.
#[test]
fn on_a_bed_of_springs_the_pull_off_is_two() {
    let (work, compliance) = (1e-3, 1e5);
    let found = jkr(half_space(1.0).with_springs(compliance), PARABOLOID, work).pull_off();
    // The half-space adds 1/β, where β = η E*/2a is some 1e4.
    assert_near(found.force, -2.0 * PI * work, 1e-3);
    assert_near(
        found.radius.powi(2),
        2.0 * (2.0 * work * compliance).sqrt(),
        2e-3,
    );
}

/// Total energy (J) at a penetration (m) and a contact radius (m): elastic energy of the contact with this displacement
/// inside, less w times the area.
fn total_energy(
    body: &AxisymmetricElasticity,
    profile: AxisymmetricProfile,
    work: f64,
    [penetration, radius]: [f64; 2],
) -> f64 {
    let without = body.contact(profile, radius).unwrap();
    let back = without.penetration - penetration;
    let elastic =
        without.energy - without.force * back + 0.5 * without.punch.stiffness * back * back;
    elastic - work * PI * radius * radius
}

/// Neither `dS/da` nor the formula of δ is in this energy, only forces, stiffnesses and their energies.
#[test]
fn stable_contacts_have_the_least_energy_at_their_penetration() {
    let cone = AxisymmetricProfile::Cone {
        slope: 0.3,
        tip_radius: 0.0,
    };
    let cases = [
        (half_space(1.0).with_springs(0.5), PARABOLOID),
        (stack().with_springs(0.1), PARABOLOID),
        (half_space(1.0), cone),
        (stack(), cone),
        (stack(), PARABOLOID),
        (on_rigid_base(0.5), cone),
    ];
    for (body, profile) in cases {
        let work = 0.01;
        let curve = jkr(body.clone(), profile, work);
        for penetration in [0.3 * curve.last_contact().penetration, 0.02] {
            let found = curve.at_penetration(penetration).unwrap().unwrap();
            let energy = |factor: f64| {
                total_energy(&body, profile, work, [penetration, factor * found.radius])
            };
            let [less, least, more] = [0.999, 1.0, 1.001].map(energy);
            let curvature = less + more - 2.0 * least;
            assert!(curvature > 0.0);
            // The place of the minimum of a parabola through three points, in steps of 1e-3: of second order.
            let place = 0.5 * (less - more) / curvature;
            assert!(place.abs() < 3e-3, "{profile:?} {penetration}: {place}");
            assert!((least / found.energy - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn the_work_lost_is_the_area_of_the_loop() {
    let curve = jkr(stack(), PARABOLOID, 0.01);
    let [from, to] = [
        curve.last_contact(),
        curve.at_penetration(0.0).unwrap().unwrap(),
    ]
    .map(|contact| contact.radius);
    let steps = 400;
    let at = |step: u32| {
        curve
            .at_radius(from + (to - from) * f64::from(step) / f64::from(steps))
            .unwrap()
    };
    let parts = (0..steps).map(|step| {
        let [one, next] = [at(step), at(step + 1)];
        -f64::midpoint(one.force, next.force) * (next.penetration - one.penetration)
    });
    // The trapezoidal rule.
    assert_near(curve.work_lost().unwrap(), parts.sum(), 1e-4);
}

#[test]
fn forces_below_the_pull_off_and_works_that_are_not_positive_are_refused() {
    let curve = jkr(half_space(1.0), PARABOLOID, 0.01);
    let below = curve.at_force(1.01 * curve.pull_off().force);
    assert!(matches!(below, Err(ContactError::BeyondPullOff { .. })));
    for work in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = AdhesiveCurve::new(
            half_space(1.0),
            PARABOLOID,
            Adhesion {
                work,
                law: AdhesionLaw::Jkr,
            },
        );
        assert!(matches!(refused, Err(ContactError::WorkOfAdhesion { .. })));
    }
    // The sphere would have to be in contact beyond its equator.
    let ball = AxisymmetricProfile::Sphere { radius: 1.0 };
    assert!(jkr(half_space(1.0), ball, 0.01).at_force(1e3).is_err());
}

/// A stiff skin of 0.1 µm on a gel, under a ball of 5 µm with 50 mJ/m²: narrow contacts are held by the skin, wide ones
/// by the gel, and both have a least force and a least penetration.
#[test]
fn of_two_branches_the_wide_one_ends_first_and_the_lower_one_last() {
    let material = |modulus, nu| Material::new(modulus, nu).unwrap();
    let skin = Layer::new(1e-7, material(1e9, 0.3), Interface::Bonded).unwrap();
    let body = Foundation::new(vec![skin], Base::HalfSpace(material(1e5, 0.49))).unwrap();
    let ball = AxisymmetricProfile::Paraboloid { radius: 5e-6 };
    let curve = jkr(AxisymmetricElasticity::new(&body.into()), ball, 0.05);
    let steps: i32 = 400;
    let radius = |step: i32| 1e-8 * 400_f64.powf(f64::from(step) / f64::from(steps));
    let contacts: Vec<_> = (0..=steps)
        .map(|step| curve.at_radius(radius(step)).unwrap())
        .collect();
    let turns = |value: fn(&AdhesiveContact) -> f64| {
        let turns = contacts
            .windows(3)
            .filter(move |of| value(&of[1]) < value(&of[0]) && value(&of[1]) < value(&of[2]));
        turns.map(|of| of[1]).collect::<Vec<_>>()
    };
    let [narrow, wide] = turns(|of| of.force)[..] else {
        panic!("two turns of the force")
    };
    assert!(wide.force < 2.0 * narrow.force);
    assert_near(curve.pull_off().force, wide.force, 1e-3);
    assert_near(curve.end_under_force().force, wide.force, 1e-3);
    let [narrow, wide] = turns(|of| of.penetration)[..] else {
        panic!("two turns of the penetration")
    };
    assert!(narrow.penetration < wide.penetration);
    assert_near(curve.last_contact().penetration, narrow.penetration, 1e-3);
    let end = curve.end_under_penetration();
    assert_near(end.penetration, wide.penetration, 1e-3);
    // Above the end of the wide branch a withdrawn contact is wide, below it narrow.
    for (penetration, is_wide) in [
        (0.99 * end.penetration, true),
        (1.01 * end.penetration, false),
    ] {
        let found = curve.at_penetration(penetration).unwrap().unwrap();
        // The accuracy of the contacts times what cancels in their penetration.
        assert_near(found.penetration, penetration, 1e-9);
        assert_eq!(found.radius > end.radius, is_wide, "{}", found.radius);
        let further = curve.at_radius(1.001 * found.radius).unwrap();
        assert!(further.penetration > found.penetration);
    }
}
