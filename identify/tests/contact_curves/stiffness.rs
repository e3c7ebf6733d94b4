//! Stiffnesses at forces, depths and contact radii compared with closed forms and finite differences.

use super::*;
use pellicle_contact::axisymmetric::punch_stiffness;
use pellicle_kernel::{Base, Interface, Layer};

const AT_FORCE: Observable = Observable::StiffnessAtForce;
const AT_DEPTH: Observable = Observable::StiffnessAtDepth;

/// The largest relative difference of two lists.
fn worst(found: &[f64], wanted: &[f64]) -> f64 {
    let pairs = found.iter().zip(wanted);
    pairs.fold(0.0, |most, (found, wanted)| {
        f64::max(most, (found / wanted - 1.0).abs())
    })
}

#[test]
fn stiffnesses_of_a_cone_and_a_paraboloid_on_a_half_space_have_closed_forms() {
    let young = 210e9;
    let body = Foundation::half_space(material(young, 0.3)).into();
    let paraboloid = Indenter::from(Paraboloid::new(RADIUS).unwrap());
    let cone = Indenter::from(Cone::new(1.2, 0.0).unwrap());
    let modulus = material(young, 0.3).plane_strain_modulus();
    // D = (9 Q²/(16 R E*²))^⅓ and D = (π Q/(2 E* tan α))^½
    let of_paraboloid = 9.0 / (16.0 * RADIUS * modulus * modulus);
    let of_cone = std::f64::consts::PI / (2.0 * modulus * 1.2_f64.tan());
    // S = Q/D/n with Q ∝ E D^(1/n), so that S ∝ E^n Q^(1 − n), or E D^(1/n − 1).
    for (indenter, n, depth) in [
        (paraboloid, 2.0 / 3.0, of_paraboloid.cbrt()),
        (cone, 0.5, of_cone.sqrt()),
    ] {
        let model = model(&body, Relief::Bare, indenter);
        let parameters = [young_modulus(0)];
        let depths: Vec<f64> = forces().iter().map(|force| depth * force.powf(n)).collect();
        let pairs = forces().into_iter().zip(&depths);
        let exact: Vec<f64> = pairs.map(|(force, depth)| force / depth / n).collect();
        for (observable, abscissae, power, by_modulus) in [
            (AT_FORCE, forces(), 1.0 - n, n),
            (AT_DEPTH, depths.clone(), 1.0 / n - 1.0, 1.0),
        ] {
            let found = predicted(&model, observable, abscissae.clone(), &parameters);
            let slopes: Vec<f64> = (exact.iter().zip(&abscissae))
                .map(|(stiffness, at)| power * stiffness / at)
                .collect();
            let changes: Vec<f64> = exact.iter().map(|s| by_modulus * s / young).collect();
            let errors = [
                worst(&found.value, &exact),
                worst(&found.slope, &slopes),
                worst(&found.derivatives[0], &changes),
            ];
            assert!(
                errors[0] < 2e-3 && errors[1] < 2e-2 && errors[2] < 5e-3,
                "{errors:?}"
            );
        }
    }
}

#[test]
fn derivatives_of_stiffnesses_on_a_coating_agree_with_differences() {
    let paraboloid = Paraboloid::new(RADIUS).unwrap();
    let model = model(&coating(0.5e-6), Relief::Bare, paraboloid);
    let parameters = [
        young_modulus(0),
        young_modulus(1),
        THICKNESS,
        RADIUS_OF_INDENTER,
    ];
    let depths = predicted(&model, Observable::DepthAtForce, forces(), &[]).value;
    for (observable, abscissae) in [(AT_FORCE, forces()), (AT_DEPTH, depths)] {
        let curves = curves(&model, observable, abscissae.clone(), &parameters);
        let values: Vec<f64> = parameters
            .iter()
            .map(|of| model.parameter(*of).unwrap())
            .collect();
        let found = curves.predict(&values).unwrap();
        for (index, value) in values.iter().enumerate() {
            let step = 0.02 * value;
            let at = |step: f64| {
                let mut moved = values.clone();
                moved[index] += step;
                curves.predict(&moved).unwrap().value
            };
            let (more, less) = (at(step), at(-step));
            let mut error: f64 = 0.0;
            for i in 0..abscissae.len() {
                let difference = (more[i] - less[i]) / (2.0 * step);
                // Relative changes of the stiffness for one of the parameter.
                let part = value / found.value[i];
                error = error.max((found.derivatives[index][i] - difference).abs() * part);
            }
            // The square of the difference's step.
            assert!(error < 3e-4, "{observable:?} {index}: {error:e}");
        }
    }
}

