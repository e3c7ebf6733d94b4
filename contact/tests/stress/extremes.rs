//! Extremes of the stresses compared with closed forms and sampling.

use super::*;
use pellicle_kernel::{Base, Interface, Layer};

#[test]
fn von_mises_stress_under_hertz_is_found_in_value_and_depth() {
    let model = model(&half_space(), Paraboloid::new(1.0).unwrap());
    let [largest, depth] = on_the_axis();
    assert_relative_eq!(largest, 0.620, max_relative = 1e-3);
    for elements in [64, 256] {
        let path = solved(&model, elements, 1e-3);
        let exact = hertz::from_force(1.0, STEEL.0 / (1.0 - STEEL.1 * STEEL.1), 1e-3);
        let found = stress_extremes(&path, 0, &whole(BodyStrengths::default())).unwrap();
        let mises = found.bodies[0].max_von_mises.unwrap();
        let error = (mises.value / exact.peak_pressure - largest).abs();
        assert!(error < 6e-3 / elements as f64, "{elements}: {mises:?}");
        assert!(mises.resolved && error * exact.peak_pressure < mises.estimate.unwrap());
        // At its peak a stress changes little, so the depth is known only to the square root of its accuracy.
        assert_relative_eq!(
            mises.at[2] / exact.contact_radius,
            depth,
            max_relative = 1e-2
        );
        let shear = found.bodies[0].max_shear.unwrap().value;
        assert_relative_eq!(2.0 * shear, mises.value, max_relative = 1e-9);
    }
}

/// A ball pressed on a coating of this thickness, on 64 × 64 elements, and the extremes under sliding.
fn coating_under_a_ball(thickness: f64) -> (LoadingPath, StressModel, StressExtremes) {
    let model = model(&coated(thickness), Paraboloid::new(1.0).unwrap());
    let (path, stress) = (solved(&model, 64, 1e-3), sliding_coating(thickness));
    let extremes = stress_extremes(&path, 0, &stress).unwrap();
    (path, stress, extremes)
}

#[test]
fn the_tension_on_the_underside_of_a_layer_of_five_radii_is_found() {
    // A stiff plate on a soft base bends, however thick.
    let (plate, base) = (Material::new(400.0, 0.22), Material::new(3.0, 0.35));
    let foundation = Foundation::coated(1.0, plate.unwrap(), base.unwrap()).unwrap();
    let none = BodyStrengths::default();
    let stress = StressModel {
        bodies: vec![
            body("layer[0]", 0.0, 1.0, none),
            body("substrate", 1.0, f64::INFINITY, none),
        ],
        ..StressModel::default()
    };
    let path = solved(&model(&foundation, Paraboloid::new(20.0).unwrap()), 64, 0.3);
    let radius = path.steps[0].summary.contact_radius;
    assert!((0.18..0.25).contains(&radius), "{radius}");
    let found = stress_extremes(&path, 0, &stress).unwrap();
    let found = found.bodies[0].max_principal.unwrap();
    let field = StressField::new(&path, 0, stress.sliding).unwrap();
    let underside = field.at([0.0; 2], Depth::above(1.0)).unwrap();
    assert_relative_eq!(found.value, underside.principal()[0], max_relative = 1e-6);
    assert!(found.resolved && found.at[2] >= 1.0, "{found:?}");
}

