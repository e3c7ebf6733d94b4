//! A loaded circle composed of square elements.

use pellicle_influence::Depth;
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material, Side};
use pellicle_tests::convergence::demand;
use pellicle_validation::independent::hankel::{circle, fields};
use pellicle_validation::stress::squares::LoadedCircle;

/// ELLEA1's three layers in units of the circle's radius, bonded or not.
fn layers(first: Interface) -> Foundation {
    let layer = |thickness, modulus, ratio, interface| {
        Layer::new(thickness, Material::new(modulus, ratio).unwrap(), interface).unwrap()
    };
    let layers = vec![
        layer(1.0, 3000.0, 0.30, first),
        layer(4.0, 200.0, 0.35, Interface::Bonded),
    ];
    Foundation::new(layers, Base::HalfSpace(Material::new(40.0, 0.4).unwrap())).unwrap()
}

#[test]
fn a_circle_of_squares_converges_to_the_circle_with_second_order() {
    let load = LoadedCircle {
        radius: 1.0,
        pressure: 1.0,
    };
    for (interface, z) in [
        (Interface::Bonded, 0.4),
        (Interface::Bonded, 1.0),
        (Interface::Frictionless, 1.0),
        (Interface::Frictionless, 3.0),
    ] {
        let (body, side) = (layers(interface), Side::Below);
        let depth = Depth { z, side };
        let radii = [0.0, 0.6, 1.0, 1.7];
        let wanted = fields(&body, &circle(1.0, 1.0), depth, &radii).unwrap();
        let errors = [16, 24, 32, 48, 64, 96].map(|count| {
            let places = radii.map(|r| [r, 0.0]);
            let found = load.states(&body, count, depth, &places).unwrap();
            let errors = wanted.iter().zip(found).flat_map(|(wanted, found)| {
                let [xx, yy, zz, _, xz, _] = found.stress;
                [
                    xx - wanted.radial,
                    yy - wanted.hoop,
                    zz - wanted.axial,
                    xz - wanted.shear,
                ]
            });
            let largest = wanted.iter().fold(0.0_f64, |most, state| {
                most.max(state.radial.abs()).max(state.axial.abs())
            });
            let worst = errors.fold(0.0_f64, |worst, error| worst.max(error.abs()));
            (count, worst / largest)
        });
        // Elements on the rim spread its load over their area: h² plus a scatter.
        let order = demand(&errors, 1.6, 2e-4);
        assert!(order.is_ok(), "{interface:?} {z}: {order:?} {errors:?}");
    }
}
