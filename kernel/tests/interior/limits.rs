//! Closed forms and limits: a half-space, equal layers, springs from bond to slip, deep and long waves.

use super::*;

#[test]
fn a_half_space_decays_as_in_the_textbook() {
    for nu in [0.0, 0.3, 0.5] {
        let body = material(2.0, nu);
        let unit = 2.0 * body.shear_modulus() * 3.0;
        let interior = Foundation::half_space(body).interior(3.0).unwrap();
        for t in [0.0_f64, 0.5, 3.0, 40.0, 600.0] {
            let decay = (-t).exp();
            let place = interior.at(t / 3.0, Side::Above);
            let check = |found: f64, wanted: f64| {
                // the roundings of t in e^{−t}, and a few
                let bound = 1e-15 * (2.0 + t) * (1.0 + t) * decay;
                assert!(
                    (found - wanted * decay).abs() <= bound,
                    "{found:e} {wanted:e}"
                );
            };
            let (b, w) = (1.0 - 2.0 * nu, 2.0 * (1.0 - nu));
            let normal = place.normal;
            check(unit * normal.horizontal_displacement, t - b);
            check(unit * normal.vertical_displacement, w + t);
            check(normal.longitudinal_stress, t - 1.0);
            check(normal.transverse_stress, -2.0 * nu);
            check(normal.normal_stress, -(1.0 + t));
            check(normal.shear_stress, -t);
            let shear = place.shear;
            check(unit * shear.horizontal_displacement, w - t);
            check(unit * shear.vertical_displacement, -(b + t));
            check(shear.longitudinal_stress, 2.0 - t);
            check(shear.transverse_stress, 2.0 * nu);
            check(shear.normal_stress, t);
            check(shear.shear_stress, t - 1.0);
            let antiplane = place.antiplane;
            check(unit * antiplane.displacement, 2.0);
            check(antiplane.vertical_shear_stress, -1.0);
            check(antiplane.lateral_shear_stress, 1.0);
        }
    }
}

fn numbers(place: &Amplitudes) -> [f64; 15] {
    let list = |state: &InPlane| {
        [
            state.horizontal_displacement,
            state.vertical_displacement,
            state.longitudinal_stress,
            state.transverse_stress,
            state.normal_stress,
            state.shear_stress,
        ]
    };
    let [normal, shear] = [list(&place.normal), list(&place.shear)];
    let Antiplane {
        displacement,
        vertical_shear_stress,
        lateral_shear_stress,
    } = place.antiplane;
    let antiplane = [displacement, vertical_shear_stress, lateral_shear_stress];
    std::array::from_fn(|i| match i {
        0..6 => normal[i],
        6..12 => shear[i - 6],
        _ => antiplane[i - 12],
    })
}

#[test]
fn the_homogeneous_body_plus_the_correction_is_the_layered_body() {
    for foundation in foundations() {
        let homogeneous = Foundation::half_space(foundation.surface_material());
        for k in WAVENUMBERS {
            let (layered, plain) = (
                foundation.interior(k).unwrap(),
                homogeneous.interior(k).unwrap(),
            );
            let thickness = foundation.interface_depth(1).min(1.0);
            for part in [0.0, 0.3, 1.0] {
                let depth = part * thickness;
                let [whole, plain] =
                    [&layered, &plain].map(|of| numbers(&of.at(depth, Side::Above)));
                let correction = numbers(&layered.correction(depth).unwrap());
                for i in 0..15 {
                    // Displacements times 2 G k and stresses are compared on one loose scale: the size of the state.
                    let unit = 2.0 * foundation.surface_material().shear_modulus() * k;
                    let scale = |list: &[f64]| {
                        let of = |i: usize, x: &f64| {
                            x.abs() * if IS_DISPLACEMENT[i] { unit } else { 1.0 }
                        };
                        list.iter()
                            .enumerate()
                            .fold(0.0, |size: f64, (i, x)| size.max(of(i, x)))
                    };
                    let size = scale(&whole) + scale(&plain);
                    let error = (plain[i] + correction[i] - whole[i]).abs()
                        * if IS_DISPLACEMENT[i] { unit } else { 1.0 };
                    // The errors of both eliminations, and of e^{−kz} for a rounded k z.
                    assert!(
                        error <= 1e-13 * size,
                        "{i} {error:e} {size:e} k = {k} {foundation:?}"
                    );
                }
            }
            assert_eq!(
                layered.correction(2.0 * thickness).is_none(),
                !foundation.layers().is_empty()
            );
        }
    }
}

