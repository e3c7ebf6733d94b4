//! The integral equation against closed forms, reference numbers and itself.

use pellicle_influence::ElasticBodies;
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};

use super::*;
use crate::reference::{cone, hertz, sphere};

fn half_space(counterbody: Option<Material>) -> AxisymmetricElasticity {
    let body = Foundation::half_space(Material::new(0.91, 0.3).unwrap());
    AxisymmetricElasticity::new(&ElasticBodies::new(body, counterbody))
}

/// A bonded layer of thickness 1 and E* = 1 on a rigid base.
fn on_rigid_base(nu: f64) -> AxisymmetricElasticity {
    let material = Material::new(1.0 - nu * nu, nu).unwrap();
    let layer = Layer::new(1.0, material, Interface::Bonded).unwrap();
    AxisymmetricElasticity::new(&Foundation::new(vec![layer], Base::Rigid).unwrap().into())
}

/// Three layers, one above a spring and one free to slide, on a half-space.
fn stack() -> ElasticBodies {
    let layer = |thickness, modulus, nu, interface| {
        Layer::new(thickness, Material::new(modulus, nu).unwrap(), interface).unwrap()
    };
    let layers = vec![
        layer(0.1, 30.0, 0.25, Interface::Bonded),
        layer(0.4, 0.5, 0.45, Interface::Frictionless),
        layer(1.0, 4.0, 0.3, Interface::Bonded),
    ];
    let base = Base::HalfSpace(Material::new(1.0, 0.3).unwrap());
    ElasticBodies::new(
        Foundation::new(layers, base).unwrap(),
        Some(Material::new(50.0, 0.2).unwrap()),
    )
}

#[test]
fn without_layers_the_stiffness_is_twice_the_modulus_times_the_radius() {
    for (material, modulus) in [
        (None, 1.0),
        (Some(Material::new(3.0 * 0.91, 0.3).unwrap()), 0.75),
    ] {
        let body = half_space(material);
        for radius in [1e-9, 0.7, 3e4] {
            let punch = body.punch(radius).unwrap();
            assert!((punch.stiffness / (2.0 * modulus * radius) - 1.0).abs() < 1e-14);
            assert!((punch.stiffness_slope / (2.0 * modulus) - 1.0).abs() < 1e-14);
        }
    }
}

#[test]
fn without_layers_the_contacts_are_the_closed_forms() {
    let body = half_space(None);
    let check = |profile, radius: f64, wanted: [f64; 2]| {
        let found = body.contact(profile, radius).unwrap();
        for (found, wanted) in [found.penetration, found.force].into_iter().zip(wanted) {
            // Roundings of 64 terms and more.
            assert!(
                (found / wanted - 1.0).abs() < 5e-14,
                "{profile:?} {found} {wanted}"
            );
        }
        found.energy
    };
    let paraboloid = hertz::from_contact_radius(2.0, 1.0, 0.5);
    let profile = AxisymmetricProfile::Paraboloid { radius: 2.0 };
    let energy = check(profile, 0.5, [paraboloid.penetration, paraboloid.force]);
    assert!((energy / paraboloid.strain_energy() - 1.0).abs() < 5e-14);

    let sharp = cone::from_penetration(1.1, 1.0, 0.4);
    let slope = 1.1_f64.tan().recip();
    let profile = AxisymmetricProfile::Cone {
        slope,
        tip_radius: 0.0,
    };
    let energy = check(
        profile,
        sharp.contact_radius,
        [sharp.penetration, sharp.force],
    );
    assert!((energy / sharp.strain_energy() - 1.0).abs() < 5e-14);

    for share in [0.1, 0.9, 0.999] {
        let ball = sphere::from_contact_radius(3.0, 1.0, 3.0 * share);
        let profile = AxisymmetricProfile::Sphere { radius: 3.0 };
        check(profile, 3.0 * share, [ball.penetration, ball.force]);
    }

    // F = 2 E* n/(n + 1) D a (Sneddon 1965)
    for exponent in [1.0, 1.37, 2.0, 3.5, 6.0] {
        let profile = AxisymmetricProfile::Power {
            exponent,
            length: 2.0,
        };
        let penetration = profile.half_space_penetration(0.7);
        let force = 2.0 * exponent / (exponent + 1.0) * penetration * 0.7;
        check(profile, 0.7, [penetration, force]);
    }
}

#[test]
fn a_rounded_cone_continues_its_tip_and_approaches_the_sharp_cone() {
    let body = half_space(None);
    let rounded = AxisymmetricProfile::Cone {
        slope: 0.5,
        tip_radius: 1.0,
    };
    let seam = 0.5 / 1.25_f64.sqrt();
    let ball = body
        .contact(AxisymmetricProfile::Sphere { radius: 1.0 }, seam)
        .unwrap();
    let tip = body.contact(rounded, seam).unwrap();
    assert!((tip.force / ball.force - 1.0).abs() < 1e-13);
    // dF = S dD, on both sides of the seam.
    for radius in [0.8 * seam, 1.2 * seam, 1.5 * seam] {
        assert_the_force_is_the_integral_of_the_stiffness(&body, rounded, radius);
    }
    // Far away the tip is a shift of (√(1 + m²) − 1) R.
    let sharp = AxisymmetricProfile::Cone {
        slope: 0.5,
        tip_radius: 0.0,
    };
    let [far, reference] = [rounded, sharp].map(|profile| body.contact(profile, 1e4).unwrap());
    let shift = reference.penetration - far.penetration;
    assert!(
        (shift / (1.25_f64.sqrt() - 1.0) - 1.0).abs() < 1e-3,
        "{shift}"
    );
}

