//! The mean displacement of a cell: on a rigid base that of layers which cannot widen, and never that of the indenter.

use approx::assert_relative_eq;
use pellicle_contact::{Domain, FlatPunch, Indenter, Model, Paraboloid, Profile};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};

use super::{model, solve, with_elastic_indenter};

/// Side of the cell, 20 µm.
const SIDE: f64 = 2e-5;

fn layer([thickness, modulus, ratio]: [f64; 3], interface: Interface) -> Layer {
    Layer::new(thickness, Material::new(modulus, ratio).unwrap(), interface).unwrap()
}

fn on_rigid_base(layers: Vec<Layer>) -> Foundation {
    Foundation::new(layers, Base::Rigid).unwrap()
}

/// 5 µm of rubber with this Poisson's ratio.
fn sheet(ratio: f64, interface: Interface) -> Foundation {
    on_rigid_base(vec![layer([5e-6, 1e7, ratio], interface)])
}

/// `H (1 + ν)(1 − 2ν)/((1 − ν) E)`.
fn confined([thickness, modulus, ratio]: [f64; 3]) -> f64 {
    thickness * (1.0 + ratio) * (1.0 - 2.0 * ratio) / ((1.0 - ratio) * modulus)
}

#[derive(Debug)]
struct Flat;

impl Profile for Flat {
    fn height(&self, _: f64, _: f64) -> f64 {
        0.0
    }
}

/// A cell that repeats has no room to widen, so a frictionless layer is as stiff as a bonded one: `D = p C(0)`. Were it
/// free to slide out, it would be `(1 − ν)²/(1 − 2ν)` times as soft, 13 times at ν = 0.49. An elastic indenter changes
/// nothing: its own mean displacement is infinite and left out.
#[test]
fn a_flat_body_shortens_the_layers_of_a_cell_as_if_confined() {
    let (mean_pressure, steel) = (1e5, Material::new(2e11, 0.3).unwrap());
    let [coat, rubber] = [[2e-6, 5e9, 0.2], [5e-6, 1e7, 0.49]];
    let spring = Interface::spring(1e-14, 3e-14).unwrap();
    let two = confined(coat) + confined(rubber);
    for (layers, compliance) in [
        (vec![layer(rubber, Interface::Bonded)], confined(rubber)),
        (
            vec![layer(rubber, Interface::Frictionless)],
            confined(rubber),
        ),
        (
            vec![
                layer(coat, Interface::Frictionless),
                layer(rubber, Interface::Bonded),
            ],
            two,
        ),
        (
            vec![
                layer(coat, Interface::Frictionless),
                layer(rubber, Interface::Frictionless),
            ],
            two,
        ),
        (
            vec![layer(coat, spring), layer(rubber, Interface::Frictionless)],
            two + 1e-14,
        ),
    ] {
        let rigid = model(&on_rigid_base(layers), Indenter::custom(Flat));
        for model in [with_elastic_indenter(&rigid, steel), rigid] {
            let path = solve(
                &model,
                Domain::Periodic(SIDE),
                16,
                mean_pressure * SIDE * SIDE,
            );
            let step = &path.steps[0];
            let depth = mean_pressure * compliance;
            // roundings of sums over 256 elements
            assert_relative_eq!(step.solution.penetration, depth, max_relative = 1e-13);
            for pressure in &step.solution.pressure {
                assert_relative_eq!(*pressure, mean_pressure, max_relative = 1e-12);
            }
            let stiffness = step.contact_stiffness.unwrap();
            assert_relative_eq!(stiffness, SIDE * SIDE / compliance, max_relative = 1e-9);
        }
    }
}

/// No displacement at all, and still a certificate.
#[test]
fn a_flat_body_does_not_shorten_an_incompressible_layer() {
    let cell = model(&sheet(0.5, Interface::Frictionless), Indenter::custom(Flat));
    let path = solve(&cell, Domain::Periodic(SIDE), 16, 1e5 * SIDE * SIDE);
    // 1e5 Pa would press a layer that could slide out in by 37 nm.
    assert!(path.steps[0].solution.penetration.abs() < 1e-22);
}

/// A flat punch keeps its contact: the displacement is proportional to the force, and the mean is part of it.
#[test]
fn the_stiffness_of_a_cell_is_the_slope_of_its_penetration() {
    let rigid = model(
        &sheet(0.45, Interface::Frictionless),
        FlatPunch::new(4e-6).unwrap().into(),
    );
    let steel = Material::new(1e7, 0.3).unwrap();
    for model in [with_elastic_indenter(&rigid, steel), rigid] {
        let at = |force: f64| {
            solve(&model, Domain::Periodic(SIDE), 32, force)
                .steps
                .remove(0)
        };
        let (less, more) = (at(0.9e-4), at(1.1e-4));
        let slope = 0.2e-4 / (more.solution.penetration - less.solution.penetration);
        // the certificates of both
        assert_relative_eq!(less.contact_stiffness.unwrap(), slope, max_relative = 1e-6);
    }
}

