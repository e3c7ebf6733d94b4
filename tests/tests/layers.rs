//! Layers beyond the rows of `pellicle validate`: limits of a coating, and the response of stacks to 40 digits.

use pellicle_contact::Load;
use pellicle_kernel::Interface::Bonded;
use pellicle_kernel::{Foundation, Material};
use pellicle_tests::scene::{coated, material, model, paraboloid, relative, solve};
use pellicle_texture::Relief;
use pellicle_validation::data::compliance::{one_layer, stacks};

/// A dozen roundings without cancellation: measured 9e-16 with one layer.
const LAST_DIGITS: f64 = 2e-15;

/// Penetration and pressures of a paraboloid on a body, with 64 elements per side.
fn pressed(foundation: &Foundation) -> (f64, Vec<f64>) {
    let model = model(foundation, Relief::Bare, paraboloid(1.0));
    let mut path = solve(&model, 0.3, 64, Load::Force(1.3e-3));
    let solution = path.steps.remove(0).solution;
    (solution.penetration, solution.pressure)
}

#[test]
fn a_coating_of_the_substrate_material_has_no_effect() {
    for nu in [0.0, 0.3, 0.5] {
        let body = material(0.91, nu);
        let (penetration, pressure) = pressed(&Foundation::half_space(body));
        // The same material except for one bit, so that it is computed as a coating: equal materials are reduced to a
        // half-space.
        let coating = material(0.91_f64.next_up(), nu);
        for thickness in [1e-4, 0.05, 10.0] {
            let (found, pressures) = pressed(&coated(thickness, coating, body));
            // The solver's own tolerance, 1e-8, bounds the effect of rounding in the coefficients.
            assert!(relative(found, penetration) < 1e-9, "{found} {penetration}");
            for (p, q) in pressure.iter().zip(pressures) {
                assert!((p - q).abs() < 1e-6 * 0.06);
            }
        }
    }
}

/// The relative change of the penetration from that into a homogeneous body.
fn effect(thickness: f64, coating: Material, substrate: Material, alone: Material) -> f64 {
    let (wanted, _) = pressed(&Foundation::half_space(alone));
    relative(pressed(&coated(thickness, coating, substrate)).0, wanted)
}

#[test]
fn the_effect_of_a_thin_coating_is_proportional_to_its_thickness() {
    let (coating, substrate) = (material(5.0, 0.2), material(0.91, 0.3));
    let [more, less] = [1e-5, 1e-6].map(|h| effect(h, coating, substrate, substrate));
    // First order in H/a: ten times thinner, ten times less.
    assert!((more / less - 10.0).abs() < 0.5, "{more} {less}");
    assert!(less < 1e-4, "{less}");
}

#[test]
fn the_effect_of_the_substrate_is_inversely_proportional_to_the_thickness_of_a_thick_coating() {
    let (coating, substrate) = (material(0.91, 0.3), material(5.0, 0.2));
    let [more, less] = [10.0, 100.0].map(|h| effect(h, coating, substrate, coating));
    // First order in a/H.
    assert!((more / less - 10.0).abs() < 0.5, "{more} {less}");
    assert!(less < 1e-2, "{less}");
}

#[test]
fn a_thickness_wrong_by_1e_11_is_detected() {
    let errors = one_layer().expect("the data").into_iter().map(|mut value| {
        let expected = value.bonded;
        value.s *= 1.0 + 1e-11;
        let layer = value.foundation(Bonded, false).expect("a foundation");
        (layer.response(value.s) / expected - 1.0).abs()
    });
    assert!(errors.fold(0.0, f64::max) > LAST_DIGITS);
}

#[test]
fn the_response_of_layer_stacks_is_right_to_the_last_digits() {
    let data = stacks().expect("the data");
    for value in &data.values {
        let foundation = data.stacks[&value.stack].foundation().expect("a stack");
        let error = (foundation.response(value.wavenumber) / value.response - 1.0).abs();
        // Three layers, a dozen roundings each: measured 4.5e-16.
        assert!(error <= LAST_DIGITS, "{error:e} {value:?}");
    }
}
