//! The length to which gaps of a cell are compared: the pressure must be as accurate as the tolerance says.

use std::sync::Arc;

use approx::assert_relative_eq;
use pellicle_contact::{Domain, Load, Model, Paraboloid, SolverOptions, Step, solve_path};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use pellicle_texture::{CylinderSpec, Cylinders, Lattice, Relief};

fn layer([thickness, modulus, ratio]: [f64; 3], interface: Interface) -> Layer {
    Layer::new(thickness, Material::new(modulus, ratio).unwrap(), interface).unwrap()
}

/// Thin films on 2.5 µm of an incompressible body a million times softer than its base, under pillars 1 nm high with a
/// period of 15 nm: the mean pressure alone would press a cell of 92 nm in by 40 µm, 20,000 times the penetration.
fn soft_and_deep(base: Base) -> Model {
    let layers = vec![
        layer(
            [2.55e-10, 1.08e6, 0.25],
            Interface::spring(0.0, 1.96e-15).unwrap(),
        ),
        layer([2.11e-10, 12.95, 0.5], Interface::Frictionless),
        layer([1.008e-9, 209.0, 0.0076], Interface::Bonded),
        layer([2.467e-6, 1.493, 0.499_999_9], Interface::Bonded),
        layer([1.239e-7, 198.2, 0.0], Interface::Bonded),
    ];
    let pillars = Cylinders::new(CylinderSpec {
        lattice: Lattice::Square,
        radius: 3.836e-9,
        height: 9.22e-10,
        period: SIDE / 6.0,
        offset: [9.27e-9, 5.38e-9],
        young_modulus: 8.02e6,
    });
    let foundation = Foundation::new(layers, base).unwrap();
    Model {
        tables: Arc::new(RadialTables::build(&foundation).unwrap()),
        relief: Relief::Cylinders(pillars.unwrap().stiffening()),
        indenter: Paraboloid::new(6.3e-7).unwrap().into(),
        cache: Cache::none(),
    }
}

const SIDE: f64 = 9.206e-8;

fn solve(model: &Model, tolerance: f64) -> Step {
    let options = SolverOptions {
        tolerance,
        ..SolverOptions::default()
    };
    let loads = [Load::Force(3.44e-11)];
    let mut path =
        solve_path(model, Domain::Periodic(SIDE), 21, &loads, &options, &mut ()).unwrap();
    assert!(path.steps[0].solution.certificate.is_satisfied());
    path.steps.remove(0)
}

/// On a rigid base the mean displacement is part of the penetration, and as irrelevant.
#[test]
fn where_a_deep_soft_layer_carries_the_mean_the_pressure_is_right_to_the_tolerance() {
    for base in [
        Base::HalfSpace(Material::new(4.48e6, 0.499).unwrap()),
        Base::Rigid,
    ] {
        let model = soft_and_deep(base);
        let (usual, fine) = (solve(&model, 1e-8), solve(&model, 1e-11));
        let peak = fine.summary.max_pressure;
        for (usual, fine) in usual.solution.pressure.iter().zip(&fine.solution.pressure) {
            // the tolerance; relative to the depth by the mean pressure gaps gave an error of 7e-6
            assert!((usual - fine).abs() < 3e-8 * peak, "{usual} {fine}");
        }
        assert_relative_eq!(
            usual.solution.penetration,
            fine.solution.penetration,
            max_relative = 1e-9
        );
    }
}
