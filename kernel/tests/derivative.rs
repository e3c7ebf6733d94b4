//! Derivatives of the compliance: against the work done inside, under scaling, and along indistinguishable materials.

#![expect(clippy::unwrap_used, reason = "a test fails by its panic")]

use nalgebra::{Matrix3, Vector3};
use pellicle_kernel::{Base, Foundation, FoundationParameter, Interface, Layer, Material, Side};

type Parameter = FoundationParameter;

/// Stacks of one to three layers, soft and stiff, one on springs, one incompressible, one on a rigid base.
fn foundations() -> Vec<Foundation> {
    let material = |[young, poisson]: [f64; 2]| Material::new(young, poisson).unwrap();
    let layer = |thickness, numbers, interface| {
        Layer::new(thickness, material(numbers), interface).unwrap()
    };
    let springs = Interface::spring(0.3, 0.8).unwrap();
    let stack = vec![
        layer(0.2, [5.0, 0.2], Interface::Bonded),
        layer(1.5, [0.3, 0.45], springs),
        layer(0.7, [2.0, 0.3], Interface::Frictionless),
    ];
    vec![
        Foundation::coated(1.0, material([10.0, 0.25]), material([1.0, 0.3])).unwrap(),
        Foundation::coated(1.0, material([0.02, 0.5]), material([1.0, 0.0])).unwrap(),
        Foundation::new(stack.clone(), Base::HalfSpace(material([1.0, 0.35]))).unwrap(),
        Foundation::new(stack, Base::Rigid).unwrap(),
    ]
}

fn wavenumbers() -> impl Iterator<Item = f64> {
    (-12..=8).map(|i| 10_f64.powf(f64::from(i) / 4.0))
}

/// `∂C/∂θ` with `C = 2/(E₁* k) Φ`.
fn compliance_derivative(body: &Foundation, parameter: Parameter, wavenumber: f64) -> f64 {
    let surface = body.surface_material();
    let (young, nu) = (surface.young_modulus(), surface.poisson_ratio());
    // E* = E/(1 − ν²)
    let of_modulus = match parameter {
        Parameter::YoungModulus { body: 0 } => 1.0 / young,
        Parameter::PoissonRatio { body: 0 } => 2.0 * nu / (1.0 - nu * nu),
        _ => 0.0,
    };
    let derivative = body.response_derivative(parameter).unwrap();
    let (value, compliance) = (derivative.value(wavenumber), body.compliance(wavenumber));
    compliance * (value / body.response(wavenumber) - of_modulus)
}

/// `∂C/∂ ln E` of a body is minus the work on it, `∮ t·u`, since the field remains the minimum of the energy; `∂C/∂c`
/// of springs is the square of the traction on them.
#[test]
fn the_derivative_by_a_modulus_is_minus_the_work_on_the_body() {
    for foundation in foundations() {
        for k in wavenumbers() {
            let interior = foundation.interior(k).unwrap();
            let at = |index: usize, side| {
                let depth = foundation.interface_depth(index);
                if depth.is_infinite() {
                    return 0.0;
                }
                let state = interior.at(depth, side).normal;
                state.normal_stress * state.vertical_displacement
                    + state.shear_stress * state.horizontal_displacement
            };
            let compliance = foundation.compliance(k);
            for parameter in foundation.parameters() {
                let expected = match parameter {
                    Parameter::YoungModulus { body } => {
                        let work = at(body + 1, Side::Above) - at(body, Side::Below);
                        -work / foundation.parameter(parameter).unwrap()
                    }
                    Parameter::NormalCompliance { layer } => {
                        let depth = foundation.interface_depth(layer + 1);
                        interior.at(depth, Side::Above).normal.normal_stress.powi(2)
                    }
                    Parameter::ShearCompliance { layer } => {
                        let depth = foundation.interface_depth(layer + 1);
                        interior.at(depth, Side::Above).normal.shear_stress.powi(2)
                    }
                    _ => continue,
                };
                let found = compliance_derivative(&foundation, parameter, k);
                let value = foundation.parameter(parameter).unwrap();
                // The difference is of sixth order: 4e-11 found.
                let error = (found - expected).abs() * value / compliance;
                assert!(error < 1e-10, "{parameter:?} at {k}: {error:e}");
            }
        }
    }
}