#[test]
fn of_two_peaks_at_the_ends_of_a_layer_the_larger_is_found() {
    // Under a layer that slides, a plate that is stiffer on top bends; its shear is 1 % larger on the underside.
    let layer = |thickness: f64, modulus: f64, ratio: f64, interface: Interface| {
        let material = Material::new(modulus, ratio).unwrap();
        Layer::new(thickness, material, interface).unwrap()
    };
    let (top, thickness, parts) = (1.0, 0.291, 8);
    let part = |i: i32| {
        let modulus = 22.4 - 10.3 * (f64::from(i) + 0.5) / f64::from(parts);
        let thickness = thickness / f64::from(parts);
        layer(thickness, modulus, 0.158, Interface::Bonded)
    };
    let layers = std::iter::once(layer(top, 1.0, 0.314, Interface::Frictionless));
    let base = Material::new(1.067, 0.422).unwrap();
    let layers = layers.chain((0..parts).map(part)).collect();
    let foundation = Foundation::new(layers, Base::HalfSpace(base)).unwrap();
    let stress = StressModel {
        bodies: vec![body(
            "plate",
            top,
            top + thickness,
            BodyStrengths::default(),
        )],
        ..StressModel::default()
    };
    let path = solved(
        &model(&foundation, Paraboloid::new(7.5).unwrap()),
        64,
        1.2e-3,
    );
    let found = stress_extremes(&path, 0, &stress).unwrap();
    let found = found.bodies[0].max_shear.unwrap();
    let field = StressField::new(&path, 0, stress.sliding).unwrap();
    let shear = |depth: Depth| field.at([0.0; 2], depth).unwrap().max_shear();
    for end in [Depth::below(top), Depth::above(top + thickness)] {
        let end = shear(end);
        assert!(found.value >= (1.0 - 1e-6) * end, "{found:?} {end:e}");
    }
    // The steps of the grading are in its error.
    let step = foundation.interface_depth(parts.unsigned_abs() as usize);
    let jump = (shear(Depth::above(step)) - shear(Depth::below(step))).abs();
    let part = jump / shear(Depth::above(step)).max(shear(Depth::below(step)));
    assert!(
        part > 0.01 && found.estimate.unwrap() > 0.5 * part * found.value,
        "{found:?} {part}"
    );
}

/// Points that fill the cube from −1 to 1 evenly: multiples of powers of the root of x⁴ = x + 1.
fn spread(i: u32) -> [f64; 3] {
    [1, 2, 3].map(|power| {
        2.0 * (0.5 + f64::from(i) / 1.220_744_084_605_76_f64.powi(power)).fract() - 1.0
    })
}

#[test]
fn no_sampled_stress_exceeds_the_extremes_and_each_lies_at_its_reported_position() {
    let thickness = 0.02;
    let (path, stress, found) = coating_under_a_ball(thickness);
    let field = StressField::new(&path, 0, stress.sliding).unwrap();
    let element = path.grid.element_side();
    let quantities: [fn(&SubsurfaceState) -> f64; 4] = [
        SubsurfaceState::von_mises,
        |state| state.principal()[0],
        |state| -state.principal()[2],
        SubsurfaceState::max_shear,
    ];
    for (part, extremes) in stress.bodies.iter().zip(&found.bodies) {
        let reported = [
            extremes.max_von_mises.unwrap(),
            extremes.max_principal.unwrap(),
            extremes.min_principal.unwrap(),
            extremes.max_shear.unwrap(),
        ];
        for (index, extreme) in reported.iter().enumerate() {
            let [x, y, z] = extreme.at;
            let value = if index == 2 {
                -extreme.value
            } else {
                extreme.value
            };
            let depth = |z: f64| {
                if z < part.bottom {
                    Depth::below(z)
                } else {
                    Depth::above(z)
                }
            };
            let there = field.at([x, y], depth(z)).unwrap();
            // On the surface values are those of the continuum, not of the steps of the traction. A search knows
            // stresses to 2e-6 of the largest at a depth.
            if z >= element {
                assert_relative_eq!(quantities[index](&there), value, max_relative = 2e-6);
            }
            let near = (0..40).map(|i| {
                let [u, v, w] = spread(i).map(|part| element * part);
                let lowest = part.top.max(element);
                (
                    [x + u, y + v],
                    (z + 2.0 * w).clamp(lowest, part.bottom.max(lowest)),
                )
            });
            let anywhere = (0..20).map(|i| {
                let [u, v, w] = spread(i);
                let top = part.top.max(element);
                (
                    [0.15 * u, 0.15 * v],
                    top + w * w * (part.bottom.min(0.3) - top),
                )
            });
            for (point, z) in near.chain(anywhere) {
                let sampled = quantities[index](&field.at(point, depth(z)).unwrap());
                assert!(
                    sampled <= value + 1e-4 * value.abs(),
                    "{index} {part:?} {point:?} {z}: {sampled} {value}"
                );
            }
        }
    }
}

