//! Two layered bodies in contact: their coefficients add.

use pellicle_influence::{
    Cache, ElasticBodies, ElasticBody, ElasticOperator, PeriodicOperator, RadialTables,
};
use pellicle_kernel::{Base, Foundation, Interface, KernelError, Layer, Material};

const OFFSETS: [[usize; 2]; 4] = [[0, 0], [2, 1], [7, 3], [60, 11]];

fn material(young: f64, nu: f64) -> Material {
    Material::new(young, nu).expect("a material")
}

/// A hard coating on an interlayer that slides on its base, and a soft layer on a rigid base.
fn bodies(stiffness: f64) -> [Foundation; 2] {
    let layer = |thickness, young: f64, nu, interface| {
        Layer::new(thickness, material(stiffness * young, nu), interface).expect("a layer")
    };
    let stack = vec![
        layer(0.3, 10.0, 0.2, Interface::Bonded),
        layer(0.7, 0.4, 0.45, Interface::Frictionless),
    ];
    let base = Base::HalfSpace(material(stiffness, 0.3));
    let soft = vec![layer(2.0, 0.1, 0.49, Interface::Bonded)];
    [
        Foundation::new(stack, base).expect("a body"),
        Foundation::new(soft, Base::Rigid).expect("a body"),
    ]
}

fn coefficients(tables: &RadialTables) -> Vec<f64> {
    let of_side = |side: f64| OFFSETS.map(|offset| tables.coefficient(side, offset));
    [1e-3, 0.3, 20.0].into_iter().flat_map(of_side).collect()
}

fn assert_equal(found: &[f64], wanted: &[f64], error: f64) {
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((found / wanted - 1.0).abs() <= error, "{found} {wanted}");
    }
}

#[test]
fn swapped_bodies_have_the_same_coefficients_to_the_bit() {
    let [one, other] = bodies(1.0);
    let both = ElasticBodies::new(one, other);
    let cache = Cache::in_memory();
    let tables = cache.radial_tables_of(&both).unwrap().value;
    let swapped = cache.radial_tables_of(&both.swapped()).unwrap().value;
    assert_equal(&coefficients(&swapped), &coefficients(&tables), 0.0);
    assert_eq!(*swapped, tables.swapped());
}

#[test]
fn coefficients_of_two_bodies_are_those_of_each_and_two_equal_ones_are_one_of_half_the_modulus() {
    let both = bodies(1.0);
    let alone = both
        .each_ref()
        .map(|body| RadialTables::build(body).unwrap());
    let [one, other] = both;
    let tables = RadialTables::of_bodies(&ElasticBodies::new(one.clone(), other)).unwrap();
    let wanted = coefficients(&alone[0]);
    let wanted = wanted.iter().zip(coefficients(&alone[1]));
    let wanted: Vec<f64> = wanted.map(|(one, other)| one + other).collect();
    assert_equal(&coefficients(&tables), &wanted, 0.0);
    let [half, _] = bodies(0.5);
    let twice = RadialTables::of_bodies(&ElasticBodies::new(one.clone(), one)).unwrap();
    let of_half = RadialTables::build(&half).unwrap();
    // Roundings of the moduli's ratios.
    assert_equal(&coefficients(&twice), &coefficients(&of_half), 1e-13);
}

#[test]
fn a_body_under_or_above_a_rigid_one_is_the_body_alone() {
    for body in bodies(1.0) {
        let alone = RadialTables::build(&body).unwrap();
        let above = ElasticBodies::new(Foundation::rigid(), body);
        let tables = RadialTables::of_bodies(&above).unwrap();
        assert_equal(&coefficients(&tables), &coefficients(&alone), 0.0);
        let own = tables.coefficient_of(ElasticBody::Foundation, 0.3, [1, 0]);
        assert!(own.abs() <= 0.0);
    }
    let rigid = ElasticBodies::from(Foundation::rigid());
    let refused = RadialTables::of_bodies(&rigid).unwrap_err();
    assert_eq!(refused, KernelError::NothingElastic.into());
}

#[test]
fn the_displacements_of_a_cell_add() {
    let size = 16;
    let pressure: Vec<f64> = (0..size * size).map(|i| (i * i % 23) as f64).collect();
    let displacement = |bodies: &ElasticBodies| {
        let mut found = vec![0.0; pressure.len()];
        PeriodicOperator::new(bodies, 0.2, [size; 2]).apply_into(&pressure, &mut found);
        found
    };
    let [one, other] = bodies(1.0);
    let alone = [&one, &other].map(|body| displacement(&body.clone().into()));
    let together = displacement(&ElasticBodies::new(one, other));
    let largest = together.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
    for (i, found) in together.iter().enumerate() {
        let wanted = alone[0][i] + alone[1][i];
        // The sums over aliases are polynomials, to 1e-12.
        assert!((found - wanted).abs() < 1e-12 * largest, "{found} {wanted}");
    }
}
