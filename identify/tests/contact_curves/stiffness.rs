//! Stiffnesses at forces and at depths compared with closed forms and finite differences.

use super::*;

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
            // The grid error of both, and 1e-4 of the difference.
            assert!(error < 1.5e-3, "{observable:?} {index}: {error:e}");
        }
    }
}