#[test]
fn planes_that_show_a_part_of_the_loaded_square_hold_the_states_at_their_centres() {
    let (path, stress, _) = coating_under_a_ball(0.02);
    let field = StressField::new(&path, 0, stress.sliding).unwrap();
    let depth = Depth::below(0.013);
    for part in [0.1, 0.5, 1.0] {
        let mut planes = field.planes(part * path.grid.side());
        let centres = planes.centres().to_vec();
        let (i, k) = (centres.len() / 3, centres.len() / 4);
        let mut found = Vec::new();
        planes
            .fields_on(depth, |_, values| found.push(values[i * centres.len() + k]))
            .unwrap();
        let state = field.at([centres[i], centres[k]], depth).unwrap();
        let expected = [state.displacement.as_slice(), state.stress.as_slice()].concat();
        for (found, expected) in found.iter().zip(&expected) {
            // A plane is a convolution, a state a sum: each is accurate to 1e-11 of the largest value of its field.
            assert_relative_eq!(found, expected, max_relative = 1e-8, epsilon = 1e-10);
        }
        assert_eq!(found.len(), 9);
    }
}

#[test]
fn extreme_tractions_of_an_interface_are_the_largest_on_its_plane() {
    let thickness = 0.05;
    let (path, stress, found) = coating_under_a_ball(thickness);
    let mut planes = StressField::new(&path, 0, stress.sliding)
        .unwrap()
        .planes(path.grid.side());
    for depth in [Depth::above(thickness), Depth::below(thickness)] {
        let mut stresses = vec![Vec::new(); 9];
        planes
            .fields_on(depth, |field, values| stresses[field] = values.to_vec())
            .unwrap();
        let largest =
            |value: &dyn Fn(usize) -> f64| (0..stresses[0].len()).map(value).fold(0.0, f64::max);
        let interface = &found.interfaces[0];
        for (extreme, sampled) in [
            (
                interface.max_shear_traction.unwrap(),
                largest(&|i| stresses[7][i].hypot(stresses[8][i])),
            ),
            (
                interface.max_compression.unwrap(),
                largest(&|i| -stresses[5][i]),
            ),
        ] {
            // Between the centres the extreme may exceed the samples as a parabola does over half an element.
            assert!(
                extreme.value >= (1.0 - 1e-6) * sampled,
                "{extreme:?} {sampled}"
            );
            assert_relative_eq!(extreme.value, sampled, max_relative = 3e-3);
        }
        // Tension is largest beyond the grid.
        let tension = interface.max_tension.unwrap();
        assert!(tension.value > largest(&|i| stresses[5][i]), "{tension:?}");
    }
}

#[test]
fn the_stress_at_the_rim_of_a_punch_is_not_resolved() {
    let path = solved(
        &model(&half_space(), FlatPunch::new(0.1).unwrap()),
        64,
        1e-3,
    );
    let found = stress_extremes(&path, 0, &whole(BodyStrengths::default())).unwrap();
    let extreme = found.bodies[0].max_von_mises.unwrap();
    assert!(
        extreme.at[2] < path.grid.element_side() && !extreme.resolved,
        "{extreme:?}"
    );
}

/// Two paraboloids side by side, of these radii.
#[derive(Debug)]
struct Pair([f64; 2]);

impl Profile for Pair {
    fn height(&self, x: f64, y: f64) -> f64 {
        let [left, right] = self.0;
        let over = |x: f64, radius: f64| (x * x + y * y) / (2.0 * radius);
        over(x + 0.3, left).min(over(x - 0.3, right))
    }
}

#[test]
fn of_two_almost_equal_contacts_the_more_highly_stressed_is_found() {
    for (radii, side) in [([1.0, 1.005], -1.0), ([1.005, 1.0], 1.0)] {
        let model = model(&half_space(), Indenter::custom(Pair(radii)));
        let loads = [Load::Penetration(5e-3), Load::Penetration(-1e-3)];
        let options = SolverOptions::default();
        let domain = Domain::Side(1.0);
        let path = solve_path(&model, domain, 64, &loads, &options, &mut ()).unwrap();
        let stress = whole(BodyStrengths::default());
        let body = &stress_extremes(&path, 0, &stress).unwrap().bodies[0];
        for extreme in [
            body.max_von_mises.unwrap(),
            body.max_shear.unwrap(),
            body.min_principal.unwrap(),
        ] {
            assert!((extreme.at[0] - 0.3 * side).abs() < 0.02, "{extreme:?}");
        }
        // Without contact there is no stress.
        let body = &stress_extremes(&path, 1, &stress).unwrap().bodies[0];
        for extreme in [body.max_von_mises.unwrap(), body.max_principal.unwrap()] {
            assert_eq!((extreme.value, extreme.estimate), (0.0, Some(0.0)));
            assert!(extreme.resolved);
        }
    }
}
