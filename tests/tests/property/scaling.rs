//! Scaling, monotonicity and energy for random numbers.

use pellicle_contact::{Load, LoadingPath, Model, Step};
use pellicle_tests::scene::{
    coated, cylinders, largest_difference, material, model, paraboloid, relative, solve,
};
use pellicle_texture::{CylinderSpec, Cylinders, Lattice, Relief};
use proptest::prelude::*;

const ELEMENTS: usize = 48;

/// Cylinders on a stiff coating under a paraboloid, in units of `length` and `modulus`, with the other moduli as
/// multiples.
fn textured(length: f64, modulus: f64, coating: f64, springs: f64) -> Model {
    let body = coated(
        0.05 * length,
        material(coating * modulus, 0.3),
        material(modulus, 0.4),
    );
    let relief = cylinders(
        0.02 * length,
        2e-3 * length,
        0.05 * length,
        springs * modulus,
    );
    model(&body, relief, paraboloid(length))
}

fn pressed(model: &Model, side: f64, load: Load) -> Step {
    solve(model, side, ELEMENTS, load).steps.remove(0)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    #[test]
    fn units_of_length_and_modulus_only_scale_the_answer(length in -9.0..3.0_f64, modulus in -3.0..12.0_f64) {
        let (length, modulus) = (10_f64.powf(length), 10_f64.powf(modulus));
        let plain = pressed(&textured(1.0, 1.0, 10.0, 10.0), 0.5, Load::Force(2e-3));
        let force = 2e-3 * modulus * length * length;
        let scaled = pressed(&textured(length, modulus, 10.0, 10.0), 0.5 * length, Load::Force(force));
        // The certificate's 1e-8, and its effect on single pressures.
        let penetration = scaled.solution.penetration / length;
        prop_assert!(relative(penetration, plain.solution.penetration) < 1e-7);
        let pressure = |e: usize| scaled.solution.pressure[e] / modulus;
        prop_assert!(largest_difference(&plain.solution.pressure, pressure) < 1e-5);
    }
}

#[test]
fn a_stiffer_coating_and_stiffer_springs_are_penetrated_less() {
    let depth = |coating, springs| {
        let model = textured(1.0, 1.0, coating, springs);
        pressed(&model, 0.5, Load::Force(2e-3)).solution.penetration
    };
    let by_coating = [1.0, 3.0, 10.0].map(|coating| depth(coating, 10.0));
    let by_springs = [0.1, 1.0, 10.0].map(|springs| depth(10.0, springs));
    for depths in [by_coating, by_springs] {
        assert!(
            depths.is_sorted_by(|softer, stiffer| softer > stiffer),
            "{depths:?}"
        );
    }
}

#[test]
fn force_area_and_every_pressure_on_a_tall_relief_grow_with_the_penetration() {
    let model = textured(1.0, 1.0, 10.0, 10.0);
    let steps = [2e-3, 4e-3, 8e-3].map(|depth| pressed(&model, 0.5, Load::Penetration(depth)));
    for pair in steps.windows(2) {
        let [less, more] = pair else { unreachable!() };
        assert!(less.solution.force < more.solution.force);
        assert!(less.summary.contact_area < more.summary.contact_area);
    }
}

#[test]
fn a_relief_shifted_by_its_period_is_the_same_relief() {
    let at = |offset| {
        let spec = CylinderSpec {
            lattice: Lattice::Square,
            radius: 0.02,
            height: 2e-3,
            period: 0.0625,
            offset,
            young_modulus: 10.0,
        };
        let relief = Relief::Cylinders(Cylinders::new(spec).unwrap());
        let body = coated(0.05, material(10.0, 0.3), material(1.0, 0.4));
        pressed(
            &model(&body, relief, paraboloid(1.0)),
            0.5,
            Load::Force(2e-3),
        )
    };
    let (here, there) = (at([0.0, 0.0]), at([0.0625, -0.125]));
    let moved = |e: usize| there.solution.pressure[e];
    // The period is a binary fraction, so the sampled reliefs are equal to the bit.
    assert!(largest_difference(&here.solution.pressure, moved) <= 0.0);
    let (halfway, moved) = (at([0.03125, 0.0]), |e: usize| here.solution.pressure[e]);
    assert!(largest_difference(&halfway.solution.pressure, moved) > 0.1);
}

#[test]
fn the_stored_energy_grows_by_the_work_of_the_force() {
    let model = textured(1.0, 1.0, 10.0, 10.0);
    let (depth, change) = (5e-3, 5e-6);
    let area = (0.5 / ELEMENTS as f64).powi(2);
    // U = ½ Σ p (u + w*) 4a²
    let energy = |path: &LoadingPath| -> f64 {
        let surface = path.surface(&path.geometry(), 0).unwrap();
        let fields = surface.displacement.iter().zip(&surface.shortening);
        let work = path.steps[0].solution.pressure.iter().zip(fields);
        work.map(|(p, (u, w))| 0.5 * p * (u + w) * area).sum()
    };
    let [before, after] = [depth - change, depth + change]
        .map(|depth| solve(&model, 0.5, ELEMENTS, Load::Penetration(depth)));
    let forces = [&before, &after].map(|path| path.steps[0].solution.force);
    let slope = (energy(&after) - energy(&before)) / (2.0 * change);
    let force = f64::midpoint(forces[0], forces[1]);
    // The error 1e-8 of the energy over a change of 1/500, and elements that enter the contact on the way.
    assert!(relative(slope, force) < 1e-4, "{slope} {force}");
}