/// If all thicknesses and compliances are multiplied by b, `C(k)` becomes `b C(b k)`.
#[test]
fn thicknesses_and_compliances_scale_with_the_wavelength() {
    for foundation in foundations() {
        for k in wavenumbers() {
            let scaled = |parameter: &Parameter| match parameter {
                Parameter::YoungModulus { .. } | Parameter::PoissonRatio { .. } => 0.0,
                _ => {
                    foundation.parameter(*parameter).unwrap()
                        * compliance_derivative(&foundation, *parameter, k)
                }
            };
            let found: f64 = foundation.parameters().iter().map(scaled).sum();
            // C + k C', the slope by a sixth-order difference
            let slope: f64 = [(1.0, 0.75), (2.0, -0.15), (3.0, 1.0 / 60.0)]
                .map(|(steps, weight): (f64, f64)| {
                    let at = |sign: f64| foundation.compliance(k * (sign * steps * 0.01).exp());
                    weight * (at(1.0) - at(-1.0)) / 0.01
                })
                .iter()
                .sum();
            let compliance = foundation.compliance(k);
            let error = (found - compliance - slope).abs() / compliance;
            assert!(error < 2e-10, "at {k}: {found} {error:e}");
        }
    }
}

/// `E₁*`, `E₂*` and Dundurs' β of two materials (plane strain).
fn dundurs([young_1, nu_1, young_2, nu_2]: [f64; 4]) -> Vector3<f64> {
    let [top, base] =
        [(young_1, nu_1), (young_2, nu_2)].map(|(e, nu)| Material::new(e, nu).unwrap());
    let (g1, g2) = (top.shear_modulus(), base.shear_modulus());
    let (a, b) = (3.0 - 4.0 * nu_1, 3.0 - 4.0 * nu_2);
    let beta = (g1 * (b - 1.0) - g2 * (a - 1.0)) / (g1 * (b + 1.0) + g2 * (a + 1.0));
    Vector3::new(
        top.plane_strain_modulus(),
        base.plane_strain_modulus(),
        beta,
    )
}

/// A bonded layer's compliance depends on three combinations of its four constants, so its derivatives with respect to
/// Poisson's ratios follow from those with respect to moduli.
#[test]
fn the_compliance_is_constant_along_materials_of_equal_dundurs_parameters() {
    for numbers in [
        [100.0, 0.25, 10.0, 0.3],
        [1.0, 0.4, 30.0, 0.2],
        [3.0, 0.1, 2.0, 0.45],
    ] {
        let by = |index: usize, step: f64| {
            let mut moved = numbers;
            moved[index] += step;
            dundurs(moved)
        };
        let column = |i: usize| (by(i, 1e-5) - by(i, -1e-5)) / 2e-5;
        // The change of the other three that compensates a change of ν₁.
        let system = Matrix3::from_columns(&[column(0), column(2), column(3)]);
        let change = system.lu().solve(&-column(1)).unwrap();
        let [young_1, nu_1, young_2, nu_2] = numbers;
        let [top, base] =
            [(young_1, nu_1), (young_2, nu_2)].map(|(e, nu)| Material::new(e, nu).unwrap());
        let body = Foundation::coated(1.0, top, base).unwrap();
        for k in wavenumbers() {
            let by = |parameter| compliance_derivative(&body, parameter, k);
            let found = by(Parameter::PoissonRatio { body: 0 })
                + change[0] * by(Parameter::YoungModulus { body: 0 })
                + change[1] * by(Parameter::YoungModulus { body: 1 })
                + change[2] * by(Parameter::PoissonRatio { body: 1 });
            // The direction by a second-order difference: 1e-9.
            assert!(found.abs() < 1e-8 * body.compliance(k), "at {k}: {found:e}");
        }
    }
}

/// `dC/dt` along a direction.
fn along(body: &Foundation, direction: &[(Parameter, f64)], wavenumber: f64) -> f64 {
    let changes = direction.iter();
    changes
        .map(|(parameter, change)| change * compliance_derivative(body, *parameter, wavenumber))
        .sum()
}

#[test]
fn the_compliance_is_constant_along_null_directions() {
    // The blocks: one; one; two, above and below the frictionless interface; one, since the other is held.
    for (foundation, blocks) in foundations().into_iter().zip([1, 1, 2, 1]) {
        let directions = foundation.null_directions();
        assert_eq!(directions.len(), blocks);
        for direction in directions {
            for k in wavenumbers() {
                let largest = direction.iter().map(|(parameter, change)| {
                    (change * compliance_derivative(&foundation, *parameter, k)).abs()
                });
                let largest = largest.fold(0.0, f64::max);
                let error = along(&foundation, &direction, k).abs();
                // Sixth-order differences: 4e-11 of C for each number in its own unit.
                let bound = 1e-8 * largest + 1e-9 * foundation.compliance(k);
                assert!(error < bound, "at {k}: {error:e} of {largest:e}");
            }
        }
    }
}

#[test]
fn the_compliance_is_inversely_proportional_to_the_moduli() {
    for foundation in foundations() {
        for k in wavenumbers() {
            // C is inversely proportional to the moduli.
            let found = along(&foundation, &foundation.scaling(0.0, 1.0), k);
            let compliance = foundation.compliance(k);
            assert!((found / compliance + 1.0).abs() < 1e-9, "at {k}: {found:e}");
        }
    }
}
