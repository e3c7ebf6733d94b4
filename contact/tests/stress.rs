//! Stresses under solved pressures: extremes against closed forms and sampling, critical loads against solving again.

#![expect(clippy::unwrap_used, reason = "a test fails by its panic")]

use std::sync::Arc;

use approx::assert_relative_eq;
use pellicle_contact::{
    BodyPart, BodyStrengths, Criterion, CriticalLoad, Domain, FlatPunch, Indenter, InterfacePart,
    InterfaceStrengths, Load, LoadingPath, Model, Paraboloid, Profile, Sliding, SolverOptions,
    StressExtremes, StressField, StressModel, critical_loads, reference::hertz, solve_path,
    stress_extremes,
};
use pellicle_influence::{Cache, Depth, RadialTables, SubsurfaceState};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::Relief;

const STEEL: (f64, f64) = (1.0, 0.3);

fn half_space() -> Foundation {
    Foundation::half_space(Material::new(STEEL.0, STEEL.1).unwrap())
}

/// A coat of this thickness, five times as stiff as its support.
fn coated(thickness: f64) -> Foundation {
    let (coat, base) = (Material::new(5.0, 0.25), Material::new(STEEL.0, STEEL.1));
    Foundation::coated(thickness, coat.unwrap(), base.unwrap()).unwrap()
}

/// An indenter on a bare body.
fn model(foundation: &Foundation, indenter: impl Into<Indenter>) -> Model {
    Model {
        tables: Arc::new(RadialTables::build(foundation).unwrap()),
        relief: Relief::Bare,
        indenter: indenter.into(),
        cache: Cache::none(),
    }
}

fn solved(model: &Model, elements: usize, force: f64) -> LoadingPath {
    let options = SolverOptions {
        coarse_pressures: true,
        ..SolverOptions::default()
    };
    let loads = [Load::Force(force)];
    solve_path(
        model,
        Domain::Automatic,
        elements,
        &loads,
        &options,
        &mut (),
    )
    .unwrap()
}

fn body(name: &str, top: f64, bottom: f64, strengths: BodyStrengths) -> BodyPart {
    BodyPart {
        name: name.to_owned(),
        top,
        bottom,
        strengths,
    }
}

/// Stresses of a body of one material.
fn whole(strengths: BodyStrengths) -> StressModel {
    StressModel {
        bodies: vec![body("substrate", 0.0, f64::INFINITY, strengths)],
        ..StressModel::default()
    }
}

/// Stresses of a coat, its support and the interface, under sliding.
fn sliding_coat(thickness: f64) -> StressModel {
    let none = BodyStrengths::default();
    StressModel {
        sliding: Sliding {
            friction: 0.3,
            direction: 0.4,
        },
        bodies: vec![
            body("layer[0]", 0.0, thickness, none),
            body("substrate", thickness, f64::INFINITY, none),
        ],
        interfaces: vec![InterfacePart {
            index: 0,
            depth: thickness,
            strengths: InterfaceStrengths::default(),
        }],
    }
}

/// The largest von Mises stress under Hertz's pressure and its depth, over the largest pressure and the radius: with
/// Huber's stresses on the axis, `σ_z = −1/(1 + ζ²)` and `σ_r = −(1 + ν)(1 − ζ arctan 1/ζ) + ½/(1 + ζ²)`.
fn on_the_axis() -> [f64; 2] {
    let difference = |zeta: f64| {
        let inside = 1.0 / (1.0 + zeta * zeta);
        1.5 * inside - (1.0 + STEEL.1) * (1.0 - zeta * (1.0 / zeta).atan())
    };
    let depths = (1..20_000).map(|i| f64::from(i) * 1e-4);
    let largest = depths.map(|zeta| [difference(zeta), zeta]);
    largest.fold(
        [0.0; 2],
        |best, next| if next[0] > best[0] { next } else { best },
    )
}

#[test]
fn von_mises_stress_under_hertz_is_found_in_value_and_depth() {
    let model = model(&half_space(), Paraboloid::new(1.0).unwrap());
    let [largest, depth] = on_the_axis();
    assert_relative_eq!(largest, 0.620, max_relative = 1e-3);
    for elements in [64, 256] {
        let path = solved(&model, elements, 1e-3);
        let exact = hertz::from_force(1.0, STEEL.0 / (1.0 - STEEL.1 * STEEL.1), 1e-3);
        let found = stress_extremes(&path, 0, &whole(BodyStrengths::default())).unwrap();
        let mises = found.bodies[0].max_von_mises;
        let error = (mises.value / exact.peak_pressure - largest).abs();
        assert!(error < 6e-3 / elements as f64, "{elements}: {mises:?}");
        assert!(mises.resolved && error * exact.peak_pressure < mises.estimate.unwrap());
        // At its peak a stress changes little: its depth is known to the root of its accuracy.
        assert_relative_eq!(
            mises.at[2] / exact.contact_radius,
            depth,
            max_relative = 1e-2
        );
        let shear = found.bodies[0].max_shear.value;
        assert_relative_eq!(2.0 * shear, mises.value, max_relative = 1e-9);
    }
}