/// Whether each of [`numbers`] is a displacement.
const IS_DISPLACEMENT: [bool; 15] = [
    true, true, false, false, false, false, true, true, false, false, false, false, true, false,
    false,
];

#[test]
fn equal_layers_need_no_correction() {
    let body = material(3.0, 0.3);
    let layers = vec![layer(0.2, 3.0, 0.3, Interface::Bonded); 3];
    let foundation = Foundation::new(layers, Base::HalfSpace(body)).unwrap();
    for k in WAVENUMBERS {
        let interior = foundation.interior(k).unwrap();
        let correction = numbers(&interior.correction(0.1).unwrap());
        assert!(correction.iter().all(|x| x.abs() <= 0.0), "{correction:?}");
    }
}

/// The largest difference of the two bodies' states at `k = 1`, over the size of the second.
fn difference(found: &Foundation, wanted: &Foundation, depth: f64) -> f64 {
    let [found, wanted] =
        [found, wanted].map(|body| numbers(&body.interior(1.0).unwrap().at(depth, Side::Above)));
    let size = wanted.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    let largest = found
        .iter()
        .zip(&wanted)
        .fold(0.0_f64, |largest, (x, y)| largest.max((x - y).abs()));
    largest / size
}

#[test]
fn a_spring_ranges_from_the_bonded_to_the_frictionless_interface() {
    for base in [Base::HalfSpace(material(1.0, 0.4)), Base::Rigid] {
        let coated =
            |interface| Foundation::new(vec![layer(1.0, 3.0, 0.3, interface)], base).unwrap();
        let bonded = coated(Interface::Bonded);
        let sliding = coated(Interface::Frictionless);
        for depth in [0.0, 0.6, 1.0, 1.5] {
            if depth > 1.0 && base == Base::Rigid {
                continue;
            }
            for small in [1e-6, 1e-9] {
                // of first order in the compliance, whose units are 1/E here
                assert!(difference(&coated(spring(small, small)), &bonded, depth) < 10.0 * small);
                assert!(
                    difference(&coated(spring(0.0, 1.0 / small)), &sliding, depth) < 10.0 * small
                );
            }
        }
    }
}

#[test]
fn short_waves_are_finite_at_every_depth_and_long_ones_depend_on_the_base_alone() {
    for foundation in foundations() {
        for k in [700.0, 5e3, 1e9, 1e300] {
            let interior = foundation.interior(k).unwrap();
            for depth in [0.0, 0.1, 0.3, 1.0, 1.5, 1e3, f64::INFINITY] {
                let place = interior.at(depth, Side::Below);
                assert!(
                    numbers(&place).iter().all(|x| x.is_finite()),
                    "{k} {depth} {foundation:?}"
                );
                if let Some(correction) = interior.correction(depth) {
                    assert!(
                        numbers(&correction).iter().all(|x| x.is_finite()),
                        "{k} {depth}"
                    );
                }
            }
        }
        if let Base::HalfSpace(base) = foundation.base() {
            let (k, alone) = (1e-9, Foundation::half_space(base));
            let [found, wanted] = [&foundation, &alone].map(|body| {
                body.interior(k)
                    .unwrap()
                    .at(0.0, Side::Below)
                    .normal
                    .vertical_displacement
            });
            // The layers change k u by their thickness times k, with their compliance of up to 1e3.
            assert!((k * (found - wanted)).abs() < 1e-4, "{foundation:?}");
        }
    }
}

#[test]
fn invalid_wavenumbers_are_refused() {
    let half_space = Foundation::half_space(material(2.0, 0.3));
    for k in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(half_space.interior(k).is_err());
    }
}
