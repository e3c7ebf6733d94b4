//! Derivatives of coefficients, compared with differences between tables.

#![expect(clippy::unwrap_used, reason = "a test fails by its panic")]

use pellicle_influence::{Cache, ElasticBodies, ElasticParameter, Origin, RadialTables, love};
use pellicle_kernel::{Base, Foundation, FoundationParameter, Interface, Layer, Material};

fn foundations() -> Vec<Foundation> {
    let material = |[young, poisson]: [f64; 2]| Material::new(young, poisson).unwrap();
    let layer = |thickness, numbers, interface| {
        Layer::new(thickness, material(numbers), interface).unwrap()
    };
    let springs = Interface::spring(0.3, 0.8).unwrap();
    let stack = vec![
        layer(0.2, [5.0, 0.2], Interface::Bonded),
        layer(1.5, [0.3, 0.45], springs),
    ];
    let half_space = Base::HalfSpace(material([1.0, 0.35]));
    vec![
        Foundation::half_space(material([2.0, 0.3])),
        Foundation::coated(1.0, material([10.0, 0.25]), material([1.0, 0.3])).unwrap(),
        Foundation::coated(1.0, material([0.02, 0.48]), material([1.0, 0.1])).unwrap(),
        // A layer identical to its base, until a parameter changes.
        Foundation::coated(1.0, material([1.0, 0.3]), material([1.0, 0.3])).unwrap(),
        Foundation::new(stack.clone(), half_space).unwrap(),
        Foundation::new(stack, Base::Rigid).unwrap(),
    ]
}

/// The foundations under a half-space, and a half-space under one of them.
fn bodies() -> Vec<ElasticBodies> {
    let counterbody = Material::new(5.0, 0.1).unwrap();
    let under = |foundation| ElasticBodies::new(foundation, counterbody);
    let mut bodies: Vec<ElasticBodies> = foundations().into_iter().map(under).collect();
    bodies.push(bodies[bodies.len() - 1].swapped());
    bodies
}

/// `k(θ + step)`.
fn moved(bodies: &ElasticBodies, parameter: ElasticParameter, step: f64) -> RadialTables {
    let value = bodies.parameter(parameter).unwrap();
    tables_of(&bodies.with_parameter(parameter, value + step).unwrap())
}

fn tables_of(bodies: &ElasticBodies) -> RadialTables {
    RadialTables::of_bodies(bodies).unwrap()
}

#[test]
fn derivatives_agree_with_differences_between_tables() {
    for body in bodies() {
        let tables = tables_of(&body);
        for parameter in body.parameters() {
            let derivative = tables.derivative(parameter).unwrap();
            let value = body.parameter(parameter).unwrap();
            let unit = match parameter.parts().1 {
                FoundationParameter::PoissonRatio { .. } => 1.0,
                _ => value,
            };
            let step = 2e-3 * unit.min(0.5);
            let [lower, low, high, higher] =
                [-2.0, -1.0, 1.0, 2.0].map(|i| moved(&body, parameter, i * step));
            for side in [1e-3, 0.3, 20.0] {
                for offset in [[0, 0], [2, 1], [7, 3], [60, 11]] {
                    let at = |tables: &RadialTables| tables.coefficient(side, offset);
                    // A fourth-order difference.
                    let expected =
                        (8.0 * (at(&high) - at(&low)) - (at(&higher) - at(&lower))) / (12.0 * step);
                    let found = derivative.coefficient(side, offset);
                    let scale = at(&tables)
                        .abs()
                        .max(1e-3 * tables.coefficient(side, [0, 0]));
                    let error = (found - expected).abs() * unit / scale;
                    assert!(error < 2e-8, "{parameter:?} {side} {offset:?}: {error:e}");
                }
            }
        }
    }
}

#[test]
fn an_elastic_counterbody_adds_its_own_displacement() {
    let material = Material::new(1141e9, 0.07).unwrap();
    for foundation in foundations() {
        let plain = RadialTables::build(&foundation).unwrap();
        let tables = tables_of(&ElasticBodies::new(foundation.clone(), material));
        for offset in [[0, 0], [5, 2], [40, 1]] {
            let own = love::coefficient(&material, 0.2, offset);
            let sum = plain.coefficient(0.2, offset) + own;
            assert_eq!(tables.coefficient(0.2, offset).to_bits(), sum.to_bits());
        }
        let own = 2.0 / (material.plane_strain_modulus() * 3.0);
        let expected = foundation.compliance(3.0) + own;
        assert!((tables.bodies().compliance(3.0) / expected - 1.0).abs() < 1e-15);
    }
}

#[test]
fn tables_of_a_shape_serve_every_size_and_stiffness() {
    let cache = Cache::of_shapes();
    let coated = |length: f64, modulus: f64| {
        let material = |young: f64, nu| Material::new(young * modulus, nu).unwrap();
        Foundation::coated(0.3 * length, material(7.1, 0.22), material(1.0, 0.3)).unwrap()
    };
    let mut origins = Vec::new();
    for (length, modulus) in [(1.0, 1.0), (3e-7, 1.7e9), (2e-3, 4e11)] {
        let foundation = coated(length, modulus);
        let found = cache.radial_tables(&foundation).unwrap();
        origins.push(found.origin);
        let exact = RadialTables::build(&foundation).unwrap();
        for offset in [[0, 0], [6, 2], [90, 17]] {
            let of = |tables: &RadialTables| tables.coefficient(0.1 * length, offset);
            // Ratios are rounded to 5e-13, and tables accurate to 1e-12.
            let error = of(&found.value) / of(&exact) - 1.0;
            assert!(error.abs() < 3e-12, "{offset:?}: {error:e}");
        }
    }
    assert_eq!(origins, [Origin::Computed, Origin::Memory, Origin::Memory]);
}

#[test]
fn coefficients_are_constant_along_null_directions() {
    let equal = foundations().into_iter();
    let equal = equal.map(|body| ElasticBodies::new(body.clone(), body));
    for body in bodies().into_iter().chain(equal) {
        let tables = tables_of(&body);
        let directions = body.null_directions();
        let is_rigid = body.each().iter().any(|body| body.base() == Base::Rigid);
        let are_equal = body.foundation() == body.counterbody();
        let wanted = if body.have_layers() && are_equal {
            1 + body.foundation().parameters().len() - usize::from(is_rigid)
        } else {
            2 + usize::from(!body.have_layers()) - usize::from(is_rigid)
        };
        assert_eq!(directions.len(), wanted);
        for direction in directions {
            let terms = direction.into_iter();
            let derivatives = terms.map(|(of, change)| (tables.derivative(of).unwrap(), change));
            let derivatives: Vec<_> = derivatives.collect();
            for offset in [[0, 0], [2, 1], [60, 11]] {
                let changes = derivatives.iter();
                let changes = changes.map(|(of, change)| change * of.coefficient(0.3, offset));
                let changes: Vec<f64> = changes.collect();
                let largest = changes
                    .iter()
                    .fold(0.0, |most: f64, change| most.max(change.abs()));
                let sum: f64 = changes.iter().sum();
                assert!(
                    sum.abs() < 1e-7 * largest,
                    "{offset:?}: {sum:e} of {largest:e}"
                );
            }
        }
    }
}