/// A ball pressed on a coat of this thickness, on 64 × 64 elements, and the extremes under sliding.
fn coat_under_a_ball(thickness: f64) -> (LoadingPath, StressModel, StressExtremes) {
    let model = model(&coated(thickness), Paraboloid::new(1.0).unwrap());
    let (path, stress) = (solved(&model, 64, 1e-3), sliding_coat(thickness));
    let extremes = stress_extremes(&path, 0, &stress).unwrap();
    (path, stress, extremes)
}

/// Points that fill the cube from −1 to 1 evenly: multiples of powers of the root of x⁴ = x + 1.
fn spread(i: u32) -> [f64; 3] {
    [1, 2, 3].map(|power| {
        2.0 * (0.5 + f64::from(i) / 1.220_744_084_605_76_f64.powi(power)).fract() - 1.0
    })
}

#[test]
fn no_sampled_stress_exceeds_the_extremes_and_each_is_found_where_it_is_said_to_be() {
    let thickness = 0.02;
    let (path, stress, found) = coat_under_a_ball(thickness);
    let field = StressField::new(&path, 0, stress.sliding).unwrap();
    let element = path.grid.element_side();
    let quantities: [fn(&SubsurfaceState) -> f64; 4] = [
        SubsurfaceState::von_mises,
        |state| state.principal()[0],
        |state| -state.principal()[2],
        SubsurfaceState::max_shear,
    ];
    for (part, extremes) in stress.bodies.iter().zip(&found.bodies) {
        let said = [
            extremes.max_von_mises,
            extremes.max_principal,
            extremes.min_principal,
            extremes.max_shear,
        ];
        for (index, extreme) in said.iter().enumerate() {
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
            assert_relative_eq!(quantities[index](&there), value, max_relative = 1e-9);
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
    let (path, stress, _) = coat_under_a_ball(0.02);
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
            // A plane is a convolution, a state a sum: each is right to 1e-11 of the largest value of its field.
            assert_relative_eq!(found, expected, max_relative = 1e-8, epsilon = 1e-10);
        }
        assert_eq!(found.len(), 9);
    }
}

#[test]
fn tractions_of_an_interface_are_the_largest_on_its_plane() {
    let thickness = 0.05;
    let (path, stress, found) = coat_under_a_ball(thickness);
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
                interface.max_shear_traction,
                largest(&|i| stresses[7][i].hypot(stresses[8][i])),
            ),
            (interface.max_compression, largest(&|i| -stresses[5][i])),
        ] {
            // Between the centres it may be larger by what a parabola is over half an element.
            assert!(
                extreme.value >= (1.0 - 1e-6) * sampled,
                "{extreme:?} {sampled}"
            );
            assert_relative_eq!(extreme.value, sampled, max_relative = 3e-3);
        }
        // Tension is largest beyond the grid.
        let tension = interface.max_tension;
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
    let extreme = found.bodies[0].max_von_mises;
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
fn of_two_contacts_almost_alike_the_one_under_more_stress_is_found() {
    for (radii, side) in [([1.0, 1.005], -1.0), ([1.005, 1.0], 1.0)] {
        let model = model(&half_space(), Indenter::custom(Pair(radii)));
        let loads = [Load::Penetration(5e-3), Load::Penetration(-1e-3)];
        let options = SolverOptions::default();
        let domain = Domain::Side(1.0);
        let path = solve_path(&model, domain, 64, &loads, &options, &mut ()).unwrap();
        let stress = whole(BodyStrengths::default());
        let body = &stress_extremes(&path, 0, &stress).unwrap().bodies[0];
        for extreme in [body.max_von_mises, body.max_shear, body.min_principal] {
            assert!((extreme.at[0] - 0.3 * side).abs() < 0.02, "{extreme:?}");
        }
        // Without contact there is no stress.
        let body = &stress_extremes(&path, 1, &stress).unwrap().bodies[0];
        for extreme in [body.max_von_mises, body.max_principal] {
            assert_eq!((extreme.value, extreme.estimate), (0.0, Some(0.0)));
            assert!(extreme.resolved);
        }
    }
}

