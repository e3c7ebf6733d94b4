//! Readings of axisymmetric contacts beside the contacts themselves.

use pellicle_contact::axisymmetric::{AxisymmetricElasticity, AxisymmetricProfile};
use pellicle_contact::{PowerLaw, Sphere};
use pellicle_kernel::{Base, Interface, Layer};

use super::*;

const OBSERVABLES: [Observable; 5] = [
    Observable::DepthAtForce,
    Observable::ForceAtDepth,
    Observable::StiffnessAtForce,
    Observable::StiffnessAtDepth,
    Observable::StiffnessAtContactRadius,
];

fn bodies() -> [ElasticBodies; 3] {
    let gel = Layer::new(2e-6, material(10e3, 0.49), Interface::Bonded).unwrap();
    [
        Foundation::half_space(material(70e9, 0.2)).into(),
        coating(0.5e-6),
        Foundation::new(vec![gel], Base::Rigid).unwrap().into(),
    ]
}

/// A paraboloid, a sphere that is sunk by a tenth beyond its radius, a cone in contact with its tip and its side, and a
/// blunt shape; each with its largest contact radius.
fn indenters() -> [(Indenter, f64); 4] {
    [
        (Paraboloid::new(RADIUS).unwrap().into(), 3e-6),
        (Sphere::new(3e-6).unwrap().into(), 2.6e-6),
        (Cone::new(1.2, 1e-6).unwrap().into(), 3e-6),
        (PowerLaw::new(3.3, 4e-6).unwrap().into(), 3e-6),
    ]
}

/// What is prescribed of contacts of these radii, and what is read: force, penetration, stiffness, radius.
fn pairs(
    bodies: &ElasticBodies,
    indenter: &Indenter,
    radii: &[f64],
    observable: Observable,
) -> (Vec<f64>, Vec<f64>) {
    let profile = AxisymmetricProfile::of(indenter).unwrap();
    let elasticity = AxisymmetricElasticity::new(bodies);
    let pair = |radius: &f64| {
        let of = elasticity.contact(profile, *radius).unwrap();
        let (force, depth, stiffness) = (of.force, of.penetration, of.punch.stiffness);
        match observable {
            Observable::DepthAtForce => (force, depth),
            Observable::ForceAtDepth => (depth, force),
            Observable::StiffnessAtForce => (force, stiffness),
            Observable::StiffnessAtDepth => (depth, stiffness),
            _ => (*radius, stiffness),
        }
    };
    radii.iter().map(pair).unzip()
}

#[test]
fn readings_are_those_of_the_contacts_for_any_indenter_of_revolution() {
    for bodies in bodies() {
        for (indenter, largest) in indenters() {
            // From a fiftieth of the largest radius, at no point of the polynomials.
            let radii: Vec<f64> = (0..12)
                .map(|i| largest * 0.021_f64.powf(f64::from(i) / 11.3))
                .collect();
            for observable in OBSERVABLES {
                let (given, wanted) = pairs(&bodies, &indenter, &radii, observable);
                let model = model(&bodies, Relief::Bare, indenter.clone());
                let found = predicted(&model, observable, given.clone(), &[]);
                // dS/dD, dF/dD … by differences of the contacts themselves.
                let slopes = radii.iter().map(|radius| {
                    let beside = [radius * (1.0 - 1e-5), radius * (1.0 + 1e-5)];
                    let (given, read) = pairs(&bodies, &indenter, &beside, observable);
                    (read[1] - read[0]) / (given[1] - given[0])
                });
                for (i, slope) in slopes.enumerate() {
                    let errors = [
                        found.value[i] / wanted[i] - 1.0,
                        found.slope[i] / slope - 1.0,
                    ];
                    assert!(
                        errors[0].abs() < 3e-7 && errors[1].abs() < 1e-4,
                        "{indenter:?} {observable:?} {:e}: {errors:?}",
                        radii[i]
                    );
                }
            }
        }
    }
}

#[test]
fn derivatives_of_readings_are_those_of_the_contacts() {
    let modulus = young_modulus(0);
    for (indenter, largest) in indenters() {
        let radii = [largest, 0.4 * largest, 0.1 * largest];
        for observable in OBSERVABLES {
            let (given, _) = pairs(&coating(0.5e-6), &indenter, &radii, observable);
            let model = model(&coating(0.5e-6), Relief::Bare, indenter.clone());
            let found = predicted(&model, observable, given.clone(), &[modulus, THICKNESS]);
            for (column, parameter) in [modulus, THICKNESS].into_iter().enumerate() {
                let value = model.parameter(parameter).unwrap();
                let step = 1e-3 * value;
                let at = |value| {
                    let moved = model.with_parameter(parameter, value).unwrap();
                    predicted(&moved, observable, given.clone(), &[]).value
                };
                let (more, less) = (at(value + step), at(value - step));
                for i in 0..radii.len() {
                    let wanted = (more[i] - less[i]) / (2.0 * step);
                    let error = (found.derivatives[column][i] - wanted) * value / found.value[i];
                    // The square of the step.
                    assert!(error.abs() < 3e-6, "{indenter:?} {observable:?}: {error:e}");
                }
            }
        }
    }
}

#[test]
fn beyond_its_points_a_curve_goes_on_as_a_power_law() {
    let bodies = coating(0.5e-6);
    let indenter = Indenter::from(Paraboloid::new(RADIUS).unwrap());
    let model = model(&bodies, Relief::Bare, indenter);
    let found = predicted(
        &model,
        Observable::ForceAtDepth,
        vec![1e-6, 3e-11, 0.0, -1e-9],
        &[],
    );
    // Hertz' law on a half-space of the coating.
    let hertz = 4.0 / 3.0 * material(100e9, 0.25).plane_strain_modulus() * RADIUS.sqrt();
    let error = found.value[1] / (hertz * 3e-11_f64.powf(1.5)) - 1.0;
    // The exponent at a hundredth of the largest radius, where the base still counts, is some 0.03 off 1.5.
    assert!(error.abs() < 0.2, "{error:e}");
    assert_eq!(found.value[2..], [0.0, 0.0]);
    assert_eq!(found.slope[2..], [0.0, 0.0]);
}
