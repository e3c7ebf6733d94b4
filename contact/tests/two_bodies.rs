//! Two layered bodies in contact: which of them is called the indenter does not matter.

#![expect(clippy::unwrap_used, reason = "a test fails by its panic")]

use std::sync::Arc;

use pellicle_contact::axisymmetric::{AxisymmetricElasticity, AxisymmetricProfile};
use pellicle_contact::{
    Domain, Load, LoadingPath, Model, Paraboloid, Sliding, SolverOptions, StressField, solve_path,
};
use pellicle_influence::{Cache, Depth, ElasticBodies, ElasticBody, RadialTables};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material, Side};
use pellicle_texture::{Film, Relief};

const LOADS: [f64; 3] = [1e-3, 5e-3, 2e-2];

fn material(young: f64, nu: f64) -> Material {
    Material::new(young, nu).unwrap()
}

/// A hard coating on an interlayer; moduli times a factor.
fn hard(factor: f64) -> Foundation {
    let layer = |thickness, young: f64| {
        Layer::new(thickness, material(factor * young, 0.25), Interface::Bonded).unwrap()
    };
    let base = Base::HalfSpace(material(factor, 0.3));
    Foundation::new(vec![layer(0.05, 6.0), layer(0.1, 0.5)], base).unwrap()
}

fn soft() -> Foundation {
    Foundation::coated(0.2, material(0.3, 0.45), material(3.0, 0.2)).unwrap()
}

fn model(bodies: &ElasticBodies, relief: Relief) -> Model {
    Model {
        tables: Arc::new(RadialTables::of_bodies(bodies).unwrap()),
        relief,
        indenter: Paraboloid::new(1.0).unwrap().into(),
        cache: Cache::in_memory(),
    }
}

fn solve_on(bodies: &ElasticBodies, relief: Relief) -> LoadingPath {
    let (model, options) = (model(bodies, relief), SolverOptions::default());
    let loads = LOADS.map(Load::Force);
    let path = solve_path(&model, Domain::Side(0.8), 64, &loads, &options, &mut ()).unwrap();
    for step in &path.steps {
        assert!(step.solution.certificate.is_satisfied());
    }
    path
}

fn solve(bodies: &ElasticBodies) -> LoadingPath {
    solve_on(bodies, Relief::Bare)
}

fn assert_same(one: &LoadingPath, other: &LoadingPath, error: f64) {
    for (one, other) in one.steps.iter().zip(&other.steps) {
        let [one, other] = [one, other].map(|step| {
            let summary = &step.summary;
            [
                step.solution.penetration,
                summary.max_pressure,
                summary.contact_area,
            ]
        });
        for (one, other) in one.into_iter().zip(other) {
            assert!((one / other - 1.0).abs() <= error, "{one} {other}");
        }
    }
}

#[test]
fn swapped_bodies_have_the_same_curve_to_the_bit() {
    let bodies = ElasticBodies::new(hard(1.0), soft());
    assert_same(&solve(&bodies), &solve(&bodies.swapped()), 0.0);
    let film = || Relief::Film(Film::new(0.01, 0.5).unwrap());
    let [one, other] = [bodies.clone(), bodies.swapped()].map(|of| solve_on(&of, film()));
    assert_same(&one, &other, 0.0);
}

#[test]
fn a_coated_ball_on_a_rigid_flat_is_a_rigid_ball_on_the_coated_body() {
    let ball = ElasticBodies::new(Foundation::rigid(), hard(1.0));
    assert_same(&solve(&ball), &solve(&hard(1.0).into()), 0.0);
}

#[test]
fn two_equal_bodies_are_one_of_half_the_modulus() {
    let equal = ElasticBodies::new(hard(1.0), hard(1.0));
    // Coefficients differ by roundings, and solutions by as much as the solver's last step.
    assert_same(&solve(&equal), &solve(&hard(0.5).into()), 1e-12);
}