fn critical(model: &Model, elements: usize, force: f64, stress: &StressModel) -> Vec<CriticalLoad> {
    let path = solved(model, elements, force);
    let options = SolverOptions::default();
    let extremes = [stress_extremes(&path, 0, stress).unwrap()];
    critical_loads(
        model,
        &path,
        &extremes,
        Domain::Automatic,
        &options,
        stress,
        &mut (),
    )
    .unwrap()
}

#[test]
fn a_homogeneous_body_yields_at_the_force_of_hertz() {
    let yield_strength = 0.03;
    let stress = whole(BodyStrengths {
        yield_strength: Some(yield_strength),
        tensile_strength: None,
    });
    let model = model(&half_space(), Paraboloid::new(1.0).unwrap());
    // p0³ = 6 Q E*²/(π³ R²)
    let plane_modulus = STEEL.0 / (1.0 - STEEL.1 * STEEL.1);
    let peak = yield_strength / on_the_axis()[0];
    let exact = (std::f64::consts::PI * peak).powi(3) / (6.0 * plane_modulus.powi(2));
    // From above, and from far above.
    for force in [1.7 * exact, 90.0 * exact] {
        let found = critical(&model, 128, force, &stress);
        let [
            CriticalLoad {
                criterion: Criterion::Yield,
                force: Some(found),
                estimate: Some(estimate),
                resolved: true,
                ..
            },
        ] = found[..]
        else {
            panic!("{found:?}")
        };
        assert!(
            (found - exact).abs() < estimate + 1e-4 * exact,
            "{found} ± {estimate}, {exact}"
        );
        assert!(estimate < 2e-3 * exact, "{estimate}");
    }
    let below = critical(&model, 64, 0.9 * exact, &stress);
    assert_eq!(below[0].force, None);
    // Q^⅓
    assert_relative_eq!(below[0].utilisation, 0.9_f64.cbrt(), max_relative = 1e-3);
}

#[test]
fn each_strength_of_a_coated_body_is_reached_under_its_own_critical_load() {
    let thickness = 0.02;
    let mut stress = sliding_coat(thickness);
    stress.bodies[1].strengths.yield_strength = Some(0.03);
    stress.interfaces[0].strengths.shear_strength = Some(0.02);
    let model = model(&coated(thickness), Paraboloid::new(1.0).unwrap());
    let found = critical(&model, 64, 1e-3, &stress);
    assert_eq!(found.len(), 2);
    for (index, load) in found.iter().enumerate() {
        let extremes =
            stress_extremes(&solved(&model, 64, load.force.unwrap()), 0, &stress).unwrap();
        let utilisation = if index == 0 {
            extremes.bodies[1].utilisation.yielding
        } else {
            extremes.interfaces[0].utilisation.shear
        };
        // Another domain, another grid: not the accuracy of the search, but the grid's.
        assert_relative_eq!(utilisation.unwrap(), 1.0, max_relative = 2e-3);
    }
}

#[test]
fn a_stress_that_falls_again_under_more_load_is_critical_where_it_first_reaches_its_strength() {
    // A thin stiff coat takes the shape of the indenter, and is bent no further.
    let thickness = 0.02;
    let coat = Material::new(10.0, 0.3).unwrap();
    let base = Material::new(STEEL.0, STEEL.1).unwrap();
    let model = model(
        &Foundation::coated(thickness, coat, base).unwrap(),
        Paraboloid::new(1.0).unwrap(),
    );
    let stress = |yield_strength| StressModel {
        bodies: vec![body(
            "layer[0]",
            0.0,
            thickness,
            BodyStrengths {
                yield_strength,
                tensile_strength: None,
            },
        )],
        ..StressModel::default()
    };
    let mises = |force: f64| {
        let extremes = stress_extremes(&solved(&model, 128, force), 0, &stress(None)).unwrap();
        extremes.bodies[0].max_von_mises.value
    };
    let [early, peak, late] = [3.5e-4, 5e-4, 1.5e-3].map(mises);
    assert!(early < peak && late < 0.98 * early, "{early} {peak} {late}");
    for strength in [early, 0.5 * (early + peak)] {
        let found = critical(&model, 128, 1.5e-3, &stress(Some(strength)));
        let force = found[0].force.unwrap();
        assert!((3.4e-4..5e-4).contains(&force), "{found:?}");
        assert_relative_eq!(mises(force), strength, max_relative = 1e-3);
    }
}