#[test]
fn the_contact_radius_of_a_flat_punch_is_no_abscissa() {
    let body = Foundation::half_space(material(50e3, 0.45)).into();
    let curve = ContactCurve {
        model: model(&body, Relief::Bare, FlatPunch::new(1e-3).unwrap()),
        observable: Observable::StiffnessAtContactRadius,
        abscissae: vec![0.5e-3, 1e-3, 1e-3],
        own: Vec::new(),
        origins: Vec::new(),
        series: 0.0,
        thinned: None,
        adhesion: None,
    };
    let refused = ContactCurves::new(vec![curve], Vec::new(), CurveOptions::default());
    let refused = refused.unwrap_err().to_string();
    assert!(
        refused.contains("contact radius") && refused.contains("flat punch"),
        "{refused}"
    );
}

#[test]
fn the_stiffness_at_a_contact_radius_is_that_of_a_flat_punch() {
    let (young, nu) = (210e9, 0.3);
    let body = Foundation::half_space(material(young, nu)).into();
    let radii = vec![0.1e-6, 0.3e-6, 1e-6];
    // S = 2 a E*
    let expected = radii
        .iter()
        .map(|a| 2.0 * a * material(young, nu).plane_strain_modulus());
    let expected: Vec<f64> = expected.collect();
    let cone = Indenter::from(Cone::new(1.2, 0.05e-6).unwrap());
    let paraboloid = Indenter::from(Paraboloid::new(RADIUS).unwrap());
    for indenter in [cone, paraboloid] {
        let model = model(&body, Relief::Bare, indenter);
        let observable = Observable::StiffnessAtContactRadius;
        let found = predicted(&model, observable, radii.clone(), &[young_modulus(0)]);
        for i in 0..radii.len() {
            let errors = [
                found.value[i] / expected[i] - 1.0,
                found.slope[i] * radii[i] / expected[i] - 1.0,
                found.derivatives[0][i] * young / expected[i] - 1.0,
            ];
            // The square of the derivative's step.
            for error in errors {
                assert!(error.abs() < 1e-7, "{errors:?} at {}", radii[i]);
            }
        }
    }
}

#[test]
fn the_stiffness_at_the_smallest_contact_radius_on_a_confined_layer_is_that_of_its_own_radius() {
    // A gel of 2 µm on a rigid base: under the largest radius a force grows with its sixth power, under the smallest
    // with its third.
    let layer = Layer::new(2e-6, material(10e3, 0.49), Interface::Bonded).unwrap();
    let body = ElasticBodies::from(Foundation::new(vec![layer], Base::Rigid).unwrap());
    let radii = [0.2e-6, 0.237e-6, 0.256e-6, 0.5e-6, 1.3e-6];
    let model = model(&body, Relief::Bare, Paraboloid::new(5e-6).unwrap());
    let observable = Observable::StiffnessAtContactRadius;
    let found = predicted(&model, observable, radii.to_vec(), &[young_modulus(0)]);
    for (radius, found) in radii.iter().zip(&found.value) {
        let [exact, _] = punch_stiffness(&body, *radius).unwrap();
        assert!(
            (found / exact - 1.0).abs() < 1e-7,
            "{found:e} {exact:e} at {radius:e}"
        );
    }
}