fn assert_the_force_is_the_integral_of_the_stiffness(
    body: &AxisymmetricElasticity,
    profile: AxisymmetricProfile,
    radius: f64,
) {
    let at = |factor: f64| body.contact(profile, factor * radius).unwrap();
    let [less, middle, more] = [0.999, 1.0, 1.001].map(at);
    let sunk = more.penetration - less.penetration;
    let stiffness = (more.force - less.force) / sunk;
    // Of second order in the step.
    assert!(
        (stiffness / middle.punch.stiffness - 1.0).abs() < 6e-6,
        "{profile:?} {radius}"
    );
    let force = (more.energy - less.energy) / sunk;
    assert!(
        (force / middle.force - 1.0).abs() < 1e-5,
        "{profile:?} {radius}"
    );
}

#[test]
fn on_layers_force_and_energy_are_integrals_of_stiffness_and_force() {
    let body = AxisymmetricElasticity::new(&stack());
    for radius in [0.02, 0.3, 4.0, 50.0] {
        for profile in [
            AxisymmetricProfile::Paraboloid { radius: 100.0 },
            AxisymmetricProfile::Power {
                exponent: 2.6,
                length: 100.0,
            },
            AxisymmetricProfile::Cone {
                slope: 0.1,
                tip_radius: 30.0,
            },
        ] {
            assert_the_force_is_the_integral_of_the_stiffness(&body, profile, radius);
        }
    }
}

#[test]
fn the_stiffness_s_slope_is_that_of_the_density_at_the_edge() {
    let bodies = [
        on_rigid_base(0.3),
        on_rigid_base(0.5),
        AxisymmetricElasticity::new(&stack()),
    ];
    for body in bodies {
        for radius in [0.03, 0.4, 2.0, 11.0] {
            // Rounding over the step.
            assert_the_slope_is_a_difference(&body, radius, 2e-10);
        }
    }
}

fn assert_the_slope_is_a_difference(body: &AxisymmetricElasticity, radius: f64, tolerance: f64) {
    let stiffness = |factor: f64| body.punch(factor * radius).unwrap().stiffness;
    let step = 1e-3;
    // A difference of fourth order.
    let near = stiffness(1.0 + step) - stiffness(1.0 - step);
    let far = stiffness(1.0 + 2.0 * step) - stiffness(1.0 - 2.0 * step);
    let difference = (8.0 * near - far) / (12.0 * step * radius);
    let found = body.punch(radius).unwrap().stiffness_slope;
    assert!(
        (found / difference - 1.0).abs() < tolerance,
        "{radius}: {found} {difference}"
    );
}

#[test]
fn punches_on_a_layer_on_a_rigid_base_have_the_tabulated_stiffness() {
    // P/(2 E* a w) at a/h = 0.1, 0.25, 0.5, 1, 2, 4, 8, by a Fredholm equation solved elsewhere to six digits.
    let tables = [
        (
            0.3,
            [
                1.095_441, 1.267_851, 1.624_025, 2.483_525, 4.353_244, 8.178_894, 15.868_369,
            ],
        ),
        (
            0.5,
            [
                1.125_987,
                1.369_47,
                1.932_934,
                3.618_736,
                9.149_45,
                31.525_01,
                146.320_434,
            ],
        ),
    ];
    for (nu, factors) in tables {
        let body = on_rigid_base(nu);
        for (radius, factor) in [0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0]
            .into_iter()
            .zip(factors)
        {
            let found = body.punch(radius).unwrap().stiffness / (2.0 * radius);
            assert!((found / factor - 1.0).abs() < 1e-6, "{nu} {radius} {found}");
        }
    }
}