#[test]
fn each_body_is_displaced_by_its_own_share_and_both_fill_the_contact() {
    let bodies = ElasticBodies::new(hard(1.0), soft());
    let path = solve(&bodies);
    let other = path.seen_from(ElasticBody::Counterbody);
    let geometry = path.geometry();
    for (index, step) in path.steps.iter().enumerate() {
        let of_path = |path: &LoadingPath| path.surface(&geometry, index).unwrap().displacement;
        let (own, others) = (of_path(&path), of_path(&other));
        let places = path.grid.centres().zip(own.iter().zip(others));
        for (([x, y], (own, other)), p) in places.zip(&step.solution.pressure) {
            if *p > 0.0 {
                let wanted = step.solution.penetration - 0.5 * (x * x + y * y);
                let error = (own + other - wanted).abs();
                let largest = step.solution.certificate.tolerance * step.solution.penetration;
                assert!(error < largest, "{error:e}");
            }
        }
    }
}

#[test]
fn axisymmetric_contact_takes_the_layers_of_both_bodies() {
    let profile = AxisymmetricProfile::Paraboloid { radius: 1.0 };
    let numbers = |bodies: &ElasticBodies, radius: f64| {
        let contact = AxisymmetricElasticity::new(bodies).contact(profile, radius);
        let contact = contact.unwrap();
        [contact.force, contact.penetration, contact.punch.stiffness]
    };
    let assert_near = |one: [f64; 3], other: [f64; 3]| {
        for (one, other) in one.into_iter().zip(other) {
            // The accuracy of forces and penetrations.
            assert!((one / other - 1.0).abs() < 1e-11, "{one} {other}");
        }
    };
    let bodies = ElasticBodies::new(hard(1.0), soft());
    let rigid = ElasticBodies::new(Foundation::rigid(), soft());
    let equal = ElasticBodies::new(hard(1.0), hard(1.0));
    for radius in [1e-3, 0.05, 0.4, 10.0] {
        assert_near(numbers(&bodies, radius), numbers(&bodies.swapped(), radius));
        assert_near(numbers(&rigid, radius), numbers(&soft().into(), radius));
        assert_near(numbers(&equal, radius), numbers(&hard(0.5).into(), radius));
    }
    // On the grid: its own error.
    let path = solve(&bodies);
    for step in &path.steps {
        let [force, penetration, _] = numbers(&bodies, step.summary.contact_radius);
        assert!((force / step.solution.force - 1.0).abs() < 0.03);
        assert!((penetration / step.solution.penetration - 1.0).abs() < 0.02);
    }
}

#[test]
fn stresses_in_each_body_are_those_of_that_body_alone_under_the_same_pressure() {
    let bodies = ElasticBodies::new(soft(), hard(1.0));
    let path = solve(&bodies);
    let sliding = Sliding {
        friction: 0.3,
        direction: 0.4,
    };
    let pressure = &path.steps[2].solution.pressure;
    let seen = path.seen_from(ElasticBody::Counterbody);
    let found = StressField::new(&seen, 2, sliding.opposite()).unwrap();
    let alone = Arc::new(RadialTables::build(&hard(1.0)).unwrap());
    let [same, dragged] = [sliding.opposite(), sliding]
        .map(|sliding| StressField::of(alone.clone(), path.grid, pressure, sliding));
    let depth = Depth {
        z: 0.08,
        side: Side::Above,
    };
    let point = [0.07, -0.02];
    let at = |field: &StressField| field.at(point, depth).unwrap();
    assert_eq!(at(&found), at(&same));
    // The indenter is dragged the other way than the foundation: half of the sum is without sliding.
    let still = StressField::of(alone.clone(), path.grid, pressure, Sliding::default());
    let [one, other, still] = [at(&same), at(&dragged), at(&still)];
    for (k, still) in still.stress.into_iter().enumerate() {
        let mean = f64::midpoint(one.stress[k], other.stress[k]);
        assert!((mean - still).abs() < 1e-12 * still.abs().max(1e-3), "{k}");
        assert!((one.stress[k] - other.stress[k]).abs() > 0.0, "{k}");
    }
}