/// The derivative of the penetration by a modulus, by differences of solutions, is that of `p C(0)` where the pressure
/// is uniform: the mean of no other body takes part.
#[test]
fn the_penetration_changes_with_a_layers_modulus_as_its_confined_compliance_does() {
    let penetration = |modulus: f64| {
        let layers = vec![
            layer([2e-6, modulus, 0.2], Interface::Frictionless),
            layer([5e-6, 1e7, 0.49], Interface::Bonded),
        ];
        let cell = model(&on_rigid_base(layers), Indenter::custom(Flat));
        solve(&cell, Domain::Periodic(SIDE), 16, 1e5 * SIDE * SIDE).steps[0]
            .solution
            .penetration
    };
    let (modulus, step) = (2e7, 2e4);
    let slope = (penetration(modulus + step) - penetration(modulus - step)) / (2.0 * step);
    let wanted = -1e5 * confined([2e-6, modulus, 0.2]) / modulus;
    // (step/E)² of the difference
    assert_relative_eq!(slope, wanted, max_relative = 2e-6);
}

#[test]
fn an_ever_stiffer_indenter_becomes_the_rigid_one() {
    for interface in [Interface::Bonded, Interface::Frictionless] {
        let rigid = model(&sheet(0.3, interface), FlatPunch::new(4e-6).unwrap().into());
        let solved = |model: &Model| {
            solve(model, Domain::Periodic(SIDE), 32, 1e-3)
                .steps
                .remove(0)
        };
        let stiff = Material::new(1e24, 0.3).unwrap();
        let (found, wanted) = (
            solved(&with_elastic_indenter(&rigid, stiff)),
            solved(&rigid),
        );
        // the certificates of both; the indenter's part is 1e-17
        assert_relative_eq!(
            found.solution.penetration,
            wanted.solution.penetration,
            max_relative = 1e-8
        );
        assert_relative_eq!(
            found.contact_stiffness.unwrap(),
            wanted.contact_stiffness.unwrap(),
            max_relative = 1e-7
        );
        let largest = wanted.summary.max_pressure;
        for (found, wanted) in found
            .solution
            .pressure
            .iter()
            .zip(&wanted.solution.pressure)
        {
            assert!((found - wanted).abs() < 1e-6 * largest, "{found} {wanted}");
        }
    }
}

/// The field of the body alone keeps the body's mean, also under an indenter a tenth as stiff.
#[test]
fn the_surface_of_the_body_has_its_own_mean_under_an_elastic_indenter() {
    let rigid = model(
        &sheet(0.3, Interface::Frictionless),
        Paraboloid::new(1e-4).unwrap().into(),
    );
    let cell = with_elastic_indenter(&rigid, Material::new(1e6, 0.4).unwrap());
    let path = solve(&cell, Domain::Periodic(SIDE), 32, 1e-5);
    let surface = path.surface(&path.geometry(), 0).unwrap();
    let mean = surface.displacement.iter().sum::<f64>() / 1024.0;
    let wanted = 1e-5 / (SIDE * SIDE) * confined([5e-6, 1e7, 0.3]);
    // The indenter's displacement, which is subtracted, has no mean; roundings.
    assert_relative_eq!(mean, wanted, max_relative = 1e-10);
    let deepest = surface.displacement.iter().copied().fold(0.0, f64::max);
    assert!(deepest > 1.5 * mean, "{deepest:e} {mean:e}");
}

/// A single contact squeezes a frictionless layer outwards, a cell's neighbours hold it: per cell, the difference is
/// that between the limit of long waves, `H (1 − ν²)/E`, and the confined compliance.
#[test]
fn in_a_large_cell_a_frictionless_layer_is_stiffer_than_alone_by_what_its_neighbours_hold() {
    let numbers = [5e-6, 1e7, 0.45];
    let model = model(
        &sheet(0.45, Interface::Frictionless),
        Paraboloid::new(1e-4).unwrap().into(),
    );
    let (side, force) = (1e-4, 1e-5);
    let [alone, cell] = [Domain::Side(side), Domain::Periodic(side)].map(|domain| {
        solve(&model, domain, 64, force)
            .steps
            .remove(0)
            .solution
            .penetration
    });
    let free = 5e-6 * (1.0 - 0.45 * 0.45) / 1e7;
    let held = force / (side * side) * (free - confined(numbers));
    // the certificates of both
    assert!(
        (alone - cell - held).abs() < 1e-7 * alone,
        "{alone:e} {cell:e} {held:e}"
    );
    assert!(held > 1e-3 * alone);
}