#[test]
fn cones_on_an_incompressible_layer_have_the_tabulated_force() {
    // δ tan θ/h, F over Sneddon's force at this δ: a Fredholm equation solved elsewhere to six digits.
    let table = [
        (0.1, 1.0787),
        (0.2, 1.173_64),
        (0.3, 1.288_94),
        (0.5, 1.600_21),
        (1.0, 3.044_37),
        (2.0, 9.339_32),
    ];
    let body = on_rigid_base(0.5);
    let profile = AxisymmetricProfile::Cone {
        slope: 1.0,
        tip_radius: 0.0,
    };
    for (penetration, factor) in table {
        // Regula falsi in the radius; a contact without layers has 2/π of the penetration.
        let off = |radius| body.contact(profile, radius).unwrap().penetration - penetration;
        let (mut low, mut high) = (0.3 * penetration, 1.5 * penetration);
        for _ in 0..60 {
            let middle = f64::midpoint(low, high);
            if off(middle) > 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        let force = body.contact(profile, low).unwrap().force;
        let found = force / (std::f64::consts::FRAC_2_PI * penetration * penetration);
        assert!((found / factor - 1.0).abs() < 1e-5, "{penetration} {found}");
    }
}

/// Ratios to a coating of one hundredth of the thickness, from no layer to far thinner than the contact.
#[test]
fn a_thin_coating_gives_way_to_its_base_and_pieces_do_not_show() {
    let coat = |thickness| {
        let [film, base] = [5.0, 1.0].map(|modulus| Material::new(modulus, 0.3).unwrap());
        AxisymmetricElasticity::new(&Foundation::coated(thickness, film, base).unwrap().into())
    };
    let stiffness = |thickness: f64| coat(thickness).punch(1.0).unwrap().stiffness / (2.0 / 0.91);
    let mut last = stiffness(1.0);
    for thickness in [0.3, 0.1, 0.03, 0.01, 0.003, 0.001] {
        let found = stiffness(thickness);
        assert!(found < last && found > 1.0, "{thickness} {found}");
        last = found;
    }
    // (S/2Ea − 1) decreases in proportion to the thickness, up to a logarithm.
    let ratio = (last - 1.0) / (stiffness(0.003) - 1.0);
    assert!((0.2..0.5).contains(&ratio), "{ratio}");
}

#[test]
fn layers_of_the_base_s_material_change_nothing() {
    let material = Material::new(1.0, 0.3).unwrap();
    let body = Foundation::coated(0.2, material, material).unwrap();
    let (coated, bare) = (AxisymmetricElasticity::new(&body.into()), half_space(None));
    let of = |body: &AxisymmetricElasticity| body.punch(1.7).unwrap().stiffness / body.modulus();
    assert!((of(&coated) / of(&bare) - 1.0).abs() < 1e-14);
}

#[test]
fn radii_beyond_the_shape_or_the_layers_are_refused() {
    let body = on_rigid_base(0.3);
    let refused = |found: Result<PunchContact, _>| {
        assert!(matches!(
            found,
            Err(crate::ContactError::AxisymmetricRadius { .. })
        ));
    };
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY, 2049.0] {
        refused(body.punch(radius));
    }
    let ball = AxisymmetricProfile::Sphere { radius: 2.0 };
    refused(body.contact(ball, 2.0).map(|found| found.punch));
}

/// β = η E*/2a far above 1: springs alone, each as high as the indenter presses it.
#[test]
fn a_soft_film_is_a_bed_of_springs() {
    let body = half_space(None).with_springs(1e9);
    let paraboloid = AxisymmetricProfile::Paraboloid { radius: 2.0 };
    let found = body.contact(paraboloid, 0.5).unwrap();
    // D = a²/2R, F = πa⁴/4Rη, S = πa²/η, dS/da = 2πa/η; the half-space adds some 1/β.
    let wanted = [
        0.0625,
        std::f64::consts::PI * 0.0625 / 8e9,
        std::f64::consts::PI * 0.25e-9,
        std::f64::consts::PI * 1e-9,
    ];
    let found = [
        found.penetration,
        found.force,
        found.punch.stiffness,
        found.punch.stiffness_slope,
    ];
    for (found, wanted) in found.into_iter().zip(wanted) {
        assert!((found / wanted - 1.0).abs() < 1e-8, "{found:e} {wanted:e}");
    }
}

#[test]
fn through_a_film_force_energy_and_slope_are_integrals_and_derivatives() {
    for compliance in [3.0, 0.1, 3e-3] {
        for body in [
            half_space(None),
            on_rigid_base(0.5),
            AxisymmetricElasticity::new(&stack()),
        ] {
            let body = body.with_springs(compliance);
            for radius in [0.3, 2.0] {
                let paraboloid = AxisymmetricProfile::Paraboloid { radius: 100.0 };
                assert_the_force_is_the_integral_of_the_stiffness(&body, paraboloid, radius);
                assert_the_slope_is_a_difference(&body, radius, 1e-8);
            }
        }
    }
}

#[test]
fn a_stiff_film_gives_way_to_the_bare_surface() {
    let stiffness = |compliance| stack_with(compliance).punch(0.3).unwrap().stiffness;
    let bare = AxisymmetricElasticity::new(&stack())
        .punch(0.3)
        .unwrap()
        .stiffness;
    let [softer, stiffer] = [1e-3, 1e-4].map(|compliance| 1.0 - stiffness(compliance) / bare);
    assert!(
        stiffer > 0.0 && stiffer < 0.2 * softer,
        "{softer} {stiffer}"
    );
}

fn stack_with(compliance: f64) -> AxisymmetricElasticity {
    AxisymmetricElasticity::new(&stack()).with_springs(compliance)
}

#[test]
fn a_film_too_stiff_to_be_resolved_is_refused() {
    let refused = stack_with(1e-7).punch(1.0);
    assert!(matches!(
        refused,
        Err(crate::ContactError::AxisymmetricRadius { .. })
    ));
}
